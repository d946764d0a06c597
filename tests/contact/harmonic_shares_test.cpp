// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/harmonic_shares.hpp"

#include "contact/spanning_weights.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace plekton::contact {
namespace {

using test::Random;

/// Links between vertices 0 .. n - 1, ascending by upper vertex, with resistances from 1 to a power
/// of 10.
std::vector<Link> random_links(Random& random, std::uint32_t n, int count, double power) {
  std::vector<Link> links;
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(1 + random.index(n - 1));
    links.push_back({a, static_cast<std::uint32_t>(random.index(a)),
                     std::pow(10.0, random.uniform(0.0, power))});
  }
  std::sort(links.begin(), links.end(), [](const Link& i, const Link& k) { return i.a < k.a; });
  return links;
}

/// Some triangles and quadrangles of links, found by trying.
std::vector<Filling> random_fillings(Random& random, const std::vector<Link>& links, int tries) {
  std::vector<Filling> fillings;
  for (int t = 0; t < tries; ++t) {
    Filling filling{0, {}, {}, 0};
    auto at = static_cast<std::uint32_t>(links[random.index(links.size())].a);
    const std::uint32_t start = at;
    do {
      const auto link = static_cast<std::uint32_t>(random.index(links.size()));
      if (links[link].a != at && links[link].b != at) continue;
      const bool along = links[link].a == at;
      at = along ? links[link].b : links[link].a;
      filling.upper = std::max(filling.upper, links[link].a);
      filling.links[filling.count] = link;
      filling.signs[filling.count++] = along ? 1 : -1;
    } while (filling.count == 0 || (filling.count < 4 && at != start));
    if (at == start) fillings.push_back(filling);
  }
  std::sort(fillings.begin(), fillings.end(),
            [](const Filling& i, const Filling& k) { return i.upper < k.upper; });
  return fillings;
}

/// Orthonormal basis of what is orthogonal to the rows of a matrix.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& rows, Eigen::Index columns) {
  if (columns == 0) return Eigen::MatrixXd(0, 0);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const double least = 1e-9 * std::max(1e-300, svd.singularValues()[0]);
  const Eigen::Index rank = (svd.singularValues().array() > least).count();
  return svd.matrixV().rightCols(columns - rank);
}

/// The shares by their definition: the projection, in root(resistance) * current, on the currents
/// without sources that are orthogonal to all filled rings.
std::vector<double> by_projection(std::uint32_t n, std::span<const Link> links,
                                  std::span<const Filling> fillings, std::size_t& holes) {
  const auto count = static_cast<Eigen::Index>(links.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(
      static_cast<Eigen::Index>(n) + static_cast<Eigen::Index>(fillings.size()), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Link& link = links[static_cast<std::size_t>(i)];
    rows(link.a, i) += 1.0 / std::sqrt(link.resistance);
    rows(link.b, i) -= 1.0 / std::sqrt(link.resistance);
  }
  for (std::size_t f = 0; f < fillings.size(); ++f) {
    for (std::size_t k = 0; k < fillings[f].count; ++k) {
      const std::uint32_t link = fillings[f].links[k];
      rows(static_cast<Eigen::Index>(n + f), link) +=
          fillings[f].signs[k] * std::sqrt(links[link].resistance);
    }
  }
  const Eigen::MatrixXd kernel = kernel_of(rows, count);
  holes = static_cast<std::size_t>(kernel.cols());
  std::vector<double> shares;
  for (Eigen::Index i = 0; i < count; ++i) shares.push_back(kernel.row(i).squaredNorm());
  return shares;
}

TEST(HarmonicShares, AreTheProjectionOnTheHarmonicCurrentsBelowEveryVertex) {
  Random random(1);
  HarmonicShares harmonic;
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 9));
    const auto links = random_links(random, n, random.integer(1, 22), 2.0);
    const auto fillings = random_fillings(random, links, random.integer(0, 20));
    harmonic.build(n, links, fillings);
    for (std::uint32_t below = 1; below <= n; ++below) {
      const auto first = [&](const auto& list, auto level) {
        return static_cast<std::size_t>(std::count_if(
            list.begin(), list.end(), [&](const auto& one) { return level(one) < below; }));
      };
      const auto part = std::span(links).first(first(links, [](const Link& l) { return l.a; }));
      const auto filled =
          std::span(fillings).first(first(fillings, [](const Filling& f) { return f.upper; }));
      std::size_t holes = 0;
      const auto expected = by_projection(below, part, filled, holes);

      const auto shares = harmonic.find(below, links);

      ASSERT_EQ(harmonic.hole_count(below), holes);
      ASSERT_EQ(shares.size(), expected.size());
      for (std::size_t i = 0; i < shares.size(); ++i) ASSERT_NEAR(shares[i], expected[i], 1e-11);
      seen += holes > 0 && !filled.empty();
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(HarmonicShares, AreWhatSpanningTreesLeaveOutWhereNothingIsFilled) {
  Random random(2);
  HarmonicShares harmonic;
  SpanningWeights spanning;
  for (const double power : {0.0, 3.0, 12.0}) {
    // Rings that differ in a link of little resistance alone are parallel but for the root of the
    // ratio.
    const double tolerance = 1e-13 + 64 * 2.2e-16 * std::pow(10.0, 0.5 * power);
    for (int trial = 0; trial < 100; ++trial) {
      const auto n = static_cast<std::uint32_t>(random.integer(2, 12));
      const auto links = random_links(random, n, random.integer(1, 40), power);
      harmonic.build(n, links, {});

      const auto shares = harmonic.find(n, links);

      const auto weights = spanning.find(n, links);
      for (std::size_t i = 0; i < links.size(); ++i)
        ASSERT_NEAR(shares[i], 1.0 - weights[i], tolerance);
    }
  }
}

TEST(HarmonicShares, OfTwoLinksWithoutResistanceAreEvenInARingOfThem) {
  const std::vector<Link> links{{1, 0, 0.0}, {1, 0, 0.0}, {2, 1, 1.0}};
  HarmonicShares harmonic;
  harmonic.build(3, links, {});

  const auto shares = harmonic.find(3, links);

  EXPECT_DOUBLE_EQ(shares[0], 0.5);
  EXPECT_DOUBLE_EQ(shares[1], 0.5);
  EXPECT_DOUBLE_EQ(shares[2], 0.0);
}

TEST(HarmonicShares, AreThoseOfParallelWaysHoweverLittleALinkBetweenThemResists) {
  // A ring over 0, 1 and 2; a triangle that is filled is a second way from 2 to 1, over 3.
  const std::vector<Filling> fillings{{3, {2, 3, 4, 0}, {1, -1, 1, 0}, 3}};
  HarmonicShares harmonic;
  for (const double little : {0.0, 1e-300, 1e-20, 1e-18, 1e-16, 1e-12, 1e-8, 1e-4, 1.0}) {
    const std::vector<Link> links{
        {1, 0, 1.0}, {2, 0, 2.0}, {2, 1, 3.0}, {3, 1, 3.0}, {3, 2, little}};
    harmonic.build(4, links, fillings);

    const auto shares = harmonic.find(4, links);

    const double current = (3.0 + little) / (6.0 + little);  // in link 2; the rest goes over 3
    const double over_3 = 1.0 - current;
    const double resistance = 1.0 + 2.0 + 3.0 * current;
    const double tolerance = 1e-14;
    EXPECT_NEAR(shares[0], 1.0 / resistance, tolerance) << little;
    EXPECT_NEAR(shares[1], 2.0 / resistance, tolerance) << little;
    EXPECT_NEAR(shares[2], 3.0 * current * current / resistance, tolerance) << little;
    EXPECT_NEAR(shares[3], 3.0 * over_3 * over_3 / resistance, tolerance) << little;
    EXPECT_NEAR(shares[4], little * over_3 * over_3 / resistance, tolerance) << little;
  }
}

TEST(HarmonicShares, AreNoneWhereTheOnlyRingIsFilled) {
  const std::vector<Link> links{{1, 0, 1.0}, {2, 0, 2.0}, {2, 1, 3.0}};
  const std::vector<Filling> fillings{{2, {0, 1, 2, 0}, {1, -1, 1, 0}, 3}};
  HarmonicShares harmonic;
  harmonic.build(3, links, fillings);

  EXPECT_EQ(harmonic.hole_count(3), 0U);
  for (const double share : harmonic.find(3, links)) EXPECT_EQ(share, 0.0);
}

}  // namespace
}  // namespace plekton::contact

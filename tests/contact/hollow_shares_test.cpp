// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/hollow_shares.hpp"

#include "tests/support/seeded_random.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace plekton::contact {
namespace {

using test::Random;

using Triangle = std::array<std::uint32_t, 3>;

/// Facets over corners, ascending by upper, with sides numbered by their ends.
std::vector<WholeFacet> facets_over(const std::vector<Triangle>& triangles) {
  std::vector<WholeFacet> facets;
  for (const Triangle& n : triangles) {
    WholeFacet facet{std::max({n[0], n[1], n[2]}), n, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(n[k], n[(k + 1) % 3]);
      facet.sides[k] = 1000 * low + high;
      facet.signs[k] = n[k] == low ? 1 : -1;
    }
    facets.push_back(facet);
  }
  std::sort(facets.begin(), facets.end(),
            [](const WholeFacet& a, const WholeFacet& b) { return a.upper < b.upper; });
  return facets;
}

std::vector<Triangle> random_triangles(Random& random, std::uint32_t corners, int count) {
  std::map<std::set<std::uint32_t>, Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const Triangle n{static_cast<std::uint32_t>(random.index(corners)),
                     static_cast<std::uint32_t>(random.index(corners)),
                     static_cast<std::uint32_t>(random.index(corners))};
    const std::set<std::uint32_t> key(n.begin(), n.end());
    if (key.size() == 3) triangles.try_emplace(key, n);
  }
  std::vector<Triangle> list;
  for (const auto& [key, n] : triangles) list.push_back(n);
  return list;
}

/// The shares by their definition, from a basis of what the matrix of sides takes to nothing.
std::vector<double> by_projection(std::span<const WholeFacet> facets,
                                  std::span<const double> weights, std::size_t& hollows) {
  const auto count = static_cast<Eigen::Index>(facets.size());
  std::map<std::uint32_t, Eigen::Index> sides;
  for (const WholeFacet& facet : facets) {
    for (const std::uint32_t side : facet.sides)
      sides.try_emplace(side, static_cast<Eigen::Index>(sides.size()));
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(
      std::max<Eigen::Index>(1, static_cast<Eigen::Index>(sides.size())), count);
  Eigen::VectorXd weight(count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const WholeFacet& facet = facets[static_cast<std::size_t>(f)];
    weight[f] = weights[facet.corners[0]] + weights[facet.corners[1]] + weights[facet.corners[2]];
    for (std::size_t k = 0; k < 3; ++k)
      rows(sides[facet.sides[k]], f) += facet.signs[k] / std::sqrt(weight[f]);
  }
  std::vector<double> shares(weights.size(), 0.0);
  hollows = 0;
  if (count == 0) return shares;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > 1e-9 * svd.singularValues()[0]).count();
  const Eigen::MatrixXd kernel = svd.matrixV().rightCols(count - rank);
  hollows = static_cast<std::size_t>(kernel.cols());
  for (Eigen::Index f = 0; f < count; ++f) {
    for (const std::uint32_t corner : facets[static_cast<std::size_t>(f)].corners)
      shares[corner] += kernel.row(f).squaredNorm() * weights[corner] / weight[f];
  }
  return shares;
}

TEST(HollowShares, AreTheProjectionOnTheShellsBelowEveryCorner) {
  Random random(1);
  HollowShares shares_of_hollows;
  std::size_t seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(4, 8));
    const auto facets = facets_over(random_triangles(random, n, random.integer(4, 40)));
    shares_of_hollows.build(facets);
    std::vector<double> weights{1.0};
    while (weights.size() < n) weights.push_back(weights.back() * random.uniform(1.0, 2.0));
    for (std::uint32_t below = 1; below <= n; ++below) {
      const auto count = std::count_if(facets.begin(), facets.end(),
                                       [&](const WholeFacet& f) { return f.upper < below; });
      std::size_t hollows = 0;
      const auto expected =
          by_projection(std::span(facets).first(static_cast<std::size_t>(count)), weights, hollows);

      const auto shares = shares_of_hollows.find(below, weights);

      ASSERT_EQ(shares_of_hollows.hollow_count(below), hollows);
      for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(shares[i], expected[i], 1e-12);
      seen += hollows;
    }
  }
  EXPECT_GT(seen, 300U);
}

TEST(HollowShares, OfOneShellAreInProportionToTheWeightsAndFacetsOfACorner) {
  // A double pyramid: three facets at the tips, four at the other corners.
  const std::vector<Triangle> pyramid{{0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                      {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  const std::vector<double> weights{1.0, 2.0, 3.0, 5.0, 7.0};
  HollowShares hollows;
  hollows.build(facets_over(pyramid));

  EXPECT_EQ(hollows.hollow_count(4), 0U);
  ASSERT_EQ(hollows.hollow_count(5), 1U);
  const auto shares = hollows.find(5, weights);

  const double all = 4 * (1.0 + 2.0 + 3.0) + 3 * (5.0 + 7.0);
  const double tolerance = 4 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(shares[i], (i < 3 ? 4 : 3) * weights[i] / all, tolerance);
}

TEST(HollowShares, AddUpToTheHollowsHoweverDifferentTheWeightsAre) {
  // Two tetrahedra on both sides of a facet.
  const std::vector<Triangle> pyramid{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4},
                                      {2, 1, 4}, {0, 2, 4}, {0, 1, 2}};
  HollowShares hollows;
  hollows.build(facets_over(pyramid));
  for (const double ratio : {1.0, 1e2, 1e6, 1e12, 1e24}) {
    std::vector<double> weights{1.0};
    while (weights.size() < 5) weights.push_back(ratio * weights.back());

    const auto shares = hollows.find(5, weights);

    ASSERT_EQ(hollows.hollow_count(5), 2U);
    double sum = 0.0;
    for (const double share : shares) {
      EXPECT_GE(share, 0.0);
      sum += share;
    }
    EXPECT_NEAR(sum, 2.0, 1e-14) << ratio;
  }
}

TEST(HollowShares, AreNoneOfASurfaceWithARim) {
  const std::vector<Triangle> cup{{0, 1, 3}, {1, 2, 3}};
  HollowShares hollows;
  hollows.build(facets_over(cup));

  EXPECT_EQ(hollows.hollow_count(4), 0U);
  for (const double share : hollows.find(4, std::vector<double>(4, 1.0))) EXPECT_EQ(share, 0.0);
}

}  // namespace
}  // namespace plekton::contact

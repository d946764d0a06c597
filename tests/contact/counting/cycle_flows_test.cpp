// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_flows.hpp"

#include "tests/support/random_complex.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace plekton::contact::cycle_flows_test {
namespace {

using namespace test;

std::vector<double> resistances_of(std::span<const Link> links) {
  std::vector<double> resistances;
  for (const Link& link : links) resistances.push_back(link.resistance);
  return resistances;
}

/// Of all flows of a complex, by link.
std::vector<double> shares_of(CycleFlows& flows, const std::vector<Link>& links,
                              const std::vector<Filling>& fillings) {
  const std::uint32_t count = links.back().a + 1;
  flows.build(count, links, fillings);
  if (flows.find({count, CycleBasis::kNone}, CycleBasis::kNone, resistances_of(links)) == 0)
    return std::vector<double>(links.size(), 0.0);
  const auto shares = flows.shares(std::vector<double>(links.size(), 0.0));
  return {shares.begin(), shares.end()};
}

/// One filled part after another of random complexes: what each step takes away.
void for_each_step(int trials, double power,
                   const std::function<void(CycleFlows&, std::uint32_t, std::span<const Link>,
                                            std::span<const Filling>, std::span<const Filling>,
                                            std::size_t)>& visit) {
  Random random(1);
  CycleFlows flows;
  for (int trial = 0; trial < trials; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 9));
    const auto links = random_links(random, n, random.integer(1, 22), power);
    auto fillings = random_fillings(random, links, random.integer(0, 20));
    // Cycles that are filled as they close give nothing to see: most get a higher maximum.
    for (Filling& filling : fillings)
      filling.upper = std::min(n - 1, filling.upper + static_cast<std::uint32_t>(random.index(4)));
    std::sort(fillings.begin(), fillings.end(),
              [](const Filling& i, const Filling& k) { return i.upper < k.upper; });
    flows.build(n, links, fillings);
    for (const std::uint32_t maximum : flows.basis().fillers()) {
      const auto part = links_below(links, maximum);
      const std::size_t gone = flows.find({maximum, maximum}, maximum + 1, resistances_of(part));
      visit(flows, maximum, part, fillings_below(fillings, maximum),
            fillings_below(fillings, maximum + 1), gone);
    }
  }
}

/// Of a matrix that may have no columns, and then no place for any.
double squared_row(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  return matrix.cols() == 0 ? 0.0 : matrix.row(row).squaredNorm();
}

TEST(CycleFlows, HaveTheSharesOfTheProjectionOnTheFlowsThatAStepTakesAway) {
  int seen = 0;
  for_each_step(
      300, 2.0,
      [&](CycleFlows& flows, std::uint32_t maximum, std::span<const Link> part,
          std::span<const Filling> before, std::span<const Filling> after, std::size_t gone) {
        // Of the new fillings those that lie in the part alone fill cycles of it; the others close
        // with the links of the maximum. What they fill together is what the number of holes falls
        // by.
        std::vector<Filling> inside(before.begin(), before.end());
        for (const Filling& filling : after.subspan(before.size())) {
          const bool is_inside =
              std::all_of(filling.links.begin(), filling.links.begin() + filling.count,
                          [&](std::uint32_t link) { return link < part.size(); });
          if (is_inside) inside.push_back(filling);
        }
        const Eigen::MatrixXd all = flows_of(maximum, part, before);
        const Eigen::MatrixXd left = flows_of(maximum, part, inside);
        if (static_cast<std::size_t>(all.cols() - left.cols()) != gone) return;
        const auto shares = flows.shares(std::vector<double>(part.size(), 0.0));
        ASSERT_EQ(shares.size(), part.size());
        for (std::size_t i = 0; i < shares.size(); ++i) {
          const auto row = static_cast<Eigen::Index>(i);
          ASSERT_NEAR(shares[i], squared_row(all, row) - squared_row(left, row), 1e-11);
        }
        ++seen;
      });
  EXPECT_GT(seen, 100);
}

TEST(CycleFlows, HaveTheSharesOfTheProjectionOnAllFlowsOfAComplex) {
  Random random(2);
  CycleFlows flows;
  for (int trial = 0; trial < 300; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 9));
    const auto links = random_links(random, n, random.integer(1, 22), 2.0);
    const auto fillings = random_fillings(random, links, random.integer(0, 20));
    const Eigen::MatrixXd all = flows_of(links.back().a + 1, links, fillings);

    const auto shares = shares_of(flows, links, fillings);

    for (std::size_t i = 0; i < shares.size(); ++i)
      ASSERT_NEAR(shares[i], squared_row(all, static_cast<Eigen::Index>(i)), 1e-11);
  }
}

TEST(CycleFlows, HaveSharesThatAddUpToTheHolesHoweverDifferentTheResistancesAre) {
  Random random(3);
  CycleFlows flows;
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 12));
    const auto links = random_links(random, n, random.integer(1, 40), 60.0);

    const auto shares = shares_of(flows, links, {});

    double sum = 0.0;
    for (const double share : shares) {
      ASSERT_GE(share, 0.0);
      ASSERT_LE(share, 1.0 + 1e-12);
      sum += share;
    }
    ASSERT_NEAR(sum, static_cast<double>(flows.basis().hole_count({n, CycleBasis::kNone})), 1e-11);
  }
}

TEST(CycleFlows, AreSharedEvenlyOverASymmetricRing) {
  const std::vector<Link> links{{1, 0, 2.0}, {2, 0, 2.0}, {2, 1, 2.0}};
  CycleFlows flows;

  for (const double share : shares_of(flows, links, {})) EXPECT_DOUBLE_EQ(share, 1.0 / 3.0);
}

TEST(CycleFlows, AreThoseOfParallelWaysHoweverLittleALinkBetweenThemResists) {
  // A cycle over 0, 1 and 2; a triangle that is filled is a second way from 2 to 1, over 3.
  const std::vector<Filling> fillings{{3, {2, 3, 4, 0}, {1, -1, 1, 0}, 3}};
  CycleFlows flows;
  for (const double little : {1e-300, 1e-20, 1e-18, 1e-16, 1e-12, 1e-8, 1e-4, 1.0}) {
    const std::vector<Link> links{
        {1, 0, 1.0}, {2, 0, 2.0}, {2, 1, 3.0}, {3, 1, 3.0}, {3, 2, little}};

    const auto shares = shares_of(flows, links, fillings);

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

TEST(CycleFlows, GrowWithTheResistancesByTheirSlopes) {
  Random random(4);
  int seen = 0;
  for_each_step(300, 1.0,
                [&](CycleFlows& flows, std::uint32_t maximum, std::span<const Link> part,
                    std::span<const Filling>, std::span<const Filling>, std::size_t gone) {
                  std::vector<double> values;
                  for (std::size_t i = 0; i < part.size(); ++i)
                    values.push_back(random.uniform(0.0, 1.0));
                  const auto sum = [&](const std::vector<double>& resistances) {
                    flows.find({maximum, maximum}, maximum + 1, resistances);
                    double total = 0.0;
                    const auto shares = flows.shares(values);
                    for (std::size_t i = 0; i < shares.size(); ++i) total += shares[i] * values[i];
                    return total;
                  };
                  const auto resistances = resistances_of(part);
                  flows.find({maximum, maximum}, maximum + 1, resistances);
                  const auto found = flows.slopes(values);
                  const std::vector<double> slopes(found.begin(), found.end());
                  for (std::size_t i = 0; i < part.size(); ++i) {
                    const double h = 1e-5 * resistances[i];
                    std::vector<double> more = resistances, less = resistances;
                    more[i] += h;
                    less[i] -= h;
                    // Second order in 1e-5, and rounding of 1e-16 over 1e-5.
                    ASSERT_NEAR((sum(more) - sum(less)) / 2e-5, slopes[i] * resistances[i], 1e-8);
                  }
                  seen += gone > 0;
                });
  EXPECT_GT(seen, 100);
}

/// A net, or any graph.
std::vector<Link> random_graph(Random& random, bool is_net, double power) {
  const auto n = static_cast<std::uint32_t>(random.integer(3, is_net ? 7 : 20));
  if (!is_net) return random_links(random, n, random.integer(2, 40), power);
  std::vector<Link> links;
  const auto resistance = [&] { return std::pow(10.0, power * random.uniform(-1.0, 1.0)); };
  for (std::uint32_t i = 1; i < n * n; ++i) {
    if (i % n != 0) links.push_back({i, i - 1, resistance()});
    if (i >= n) links.push_back({i, i - n, resistance()});
  }
  return links;
}

TEST(CycleFlows, AreTheSameOnGraphsAsBesideAFilledRing) {
  Random random(5);
  CycleFlows flows;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Link> links = random_graph(random, trial % 2 == 0, 4.0);
    std::vector<double> values;
    for (std::size_t i = 0; i < links.size(); ++i) values.push_back(random.uniform(0.0, 1.0));
    const std::uint32_t n = links.back().a + 1;
    flows.build(n, links, {});
    if (flows.find({n, CycleBasis::kNone}, CycleBasis::kNone, resistances_of(links)) == 0) continue;
    const auto found = flows.shares(values);
    const std::vector<double> shares(found.begin(), found.end());
    const auto found_slopes = flows.slopes(values);
    const std::vector<double> slopes(found_slopes.begin(), found_slopes.end());

    const auto first = static_cast<std::uint32_t>(links.size());
    links.insert(links.end(), {{n + 1, n, 1.0}, {n + 2, n, 1.0}, {n + 2, n + 1, 1.0}});
    values.insert(values.end(), 3, 0.5);
    const std::vector<Filling> fillings{{n + 2, {first, first + 2, first + 1}, {1, 1, -1}, 3}};
    flows.build(n + 3, links, fillings);
    flows.find({n + 3, CycleBasis::kNone}, CycleBasis::kNone, resistances_of(links));

    const auto others = flows.shares(values);
    const auto other_slopes = flows.slopes(values);
    for (std::size_t i = 0; i < first; ++i) {
      ASSERT_NEAR(shares[i], others[i], 1e-11);
      ASSERT_NEAR(slopes[i] * links[i].resistance, other_slopes[i] * links[i].resistance, 1e-11);
    }
  }
}

TEST(CycleFlows, LeaveEveryBridgeAndKeepSmallSharesToTheirLastDigits) {
  // Two cycles of three links with a bridge between them; of the second one link resists little.
  CycleFlows flows;
  for (const double little : {1e-200, 1e-20, 1e-3}) {
    const std::vector<Link> links{{1, 0, 1.0}, {2, 0, 1.0}, {2, 1, 1.0},   {3, 2, 5.0},
                                  {4, 3, 1.0}, {5, 3, 2.0}, {5, 4, little}};
    const std::vector<double> values{1.0, 2.0, 4.0, 3.0, 1.0, 2.0, 4.0};
    flows.build(6, links, {});
    flows.find({6, CycleBasis::kNone}, CycleBasis::kNone, resistances_of(links));
    const auto shares = flows.shares(values);
    EXPECT_EQ(shares[3], 0.0);
    EXPECT_DOUBLE_EQ(shares[6], little / (3.0 + little));
    // d/dr of (1 * r4 + 2 * r5 + 4 * r6) / (r4 + r5 + r6), by the last.
    EXPECT_NEAR(flows.slopes(values)[6],
                (4.0 * (3.0 + little) - (5.0 + 4.0 * little)) / ((3.0 + little) * (3.0 + little)),
                1e-14);
  }
}

}  // namespace
}  // namespace plekton::contact::cycle_flows_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_basis.hpp"

#include "tests/support/random_complex.hpp"

#include <gtest/gtest.h>

namespace plekton::contact::cycle_basis_test {
namespace {

using namespace test;

/// Sum of drops round a filled cycle.
double sum_round(const Filling& filling, std::span<const double> drops) {
  double sum = 0.0;
  for (std::size_t k = 0; k < filling.count; ++k) sum += filling.signs[k] * drops[filling.links[k]];
  return sum;
}

TEST(CycleBasis, HasADropForEveryHoleThatNoFilledCycleSees) {
  Random random(1);
  CycleBasis basis;
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 9));
    const auto links = random_links(random, n, random.integer(1, 22), 2.0);
    const auto fillings = random_fillings(random, links, random.integer(0, 20));
    basis.build(n, links, fillings);
    for (std::uint32_t below = 1; below <= n; ++below) {
      const auto part = links_below(links, below);
      const auto filled = fillings_below(fillings, below);
      const std::size_t holes = basis.hole_count({below, below});
      std::vector<double> drops(holes * part.size());
      basis.find_drops({below, below}, below, part, drops, {});

      ASSERT_EQ(static_cast<Eigen::Index>(holes), flows_of(below, part, filled).cols());
      for (std::size_t k = 0; k < holes; ++k) {
        const auto row = std::span(drops).subspan(k * part.size(), part.size());
        for (const Filling& filling : filled) ASSERT_EQ(sum_round(filling, row), 0.0);
        ASSERT_TRUE(std::any_of(row.begin(), row.end(), [](double drop) { return drop != 0.0; }));
      }
      seen += holes > 0 && !filled.empty();
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(CycleBasis, HasNoHoleWhereTheOnlyCycleIsFilled) {
  const std::vector<Link> links{{1, 0}, {2, 0}, {2, 1}, {3, 2}};
  for (const std::uint32_t upper : {2U, 3U}) {
    const std::vector<Filling> fillings{{upper, {0, 1, 2, 0}, {1, -1, 1, 0}, 3}};
    CycleBasis basis;
    basis.build(4, links, fillings);

    EXPECT_EQ(basis.hole_count({4, 4}), 0U);
    EXPECT_EQ(basis.hole_count({3, 3}), upper - 2);
    // Filled as it closes it is no event, and its last link joins nothing and opens no hole.
    EXPECT_EQ(basis.fillers().size(), upper - 2);
    EXPECT_EQ(basis.branches()[2], upper - 1);
  }
}

}  // namespace
}  // namespace plekton::contact::cycle_basis_test

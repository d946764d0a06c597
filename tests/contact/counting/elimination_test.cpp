// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/elimination.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plekton::contact::elimination_test {
namespace {

using test::Random;

std::vector<Link> random_links(Random& random, std::uint32_t n, int count) {
  std::vector<Link> links;
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(1 + random.index(n - 1));
    links.push_back({a, static_cast<std::uint32_t>(random.index(a))});
  }
  std::sort(links.begin(), links.end(), [](const Link& i, const Link& k) { return i.a < k.a; });
  return links;
}

TEST(Elimination, LeavesDropsWhoseCurrentsHaveNoSources) {
  Random random(1);
  Elimination elimination;
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 40));
    const auto links = random_links(random, n, random.integer(1, 80));
    elimination.plan(n, links);
    for (const std::uint32_t part : {n, (n + 1) / 2, n}) {
      std::vector<double> conductances, drops;
      for (const Link& link : links) {
        if (link.a >= part) break;
        conductances.push_back(random.uniform(0.1, 1.0));
        drops.push_back(random.uniform(-1.0, 1.0));
      }
      std::vector<double> left = drops;

      elimination.eliminate(part, conductances);
      std::vector<double> differences(elimination.join_count());
      elimination.relax(left, differences);

      std::vector<double> sources(part, 0.0);
      double sum = 0.0, least = 0.0, work = 0.0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        sources[links[i].a] += conductances[i] * left[i];
        sources[links[i].b] -= conductances[i] * left[i];
        sum += conductances[i] * left[i] * left[i];
        // What was taken off is a gradient: no current without sources does work on it.
        work += conductances[i] * left[i] * (drops[i] - left[i]);
      }
      for (std::size_t k = 0; k < differences.size(); ++k)
        least += elimination.weight(k) * differences[k] * differences[k];
      for (const double source : sources) ASSERT_NEAR(source, 0.0, 1e-12);
      ASSERT_NEAR(work, 0.0, 1e-12);
      ASSERT_NEAR(sum, least, 1e-12);
    }
  }
}

TEST(Elimination, FindsTheSmallDropsOfGoodConductorsToTheLastDigit) {
  // A drop of 1 along the first link of a cycle: the current is 1 over the sum of the resistances.
  const std::vector<Link> links{{1, 0}, {2, 1}, {3, 2}, {3, 0}};
  for (const double good : {1e12, 1e40, 1e90}) {
    const std::vector<double> conductances{1.0, good, 2.0, 1e3 * good};
    Elimination elimination;
    elimination.plan(4, links);
    elimination.eliminate(4, conductances);
    std::vector<double> drops{1.0, 0.0, 0.0, 0.0};
    std::vector<double> differences(elimination.join_count());

    elimination.relax(drops, differences);

    const double current = 1.0 / (1.0 + 1.0 / good + 0.5 + 1.0 / (1e3 * good));
    const std::array<double, 4> signs{1.0, 1.0, 1.0, -1.0};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(conductances[i] * drops[i], signs[i] * current, 1e-15);
  }
}

TEST(Elimination, CouplesALongChainNoMoreThanItsLinksDo) {
  // Minimum degree on a tree adds no coupling: as many as there are links.
  std::vector<Link> links;
  for (std::uint32_t i = 1; i < 1000; ++i) links.push_back({i, (i - 1) / 2});
  Elimination elimination;

  elimination.plan(1000, links);

  EXPECT_EQ(elimination.coupling_count(), links.size());
}

}  // namespace
}  // namespace plekton::contact::elimination_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/elimination.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plekton::contact {
namespace {

using test::Random;

std::vector<Link> random_links(Random& random, std::uint32_t n, int count) {
  std::vector<Link> links;
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(1 + random.index(n - 1));
    links.push_back({a, static_cast<std::uint32_t>(random.index(a)), 0.0});
  }
  std::sort(links.begin(), links.end(), [](const Link& i, const Link& k) { return i.a < k.a; });
  return links;
}

TEST(Elimination, FindsThePotentialsWhoseCurrentsTheSourcesFeed) {
  Random random(1);
  Elimination elimination;
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 40));
    const auto links = random_links(random, n, random.integer(1, 80));
    elimination.plan(n, links);
    for (const std::uint32_t part : {n, (n + 1) / 2, n}) {
      // Currents along the links are sources that add up to 0 in each piece.
      std::vector<double> conductances;
      std::vector<double> sources(part, 0.0);
      for (const Link& link : links) {
        if (link.a >= part) break;
        conductances.push_back(random.uniform(0.1, 1.0));
        const double current = random.uniform(-1.0, 1.0);
        sources[link.a] += current;
        sources[link.b] -= current;
      }
      std::vector<double> potentials = sources;

      elimination.eliminate(part, conductances);
      elimination.solve(potentials);

      for (std::size_t i = 0; i < conductances.size(); ++i) {
        const Link& link = links[i];
        const double current = conductances[i] * (potentials[link.a] - potentials[link.b]);
        sources[link.a] -= current;
        sources[link.b] += current;
      }
      for (const double left : sources) ASSERT_NEAR(left, 0.0, 1e-11);
    }
  }
}

TEST(Elimination, IsAccurateHoweverDifferentTheConductancesAre) {
  // A chain: a current of 1 from end to end drops by 1 / conductance along each link.
  const std::vector<Link> links{{1, 0, 0.0}, {2, 1, 0.0}, {3, 2, 0.0}, {4, 3, 0.0}};
  const std::vector<double> conductances{1e-12, 1e12, 1.0, 1e-12};
  Elimination elimination;
  elimination.plan(5, links);
  elimination.eliminate(5, conductances);
  std::vector<double> potentials{-1.0, 0.0, 0.0, 0.0, 1.0};

  elimination.solve(potentials);

  EXPECT_NEAR(potentials[1] - potentials[0], 1e12, 1e-3);
  EXPECT_NEAR(potentials[4] - potentials[3], 1e12, 1e-3);
}

TEST(Elimination, CouplesALongChainNoMoreThanItsLinksDo) {
  // Minimum degree on a tree adds no coupling: as many as there are links.
  std::vector<Link> links;
  for (std::uint32_t i = 1; i < 1000; ++i) links.push_back({i, (i - 1) / 2, 0.0});
  Elimination elimination;

  elimination.plan(1000, links);

  EXPECT_EQ(elimination.coupling_count(), links.size());
}

}  // namespace
}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_flows.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/moving_scene.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::test::allocation_test {
namespace {

using contact::CycleBasis;
using contact::CycleFlows;
using contact::Link;

TEST(Allocation, IsCountedAlsoWhereEigenAsksForIt) {
#if !PLEKTON_COUNTS_MALLOC
  GTEST_SKIP() << "this malloc cannot be counted";
#endif
  EXPECT_GE(allocations_of([] {
              const volatile double entry = Eigen::VectorXd::Ones(500).eval().sum();
              static_cast<void>(entry);
            }),
            1u);
}

/// Forth and back, so that the second time shows what the first one showed.
std::size_t allocations_of_swings(MovingScene& scene) {
  const auto swing = [&] {
    for (int step = 0; step < 50; ++step) scene.step(2e-3);
    for (int step = 0; step < 50; ++step) scene.step(-2e-3);
  };
  swing();
  swing();
  return allocations_of(swing);
}

TEST(Allocation, DoesNotHappenWhenWarmContactsAdvance) {
  // A wide skin: the lists are made once.
  for (const int threads : {1, 2}) {
    MovingScene scene(200, 1.0, 3, threads);

    EXPECT_EQ(allocations_of_swings(scene), 0u) << threads << " threads";
    EXPECT_EQ(scene.contacts().neighbours().rebuild_count(), 1);
  }
}

TEST(Allocation, DoesNotHappenWhenWarmListsAreMadeAnew) {
  for (const int threads : {1, 2}) {
    MovingScene scene(200, 0.02, 3, threads);

    EXPECT_EQ(allocations_of_swings(scene), 0u) << threads << " threads";
    // In three swings, so at least three in the one that was counted.
    EXPECT_GE(scene.contacts().neighbours().rebuild_count(), 12);
  }
}

/// A ladder: as many rings in a row as it has steps, which share their sides.
std::vector<Link> ladder(std::uint32_t steps) {
  std::vector<Link> links;
  for (std::uint32_t i = 0; i < steps; ++i) {
    if (i == 0) links.push_back({1, 0});
    links.push_back({2 * i + 2, 2 * i});
    links.push_back({2 * i + 3, 2 * i + 1});
    links.push_back({2 * i + 3, 2 * i + 2});
  }
  return links;
}

TEST(Allocation, DoesNotHappenWhenWarmRingsShareWhatTheyGiveBack) {
  std::vector<std::vector<Link>> ladders;
  for (std::uint32_t steps = 1; steps <= 30; ++steps) ladders.push_back(ladder(steps));
  std::vector<double> resistances;
  for (std::size_t i = 0; i < ladders.back().size(); ++i)
    resistances.push_back(1.0 + 0.1 * static_cast<double>(i));
  CycleFlows rings;
  const auto find = [&](const std::vector<Link>& links) {
    const std::uint32_t count = links.back().a + 1;
    rings.build(count, links, {});
    rings.find({count, CycleBasis::kNone}, CycleBasis::kNone,
               std::span(resistances).first(links.size()));
    const auto values = std::span(resistances).first(links.size());
    rings.shares(values);
    rings.slopes(values);
  };
  find(ladders.back());

  const std::size_t count = allocations_of([&] {
    for (const std::vector<Link>& links : ladders) find(links);
  });

  EXPECT_EQ(count, 0u);
}

}  // namespace
}  // namespace plekton::test::allocation_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/move_slots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace plekton::contact::move_slots_test {
namespace {

struct Thing {
  int number = -1;
  bool operator==(const Thing&) const = default;
};

std::vector<Thing> moved(std::vector<Thing> things, std::vector<std::uint32_t> sources) {
  std::vector<bool> scratch;
  move_slots(
      sources, scratch, [&](std::uint32_t slot) { return things[slot]; },
      [&](std::uint32_t slot, const Thing& thing) { things[slot] = thing; });
  EXPECT_EQ(std::ranges::count(sources, kNoSlot), static_cast<std::ptrdiff_t>(sources.size()));
  return things;
}

TEST(MoveSlots, TurnRings) {
  EXPECT_EQ(moved({{0}, {1}, {2}, {3}}, {1, 2, 0, 3}), (std::vector<Thing>{{1}, {2}, {0}, {3}}));
}

TEST(MoveSlots, LeaveNewThingsWhereNothingComesFrom) {
  EXPECT_EQ(moved({{0}, {1}, {2}}, {2, 0, kNoSlot}), (std::vector<Thing>{{2}, {0}, {-1}}));
  EXPECT_EQ(moved({{0}, {1}}, {kNoSlot, kNoSlot}), (std::vector<Thing>{{-1}, {-1}}));
}

TEST(MoveSlots, DoAsACopyWould) {
  std::mt19937 random(3);
  for (std::uint32_t count = 0; count < 200; ++count) {
    std::vector<Thing> things(count);
    for (std::uint32_t i = 0; i < count; ++i) things[i].number = static_cast<int>(i);
    std::vector<std::uint32_t> sources(count);
    std::iota(sources.begin(), sources.end(), 0U);
    std::shuffle(sources.begin(), sources.end(), random);
    for (std::uint32_t& source : sources)
      if (random() % 4 < count % 4) source = kNoSlot;
    std::vector<Thing> expected(count);
    for (std::uint32_t i = 0; i < count; ++i)
      if (sources[i] != kNoSlot) expected[i] = things[sources[i]];

    EXPECT_EQ(moved(things, sources), expected);
  }
}

}  // namespace
}  // namespace plekton::contact::move_slots_test

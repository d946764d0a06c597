// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/lanes.hpp"

#include "geometry/base/vector_width.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <vector>

namespace plekton::geometry::lanes_test {
namespace {

/// 0, 1, 2, ...: every number tells where it was.
std::vector<double> counted(std::size_t count) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

template <int W>
double lane(const Pack<W>& pack, int l) {
  return pack.lanes[l];
}

template <class Width>
class Lanes : public testing::Test {};
using Widths = testing::Types<Width<1>, Width<2>, Width<4>, Width<8>>;
TYPED_TEST_SUITE(Lanes, Widths);

template <int W, int N>
void expect_things_in_a_row_are_loaded_and_stored() {
  using Thing = std::array<double, std::size_t{N}>;
  std::vector<Thing> things(std::size_t{W}), copies(std::size_t{W});
  for (int l = 0; l < W; ++l)
    for (int n = 0; n < N; ++n)
      things[static_cast<std::size_t>(l)][static_cast<std::size_t>(n)] = l * N + n;

  const auto packs = load_things<W, N>(things.data());
  store_things<W, N>(packs, copies.data());

  for (int n = 0; n < N; ++n) {
    for (int l = 0; l < W; ++l) EXPECT_EQ(lane(packs[static_cast<std::size_t>(n)], l), l * N + n);
  }
  EXPECT_EQ(copies, things);
}

TYPED_TEST(Lanes, HoldThingsThatLieOneAfterTheOther) {
  expect_things_in_a_row_are_loaded_and_stored<TypeParam::value, 3>();
  expect_things_in_a_row_are_loaded_and_stored<TypeParam::value, 4>();
}

/// Loads parts of the things whose numbers start at at(lane).
template <class At>
auto part_at(const At& at) {
  return [&at](std::size_t lane, auto part) {
    return decltype(part)::Pack::load(at(lane) + part.first);
  };
}

template <int W, int N>
void expect_things_anywhere_are_gathered() {
  const std::vector<double> numbers = counted(100);
  const auto at = [&](std::size_t l) { return numbers.data() + 3 + (7 * l) % 31; };

  const auto packs = gather_things<W, N>(part_at(at));

  for (int n = 0; n < N; ++n) {
    for (int l = 0; l < W; ++l)
      EXPECT_EQ(lane(packs[static_cast<std::size_t>(n)], l), at(static_cast<std::size_t>(l))[n]);
  }
}

TYPED_TEST(Lanes, HoldThingsThatLieAnywhere) {
  expect_things_anywhere_are_gathered<TypeParam::value, 4>();
  expect_things_anywhere_are_gathered<TypeParam::value, 8>();
}

TYPED_TEST(Lanes, ScatterThingsInTheOrderOfTheLanes) {
  constexpr int W = TypeParam::value;
  const std::vector<double> numbers = counted(8 * W);
  std::vector<double> scattered(9 * W, -1.0);

  // One place is used by two lanes in turn: the last one stays.
  const auto place = [](std::size_t l) { return l == 1 ? 0 : 9 * l; };
  scatter_things<W, 8>(
      gather_things<W, 8>(part_at([&](std::size_t l) { return numbers.data() + 8 * l; })),
      [&](std::size_t l) { return scattered.data() + place(l); });

  for (std::size_t l = W > 1 ? 1 : 0; l < std::size_t{W}; ++l) {
    for (std::size_t n = 0; n < 8; ++n) EXPECT_EQ(scattered[place(l) + n], numbers[8 * l + n]);
  }
}

template <int W, int N>
void expect_things_are_added_lane_by_lane() {
  const std::vector<double> numbers = counted(std::size_t{2 * W * N});
  const auto things = [&](std::size_t side) {
    return gather_things<W, N>(
        part_at([&, side](std::size_t l) { return numbers.data() + N * (2 * l + side); }));
  };
  // Rounded away unless what is added first is: the sums tell the order. All but one thing of every
  // third lane go to the same sum.
  const auto place = [](std::size_t side, std::size_t l) {
    return std::size_t{N} * (side == 1 && l % 3 == 1 ? l : 0);
  };
  std::vector<double> sums(std::size_t{W * N}, 1e16);
  std::vector<double> expected = sums;

  add_things<W, N>(things(0), things(1),
                   [&](std::size_t side, std::size_t l) { return sums.data() + place(side, l); });

  for (std::size_t l = 0; l < std::size_t{W}; ++l) {
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t n = 0; n < std::size_t{N}; ++n)
        expected[place(side, l) + n] += numbers[N * (2 * l + side) + n];
    }
  }
  EXPECT_EQ(sums, expected);
}

TYPED_TEST(Lanes, AddThingsToSumsInTheOrderOfTheLanes) {
  if constexpr (TypeParam::value <= 4) expect_things_are_added_lane_by_lane<TypeParam::value, 4>();
  expect_things_are_added_lane_by_lane<TypeParam::value, 8>();
}

TYPED_TEST(Lanes, GiveTheirFlagsAsBits) {
  constexpr int W = TypeParam::value;
  for (unsigned bits = 0; bits <= kAllBits<W>; ++bits) {
    Pack<W> numbers;
    for (int l = 0; l < W; ++l) numbers.lanes[l] = (bits >> l & 1U) != 0 ? 2.5 : -1.0;

    EXPECT_EQ(bits_of(flag(numbers > Pack<W>(0.0))), bits);
  }
}

}  // namespace
}  // namespace plekton::geometry::lanes_test

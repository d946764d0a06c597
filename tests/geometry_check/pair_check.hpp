// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/core_pair.hpp"
#include "tests/geometry_check/tally.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace plekton::geometry_check {

/// What is checked: nearest points of two cores.
using Kernel = std::function<geometry::ClosestPoints(const geometry::Core&, const geometry::Core&)>;

/// The six pairs of primitives, by the corners of their cores, and the families of inputs of each.
struct PairKind {
  const char* name;
  std::size_t corners_a;
  std::size_t corners_b;
};
inline constexpr PairKind kPairKinds[] = {{"sphere-sphere", 1, 1},  {"sphere-cylinder", 1, 2},
                                          {"sphere-facet", 1, 3},   {"cylinder-cylinder", 2, 2},
                                          {"cylinder-facet", 2, 3}, {"facet-facet", 3, 3}};

/// The rows of the table, without any queries yet.
std::vector<PairTally> pair_rows();

/// Puts a kernel to queries of a row's family, each judged in exact rational arithmetic, asked from
/// both sides, and asked again with all corners moved a little.
/// @param examples  gets a line for each of the first violations
void check_pairs(PairTally& row, std::uint64_t queries, std::uint64_t seed, const Kernel& kernel,
                 std::vector<std::string>& examples);

}  // namespace plekton::geometry_check

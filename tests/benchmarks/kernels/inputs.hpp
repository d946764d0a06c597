// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/simplex_families.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// Pairs of cores that the benchmarks of closest points and of pairs of primitives ask about.
namespace plekton::benchmarks {

using geometry::Mat3;
using geometry::Vec3;
using test::PairFamily;

template <std::size_t kCountA, std::size_t kCountB>
using CorePairs = std::vector<test::SimplexPair<kCountA, kCountB>>;

/// Families of tests/support/simplex_families.hpp, seeded.
template <std::size_t kCountA, std::size_t kCountB>
CorePairs<kCountA, kCountB> core_pairs(PairFamily family) {
  test::SimplexFamilies<kCountA, kCountB> families(1);
  CorePairs<kCountA, kCountB> pairs;
  while (pairs.size() < kConfigurations) pairs.push_back(families.draw(family));
  return pairs;
}

/// Corners of a cell of a lattice of unit squares that are cut along a diagonal, in z = 0.
template <std::size_t kCount>
std::array<Vec3, kCount> lattice_cell(test::Random& random) {
  std::array<Vec3, kCount> x;
  x[0] = Vec3::Zero();
  if constexpr (kCount > 1) x[1] = random.coin() ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  if constexpr (kCount > 2) x[2] = Vec3(1, 1, 0);
  return x;
}

inline void turn_corners(std::span<Vec3> corners, const Mat3& turn) {
  for (Vec3& corner : corners) corner = turn * corner;
}

/// What regular meshes do to exact arithmetic: a cell of a flat lattice (a) 0.1 to 0.5 above a cell
/// of another one (b), shifted by quarters of the spacing. Corners lie over corners, sides and
/// diagonals, so that most regions and nearest features are ties.
/// @param turned  whether each pair is turned at random: then the ties hold up to rounding only
template <std::size_t kCountA, std::size_t kCountB>
CorePairs<kCountA, kCountB> lattice_pairs(bool turned) {
  test::Random random(1);
  CorePairs<kCountA, kCountB> pairs;
  while (pairs.size() < kConfigurations) {
    auto a = lattice_cell<kCountA>(random);
    auto b = lattice_cell<kCountB>(random);
    const double x = 0.25 * random.integer(-4, 4);
    const double y = 0.25 * random.integer(-4, 4);
    const double height = random.uniform(0.1, 0.5);
    for (Vec3& corner : a) corner += Vec3(x, y, height);
    if (turned) {
      const Mat3 turn = random.rotation();
      turn_corners(a, turn);
      turn_corners(b, turn);
    }
    pairs.push_back({a, b});
  }
  return pairs;
}

}  // namespace plekton::benchmarks

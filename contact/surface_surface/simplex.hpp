// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/tilt_share.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace plekton::contact::structure {

using geometry::Vec3;

/// A node, an edge or a facet, where it is now.
struct Simplex {
  std::array<Vec3, 3> x;          ///< m; only the first count are used
  std::size_t count = 0;          ///< 1, 2 or 3
  std::array<bool, 3> is_seam{};  ///< side k, from corner k to k + 1: whether facets lie on both
                                  ///< sides of it; of an edge: whether facets lie on it
};

/// Whether it is an edge without facets.
inline bool is_cylinder(const Simplex& s) {
  return s.count == 2 && !s.is_seam[0];
}

/// By the order of the corners; as long as twice the area.
inline Vec3 area_normal_of(const Simplex& facet) {
  return (facet.x[1] - facet.x[0]).cross(facet.x[2] - facet.x[0]);
}
/// Unit.
inline Vec3 normal_of(const Simplex& facet) {
  return area_normal_of(facet).normalized();
}

/// Whether the corners of a facet lie on one line but for rounding, as those of a sliver at a joint
/// of two edges that are divided otherwise: the product of two sides is off by some 1e-16 of the
/// longest one squared, so that the normal of what is left is off by more than 1e-4. Such a facet
/// counts as one without a normal.
inline bool is_needle(const Simplex& facet) {
  const Vec3 u = facet.x[1] - facet.x[0];
  const Vec3 v = facet.x[2] - facet.x[0];
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
  return !(u.cross(v).norm() > 1e-12 * longest);
}
/// The first corner of the longest side of a facet.
inline std::size_t longest_side_of(const Simplex& facet) {
  const auto length = [&](std::size_t k) {
    return (facet.x[(k + 1) % 3] - facet.x[k]).squaredNorm();
  };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (length(k) > length(longest)) longest = k;
  return longest;
}

/// What a pair of simplices adds to the energy, and what pushes their nodes.
struct PairForces {
  double energy = 0.0;                                                 ///< J
  std::array<Vec3, 3> on_a{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< N
  std::array<Vec3, 3> on_b{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< N
};

enum class Side : int { a = 0, b = 9 };

/// A corner whose coordinates are variables.
inline Vector corner(const Simplex& simplex, std::size_t i, Side side) {
  const int first = static_cast<int>(side) + 3 * static_cast<int>(i);
  const Vec3& x = simplex.x[i];
  return {Real::variable(x[0], first), Real::variable(x[1], first + 1),
          Real::variable(x[2], first + 2)};
}

inline std::array<Vector, 3> corners(const Simplex& facet, Side side) {
  return {corner(facet, 0, side), corner(facet, 1, side), corner(facet, 2, side)};
}

/// An energy of which the corners of both sides are the variables.
inline PairForces forces_of(const Real& energy) {
  PairForces pair;
  pair.energy = energy.value;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      pair.on_a[static_cast<std::size_t>(i)][k] = -energy.slopes[3 * i + k];
      pair.on_b[static_cast<std::size_t>(i)][k] = -energy.slopes[9 + 3 * i + k];
    }
  }
  return pair;
}

}  // namespace plekton::contact::structure

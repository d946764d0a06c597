// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/dual.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

/// Where an edge is nearest to a facet or to another edge that it is parallel to: everywhere at
/// once. Whichever end of the part side by side a rounding error picks, the next one picks the
/// other, half a length away. So each end gets the share of small tilts that would make it the
/// nearest: the edge is imagined tilted by every slope t with |t| <= kLargestTilt, as its
/// projections of a disc of slopes are distributed. A level edge shares evenly, a tilt moves the
/// shares continuously, and one beyond kLargestTilt leaves a single nearest end. The shares add up
/// to 1.
namespace plekton::contact::structure {

/// Derivatives by the coordinates of at most three nodes on either side.
using Real = geometry::Dual<18>;
using Vector = geometry::PackVec3<Real>;

/// The slope up to which bodies count as parallel. It sets how stiffly nearly parallel bodies
/// resist a tilt, force / (kLargestTilt * length), and by how much a contact of crossing edges
/// reaches past its nearest point: kLargestTilt^2 / 2 of the distance. 0.02 degrees is below what a
/// mesh of any real body means.
inline constexpr double kLargestTilt = 3e-4;

/// What a number is now.
inline double still(const Real& x) {
  return x.value;
}
inline double still(double x) {
  return x;
}

/// Where a vector is now.
template <class Number>
geometry::Vec3 still(const geometry::PackVec3<Number>& v) {
  return {still(v.x), still(v.y), still(v.z)};
}

/// A vector without derivatives: formulas of it have the same values, in a twentieth of the time.
inline geometry::PackVec3<double> now(const Vector& v) {
  return {v.x.value, v.y.value, v.z.value};
}

/// Of a vector without length: itself.
template <class Number>
geometry::PackVec3<Number> unit(const geometry::PackVec3<Number>& v) {
  const Number length = v.norm();
  return still(length) > 0.0 ? (Number(1.0) / length) * v : v;
}

/// Integral of 2 sqrt(1 - x^2) from 0: half the area of the unit disc between the lines at -x and
/// x; constant beyond the rim.
inline Real strip_area(const Real& x) {
  const double inside = std::clamp(x.value, -1.0, 1.0);
  const double half_chord = std::sqrt(1.0 - inside * inside);
  return geometry::chain(x, inside * half_chord + elementary::asin(inside), 2.0 * half_chord);
}

/// Share of the tilts under which a line of this slope rises.
inline Real share_rising(const Real& slope) {
  return Real(0.5) + (1.0 / std::numbers::pi) * strip_area((1.0 / kLargestTilt) * slope);
}

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/dual.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

/// Where two bodies are nearest when they are parallel: everywhere at once. Whichever corner of
/// their overlap a rounding error picks, the next one picks another, half a length away. So each
/// corner gets the share of small tilts that would make it the nearest: one body is imagined tilted
/// by every slope vector t with |t| <= kLargestTilt, all alike. Exactly parallel bodies share
/// evenly (each corner by its exterior angle), a tilt moves the shares continuously, and one beyond
/// kLargestTilt leaves a single nearest corner, as without all this.
///
/// The shares of a convex overlap add up to 1, and for every single tilt the weights of
/// product_features.hpp count its corners once; so do their means: the sum over the pairs of
/// features of two flat sheets is one contact, in any triangulation.
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
  return geometry::chain(x, inside * half_chord + std::asin(inside), 2.0 * half_chord);
}

/// Share of the tilts under which a line of this slope rises.
inline Real share_rising(const Real& slope) {
  return Real(0.5) + (1.0 / std::numbers::pi) * strip_area((1.0 / kLargestTilt) * slope);
}

/// The slopes of a plane under all tilts: a disc around its own slope. In units of kLargestTilt.
class TiltedSlopes {
 public:
  /// @param slope  of the plane, perpendicular to axis
  /// @param axis   unit
  TiltedSlopes(const Vector& slope, const Vector& axis);

  /// Share of the tilts whose slope lies in the sector from one direction, counterclockwise about
  /// the axis by less than half a turn, to another. Both are unit and perpendicular to the axis.
  Real share_between(const Vector& from, const Vector& to) const;

 private:
  Real swept_to(const Vector& direction) const;
  double angle_of(const Vector& direction) const;
  bool passes_the_cut(const Vector& from, const Vector& to) const;

  Vector centre_;
  Vector axis_;
  Vector zero_angle_;
  Vector quarter_turn_;
  bool holds_origin_;
};

}  // namespace plekton::contact::structure

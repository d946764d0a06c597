// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/tilt_share.hpp"

namespace plekton::contact::structure {
namespace {

/// The same direction, without derivatives.
Vector frozen(const Vector& v) {
  return {v.x.value, v.y.value, v.z.value};
}

/// Turn from one direction to another about the axis, as far as its sign goes.
double turn(const Vector& from, const Vector& to, const Vector& axis) {
  return axis.dot(from.cross(to)).value;
}

}  // namespace

TiltedSlopes::TiltedSlopes(const Vector& slope, const Vector& axis)
    : centre_((1.0 / kLargestTilt) * slope), axis_(axis) {
  const Vector n = frozen(axis);
  const Vector aside = std::abs(n.x.value) < 0.6 ? Vector{1.0, 0.0, 0.0} : Vector{0.0, 1.0, 0.0};
  zero_angle_ = frozen(unit(n.cross(aside)));
  quarter_turn_ = frozen(n.cross(zero_angle_));
  holds_origin_ = centre_.squaredNorm().value <= 1.0;
}

double TiltedSlopes::angle_of(const Vector& direction) const {
  return std::atan2(direction.dot(quarter_turn_).value, direction.dot(zero_angle_).value);
}

/// Area of the disc that a ray from the origin sweeps, up to a direction, from where the count
/// starts. With the ray's direction at an angle psi to the centre, at distance a from the origin,
/// the ray leaves the disc at rho = a cos psi + sqrt(1 - a^2 sin^2 psi), and enters it, from
/// outside, at the other root; half the integral of (difference of) rho^2 over psi is elementary.
Real TiltedSlopes::swept_to(const Vector& direction) const {
  const Real along = centre_.dot(direction);
  const Real across = axis_.dot(centre_.cross(direction));
  if (!holds_origin_) {
    if (along.value > 0.0) return strip_area(across);
    return {across.value >= 0.0 ? 0.5 * std::numbers::pi : -0.5 * std::numbers::pi};
  }
  const Vector still = frozen(direction);
  const Real turned = still.dot(zero_angle_) * direction.dot(quarter_turn_) -
                      still.dot(quarter_turn_) * direction.dot(zero_angle_);
  const Real angle = geometry::chain(turned, angle_of(direction), 1.0);
  return 0.5 * (angle + along * across + strip_area(across));
}

/// Where the count of swept_to jumps back by the whole area.
bool TiltedSlopes::passes_the_cut(const Vector& from, const Vector& to) const {
  if (holds_origin_) return angle_of(to) < angle_of(from);
  const Vector away = -1.0 * centre_;
  return turn(from, away, axis_) >= 0.0 && turn(away, to, axis_) > 0.0;
}

Real TiltedSlopes::share_between(const Vector& from, const Vector& to) const {
  const Real swept = swept_to(to) - swept_to(from);
  const double whole = passes_the_cut(from, to) ? std::numbers::pi : 0.0;
  return (1.0 / std::numbers::pi) * (swept + Real(whole));
}

}  // namespace plekton::contact::structure

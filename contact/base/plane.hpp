// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"
#include "geometry/primitives/elements.hpp"

#include <cmath>
#include <cstdint>

namespace plekton::contact {

using geometry::Vec3;

/// A rigid wall: a half-space (a floor, a plate), or the inside of a cylinder without ends or of a
/// ball (a container, a drum). The space that it leaves to the bodies is convex, so that a bar or a
/// facet touches it with the balls of its nodes first. It moves with a velocity of its own, and may
/// turn about its axis of symmetry; a container may get wider or narrower.
struct Plane {
  enum class Form : std::uint8_t { flat, cylinder, sphere };

  Vec3 point;  ///< m, any point of a flat one, on the axis of a cylinder, the centre of a ball
  /// Unit, of a flat one: out of the solid, into the space of the bodies; of others of no meaning.
  Vec3 normal = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  ///< m/s
  MaterialId material{};
  Form form = Form::flat;
  double radius = 0.0;            ///< m, of a cylinder or ball
  Vec3 axis = Vec3::Zero();       ///< unit, of a cylinder, and about which the others turn
  double angular_velocity = 0.0;  ///< rad/s, about the axis through the point
  double widening = 0.0;          ///< m/s, of the radius; 0 of a flat one

  /// m, of a place over the wall; negative beyond it.
  double height(const Vec3& x) const noexcept {
    return form == Form::flat ? (x - point).dot(normal) : radius - from_middle(x).norm();
  }
  /// Unit, into the space of the bodies, at the point of the wall that is nearest to a place; any
  /// one of those that are at the middle of a container.
  Vec3 normal_at(const Vec3& x) const noexcept {
    if (form == Form::flat) return normal;
    const Vec3 way = from_middle(x);
    const double distance = way.norm();
    if (distance > 0.0) return way / -distance;
    return normal_in_the_middle();
  }
  /// m, the point of the wall that is nearest to a place.
  Vec3 foot(const Vec3& x) const noexcept { return x - height(x) * normal_at(x); }

  /// Of a flat one its normal, of a cylinder its axis, 0 of a sphere: in files, beside the radius.
  Vec3 direction() const noexcept {
    if (form == Form::sphere) return Vec3::Zero();
    return form == Form::flat ? normal : axis;
  }

  /// Whether the wall turns.
  bool turns() const noexcept { return angular_velocity != 0.0; }
  /// rad/s.
  Vec3 turning() const noexcept {
    return turns() ? Vec3(angular_velocity * axis) : Vec3(Vec3::Zero());
  }
  /// m/s, of the solid at a place.
  Vec3 velocity_at(const Vec3& x) const noexcept {
    Vec3 sum = velocity;
    if (turns()) sum += turning().cross(x - point);
    if (widening != 0.0) sum -= widening * normal_at(x);
    return sum;
  }

  /// m/s, the fastest that the wall may come nearer to anything: turning brings it no nearer.
  double speed() const noexcept { return velocity.norm() + std::abs(widening); }

  /// N/m, how a force (N) along the normal resists a motion across it: the wall comes nearer on
  /// both sides of the lowest place of a bowl.
  double turning_stiffness(const Vec3& x, double force) const noexcept {
    if (form == Form::flat) return 0.0;
    const double distance = from_middle(x).norm();
    return distance > 0.0 ? force / distance : 0.0;
  }

 private:
  /// Unit, any one of those that are nearest to the middle of a container.
  Vec3 normal_in_the_middle() const noexcept;
  /// m, from the axis of a cylinder or the centre of a ball.
  Vec3 from_middle(const Vec3& x) const noexcept {
    const Vec3 way = x - point;
    return form == Form::cylinder ? Vec3(way - way.dot(axis) * axis) : way;
  }
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

namespace plekton::dynamics {

/// What forces come to, about a point that is said with it.
struct ForceAndMoment {
  geometry::Vec3 force = geometry::Vec3::Zero();   ///< N
  geometry::Vec3 moment = geometry::Vec3::Zero();  ///< N m

  /// Adds a force (N) and a moment (N m) that act at a lever (m) from the point.
  void add(const geometry::Vec3& lever, const geometry::Vec3& other_force,
           const geometry::Vec3& other_moment) noexcept {
    force += other_force;
    moment += lever.cross(other_force) + other_moment;
  }
};

}  // namespace plekton::dynamics

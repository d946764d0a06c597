// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/primitives/proximity.hpp"

/// How a point of an element follows its nodes, and how a force there reaches them. The two
/// functions are transposes of each other, side by side: the power of a force at a point is the
/// power it brings to the nodes, and its moment is the nodes' moment, to round-off, for every
/// primitive.
namespace plekton::contact {

/// Velocity (m/s) of the material point that is at lever (m) from a core point: v = sum w_i (v_i +
/// omega_i x lever).
inline Vec3 velocity_at(const geometry::CorePoint& core, const Vec3& lever,
                        const Motion& motion) noexcept {
  Vec3 velocity = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t node = index_of(core.nodes[i]);
    velocity += core.weights[static_cast<int>(i)] *
                (motion.velocity[node] + motion.angular_velocity[node].cross(lever));
  }
  return velocity;
}

/// Angular velocity (rad/s) of the element at a core point: sum w_i omega_i.
inline Vec3 angular_velocity_at(const geometry::CorePoint& core, const Motion& motion) noexcept {
  Vec3 angular_velocity = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    angular_velocity +=
        core.weights[static_cast<int>(i)] * motion.angular_velocity[index_of(core.nodes[i])];
  }
  return angular_velocity;
}

/// Adds a force (N) that acts at lever (m) from a core point: F_i += w_i F, T_i += w_i lever x F.
inline void add_force_at(const geometry::CorePoint& core, const Vec3& lever, const Vec3& force,
                         NodeForces& forces) noexcept {
  const Vec3 torque = lever.cross(force);
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = core.weights[static_cast<int>(i)];
    const std::size_t node = index_of(core.nodes[i]);
    forces.force[node] += weight * force;
    forces.torque[node] += weight * torque;
  }
}

}  // namespace plekton::contact

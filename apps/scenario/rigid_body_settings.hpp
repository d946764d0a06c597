// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/problems.hpp"
#include "dynamics/state/node_state.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace plekton::apps {

/// What of a rigid body has mass: the volume that its mesh encloses, or the mesh as a shell of its
/// thickness; by itself the volume of a closed mesh, and an open one as a shell.
enum class RigidFilling : std::uint8_t { by_itself, solid, shell };

/// A rigid body: a surface, which is among the membranes of a scenario, or spheres, which are among
/// its grains.
struct RigidBodySettings {
  std::string name;
  std::string path;  ///< what messages call it, as in "rigid_bodies.lid"
  Place place;
  std::optional<std::size_t> membrane;
  std::optional<std::size_t> grains;
  RigidFilling filling = RigidFilling::by_itself;
  std::optional<double> density;          ///< kg/m³
  std::optional<double> mass;             ///< kg
  std::optional<geometry::Vec3> inertia;  ///< kg m², about axes through the centre along x, y, z
  std::optional<geometry::Vec3> centre;   ///< m, of mass, instead of that of the shape
  dynamics::Held held = dynamics::Held::nothing;
  geometry::Vec3 velocity = geometry::Vec3::Zero();          ///< m/s, at the start
  geometry::Vec3 angular_velocity = geometry::Vec3::Zero();  ///< rad/s, at the start
  bool is_absent = false;  ///< not there yet in this stage, or any more
};

}  // namespace plekton::apps

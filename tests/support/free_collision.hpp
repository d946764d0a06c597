// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"

#include <array>
#include <numbers>

/// A ball that flies against a free structure of one or three beams: no gravity, no damping,
/// nothing held, so both momenta are constant and the energy does not grow.
namespace plekton::test {

using dynamics::NodeState;
using dynamics::Scene;
using dynamics::Simulation;
using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

enum class Target { long_cylinder, short_cylinder, facet };

struct Collision {
  const char* name;
  Target target;
  double friction_angle;  ///< degrees
  Vec3 velocity;          ///< m/s, of the ball
};

/// Without friction the ball falls straight; with it, it also slides and spins.
inline const std::array<Collision, 5> kCollisions{
    {{"CylinderWithoutFriction", Target::long_cylinder, 0.0, Vec3(0, 0, -1)},
     {"CylinderWithFriction", Target::long_cylinder, 35.0, Vec3(0.5, 0.2, -1)},
     {"ShortCylinderWithFriction", Target::short_cylinder, 35.0, Vec3(0.5, 0.2, -1)},
     {"FacetWithoutFriction", Target::facet, 0.0, Vec3(0, 0, -1)},
     {"FacetWithFriction", Target::facet, 35.0, Vec3(0.5, 0.2, -1)}}};

inline constexpr double kCollisionTime = 0.012;     // s
inline constexpr double kCollisionTimeStep = 1e-7;  // s

/// The structure's nodes, then the ball, 0.1 mm away from it.
inline Scene collision_scene(const Collision& collision) {
  constexpr double kSphere = 0.05;     // m
  constexpr double kStructure = 0.02;  // m
  constexpr double kDensity = 1000.0;  // kg/m³
  constexpr contact::MaterialId kMaterial{0};
  Scene scene;
  scene.materials = {{1e7, 0.3, std::tan(collision.friction_angle * std::numbers::pi / 180.0)}};
  const auto section = dynamics::circular_section(kStructure, 1e7, 0.3);
  const auto beam = [&](NodeId a, NodeId b) {
    scene.add_beam(a, b, section, kDensity);
    scene.add_cylinder(a, b, kStructure, kMaterial);
  };
  Vec3 place(0.05, 0.005, kSphere + kStructure + 1e-4);
  if (collision.target == Target::facet) {
    const NodeId a = scene.add_node(Vec3(-0.2, -0.1, 0));
    const NodeId b = scene.add_node(Vec3(0.2, -0.12, 0));
    const NodeId c = scene.add_node(Vec3(0.03, 0.25, 0));
    beam(a, b);
    beam(b, c);
    beam(c, a);
    scene.add_facet(a, b, c, kStructure, kMaterial);
    place.y() = 0.02;
  } else {
    const bool is_short = collision.target == Target::short_cylinder;
    const double half = is_short ? 0.02 : 0.2;  // m
    const NodeId a = scene.add_node(Vec3(-half, 0, 0));
    beam(a, scene.add_node(Vec3(half, 0, 0)));
    if (is_short) place.x() = 0.005;
  }
  scene.add_sphere(place, kSphere, kDensity, kMaterial);
  scene.state.velocity.back() = collision.velocity;
  scene.state.angular_velocity.back() = Vec3(3, -5, 7);
  return scene;
}

struct Momenta {
  Vec3 linear = Vec3::Zero();   ///< kg m/s
  Vec3 angular = Vec3::Zero();  ///< kg m²/s, about the origin
};

template <class AnySimulation>
Momenta momenta_of(const AnySimulation& simulation) {
  const NodeState& state = simulation.state();
  Momenta momenta;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 linear = simulation.properties().mass[i] * state.velocity[i];
    momenta.linear += linear;
    momenta.angular += state.position[i].cross(linear) +
                       simulation.properties().inertia[i] * state.angular_velocity[i];
  }
  return momenta;
}

}  // namespace plekton::test

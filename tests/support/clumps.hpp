// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/rigid/sphere_union.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/seeded_random.hpp"

#include <span>
#include <vector>

/// Rigid bodies for tests.
namespace plekton::test {

using dynamics::MassProperties;
using dynamics::Scene;
using geometry::NodeId;
using geometry::Quat;
using geometry::Vec3;

constexpr double kClumpDensity = 2650.0;  // kg/m³

/// Adds a clump of three spheres in an obtuse triangle that overlap: all moments are different.
/// @returns  its place in rigid_bodies
inline std::size_t add_clump(Scene& scene, const Vec3& centre, const Quat& turn, double radius,
                             contact::MaterialId material = contact::MaterialId{0}) {
  const std::vector<double> radii{radius, 0.8 * radius, 0.9 * radius};
  std::vector<Vec3> centres;
  for (const Vec3& place : {Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 0.5, 0.0), Vec3(1.1, 0.1, 0.2)})
    centres.push_back(centre + turn * Vec3(radius * place));
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    scene.add_sphere(centres[i], radii[i], kClumpDensity, material);
    nodes.push_back(scene.elements.spheres.back().nodes[0]);
  }
  const auto moments = dynamics::sphere_union(centres, radii, centre).moments;
  return scene.add_rigid_body(nodes, dynamics::mass_of(moments, kClumpDensity, centre));
}

/// kg m/s and kg m²/s about the origin, of spheres and rigid bodies.
struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  double size = 0.0;  ///< kg m/s, sum of the magnitudes
};

/// @param before  s, of the positions: those of the middle of the last drift have half of it
inline Momenta momenta_of(const dynamics::Simulation& simulation) {
  Momenta sum;
  const auto& state = simulation.state();
  const auto& properties = simulation.properties();
  const auto& bodies = simulation.scene().rigid_bodies;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (dynamics::holds_translation(properties.held[i])) continue;
    const Vec3 momentum = properties.mass[i] * state.velocity[i];
    sum.linear += momentum;
    sum.angular += state.position[i].cross(momentum);
    sum.size += momentum.norm();
    if (!dynamics::is_reference(properties.held[i]))
      sum.angular += properties.inertia[i] * state.angular_velocity[i];
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    sum.angular += simulation.rigid_bodies().angular_momentum(b);
  return sum;
}

}  // namespace plekton::test

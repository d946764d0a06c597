// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bodies_of_cells.hpp"

#include <algorithm>
#include <cmath>

/// A cylinder dragged crosswise over the joint of two others, with a constant overlap and without
/// slip.
namespace plekton::test::crossing {

inline constexpr double kRadius = 0.02;
inline constexpr double kOverlap = 0.001;
inline constexpr double kDistance = 2.0 * kRadius - kOverlap;
inline constexpr double kModulus = 1e6;
inline constexpr double kNormalForce = kModulus * kRadius * kOverlap;     // 20 N
inline constexpr double kTangentialStiffness = 0.3 * kModulus * kRadius;  // 6000 N/m
inline constexpr double kWay = 0.3;  // m, on either side of the joint
inline constexpr int kSteps = 4001;

/// Where the axis of the upper cylinder crosses the plane of the lower ones, and the normal there.
struct Place {
  Vec3 x;
  Vec3 normal;
};

inline Place place_at(double way, double angle) {
  const double arc = 2.0 * angle * kDistance;
  const double turned = std::clamp((way - kWay) / kDistance, 0.0, 2.0 * angle) - angle;
  const Vec3 normal(std::sin(turned), 0.0, std::cos(turned));
  const Vec3 along(std::cos(turned), 0.0, -std::sin(turned));
  const double beside = way < kWay ? way - kWay : std::max(0.0, way - kWay - arc);
  return {kDistance * normal + beside * along, normal};
}

struct Felt {
  double normal_error = 0.0;      ///< largest, over F_n
  double tangential_error = 0.0;  ///< largest, over k_s s
  double end = 0.0;               ///< N
  std::size_t most_patches = 0;
};

/// Drags the upper cylinder over the joint of the lower ones, which fall off by this angle (rad) on
/// either side.
inline Felt drag_over_joint(double angle) {
  const double drop = std::tan(angle);
  std::vector<Vec3> x{{-1, 0, -drop}, {0, 0, 0}, {1, 0, -drop}, {}, {}};
  const std::vector<Cylinder> cylinders{{{NodeId{0}, NodeId{1}}, kRadius},
                                        {{NodeId{1}, NodeId{2}}, kRadius},
                                        {{NodeId{3}, NodeId{4}}, kRadius}};
  const geometry::Surface surface(cylinders, {}, x.size());
  contact::StructureContacts contacts(surface);
  const contact::MaterialPairs materials(
      {contact::Material{kModulus, 0.3, 1e6}});
  const std::vector<contact::MaterialId> of_structures(surface.structure_count());
  geometry::ThreadPool pool(1);
  geometry::CellNeighbours neighbours(surface, {}, 0.01, false);

  constexpr double kStep = 1e-6;
  const double total = 2.0 * kWay + 2.0 * angle * kDistance;
  std::vector<Vec3> velocity(x.size(), Vec3::Zero());
  const std::vector<Vec3> still(x.size(), Vec3::Zero());
  Felt felt;
  for (int k = 0; k < kSteps; ++k) {
    const double way = total * k / kSteps;
    const Place now = place_at(way, angle);
    const std::vector<Vec3> before = x;
    x[3] = now.x + Vec3(0.0, -0.5, 0.0);
    x[4] = now.x + Vec3(0.0, 0.6, 0.0);
    for (const std::size_t i : {std::size_t{3}, std::size_t{4}})
      velocity[i] = k == 0 ? Vec3(Vec3::Zero()) : Vec3((x[i] - before[i]) / kStep);
    if (neighbours.update(x, pool))
      contacts.rebuild(neighbours.pairs(), {materials, {}, of_structures});
    contacts.advance({x, velocity, still}, kStep, pool);
    NodeForces forces(x.size());
    contacts.add_forces(forces);
    const Vec3 force = forces.force[3] + forces.force[4];
    const Vec3 tangent = Vec3::UnitY().cross(now.normal);
    felt.most_patches = std::max(felt.most_patches, contacts.touching());
    const double normal = force.dot(now.normal);
    felt.normal_error = std::max(felt.normal_error, std::abs(normal / kNormalForce - 1.0));
    felt.end = -force.dot(tangent);
    if (way > 0.01) {
      const double spring = kTangentialStiffness * way;
      felt.tangential_error = std::max(felt.tangential_error, std::abs(felt.end / spring - 1.0));
    }
  }
  return felt;
}

}  // namespace plekton::test::crossing

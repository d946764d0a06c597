// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

/// A strip that lies on a fixed sheet is pulled at one end with half of what moves it. It stretches
/// until friction balances the pull: where it slips the tension falls by mu N / L per length, so
/// half of it slips, from the pulled end on, and the rest stays where it is but for the springs of
/// the contact (shear lag over sqrt(E A / k) = 3 mm here, far less than a cell).
namespace plekton::test::strip_friction_test {
namespace {

using dynamics::Held;

constexpr double kThickness = 0.004;  // m
constexpr double kLength = 0.5;       // m
constexpr double kFriction = 0.5;
constexpr double kGravity = 9.81;  // m/s²
constexpr int kCells = 20;

/// @returns its nodes
std::vector<geometry::NodeId> add_sheet(dynamics::Scene& scene, const geometry::PlaneSheet& shape,
                                        double height, double young_modulus, Held held) {
  const auto sheet =
      geometry::make_membrane(geometry::plane_sheet(shape), {.thickness = kThickness});
  const auto fibre = dynamics::circular_section(0.5 * kThickness, young_modulus, 0.3);
  std::vector<geometry::NodeId> ids;
  for (const geometry::Vec3& x : sheet.nodes)
    ids.push_back(scene.add_node(x + geometry::Vec3(0.0, 0.0, height), held));
  const auto id = [&](geometry::NodeId node) { return ids[index_of(node)]; };
  for (const auto& [n, r] : sheet.facets)
    scene.add_facet(id(n[0]), id(n[1]), id(n[2]), r, contact::MaterialId{0});
  for (const auto& [a, b] : sheet.edges) scene.add_beam(id(a), id(b), fibre, 1000.0);
  return ids;
}

TEST(StripOnASheet, SlipsFromThePulledEndOn) {
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = 2e6, .stiffness_ratio = 0.5, .friction = kFriction}};
  add_sheet(scene, {0.6, 0.1, 15, 2}, 0.0, 1e7, Held::everything);
  const auto strip = add_sheet(scene, {kLength, 0.05, kCells, 2}, kThickness, 3e5, Held::nothing);
  const std::vector<geometry::Vec3> start = scene.state.position;
  std::vector<geometry::NodeId> pulled;
  double mass = 0.0;
  for (const geometry::NodeId node : strip) {
    mass += scene.properties.mass[index_of(node)];
    if (start[index_of(node)].x() > 0.499 * kLength) pulled.push_back(node);
  }
  dynamics::NodalForce pull;
  pull.nodes = pulled;
  pull.force = geometry::Vec3(
      0.5 * kFriction * mass * kGravity / static_cast<double>(pulled.size()), 0.0, 0.0);
  pull.factor = dynamics::TimeTable({{0.02, 0.0}, {0.22, 1.0}});
  scene.loads.forces.push_back(pull);
  scene.loads.mass_damping.push_back({strip, 60.0});

  dynamics::Simulation simulation(scene, {.motion = {.gravity = {0.0, 0.0, -kGravity}}});
  while (simulation.time() < 0.3) simulation.step();

  int slipped = 0;
  double far_end = 0.0, near_end = 0.0;
  for (const geometry::NodeId node : strip) {
    const geometry::Vec3& at = start[index_of(node)];
    const double way = simulation.state().position[index_of(node)].x() - at.x();
    if (at.x() > 0.499 * kLength) near_end = std::max(near_end, way);
    if (at.x() < -0.499 * kLength) far_end = std::max(far_end, std::abs(way));
    slipped += std::abs(at.y()) < 1e-6 && way > 1e-5 ? 1 : 0;
  }
  EXPECT_GT(near_end, 1e-4);
  EXPECT_LT(far_end, 1e-3 * near_end);
  // Of the nodes along the middle, one cell more or less.
  EXPECT_NEAR(slipped, kCells / 2, 1.5);
}

}  // namespace
}  // namespace plekton::test::strip_friction_test

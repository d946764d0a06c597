// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/refinement.hpp"
#include "tests/support/sheet_meshes.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// A strip of a thin sheet, clamped at one end, is rolled up by a moment at the other until it is a
/// circle, R = D / M per width: a whole turn, and hardly any strain.
namespace plekton::test::rolled_strip_refinement_test {
namespace {

using dynamics::Simulation;
using std::numbers::pi;

constexpr double kLength = 1.0;      // m
constexpr double kDensity = 1000.0;  // kg/m³
const SheetSection kSheet = dynamics::solid_sheet(0.01, 1e7, 0.0);
constexpr double kRadius = kLength / (2.0 * pi);

/// 1/s, of the strip as a cantilever.
double slowest_swing() {
  return 3.516 * std::sqrt(kSheet.bending_stiffness / (kDensity * kSheet.thickness)) /
         (kLength * kLength);
}

/// Two square cells wide. All stays in planes across the width: under a moment about an axis that
/// does not turn with it, a strip would twist sideways.
Scene strip_of_cells(int cells) {
  const double width = 2.0 * kLength / cells;
  Mesh mesh = geometry::plane_sheet({kLength, width, cells, 2});
  for (Vec3& x : mesh.points) x.x() += 0.5 * kLength;
  Scene scene = sheet_of(mesh, kSheet, kDensity, [](const Vec3& x) {
    return x.x() < 1e-9 ? Held::everything : Held::along_y | Held::about_x | Held::about_z;
  });
  // More inertia against turning than the sheet has: the step gets longer, what is slow is the
  // same.
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scene.properties.inertia[i] = scene.properties.mass[i] * width * width / 6.0;
  return scene;
}

/// A moment of D / R per width at the far end that grows for a while (s), and drag that brings the
/// slowest swing to rest without swinging back.
void load(Scene& scene, double width, double growing) {
  dynamics::NodalForce corners, middle;
  dynamics::MassDamping drag;
  drag.rate = 2.0 * slowest_swing();
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    const NodeId node = geometry::id_at<NodeId>(i);
    const Vec3& x = scene.state.position[i];
    drag.nodes.push_back(node);
    if (x.x() < kLength - 1e-9) continue;
    (std::abs(x.y()) > 0.1 * width ? corners : middle).nodes.push_back(node);
  }
  corners.torque = Vec3(0.0, -0.25 * width * kSheet.bending_stiffness / kRadius, 0.0);
  middle.torque = 2.0 * corners.torque;
  corners.factor = middle.factor = dynamics::TimeTable({{0.0, 0.0}, {growing, 1.0}});
  scene.loads.forces = {corners, middle};
  scene.loads.mass_damping = {drag};
}

struct Rolled {
  double radius;     ///< m, mean
  double roughness;  ///< m, largest deviation from it
};

/// @param cells  along the strip, even: so that a node comes to lie opposite to the clamp
Rolled roll(int cells) {
  const double growing = 6.0 / slowest_swing();
  Scene scene = strip_of_cells(cells);
  load(scene, 2.0 * kLength / cells, growing);
  Simulation simulation(std::move(scene), {});
  while (simulation.time() < 2.0 * growing) simulation.step();
  const auto& x = simulation.state().position;
  double furthest = 0.0;
  for (const Vec3& place : x) furthest = std::max(furthest, place.z());
  const auto radius_at = [&](const Vec3& place) {
    return std::hypot(place.x(), place.z() - 0.5 * furthest);
  };
  Rolled rolled{0.0, 0.0};
  for (const Vec3& place : x) rolled.radius += radius_at(place) / static_cast<double>(x.size());
  for (const Vec3& place : x)
    rolled.roughness = std::max(rolled.roughness, std::abs(radius_at(place) - rolled.radius));
  return rolled;
}

// A facet that turns by phi against its neighbours is linear in phi up to phi² of it: second order.
// Bending stresses of the order (t / 2 R)², 1e-3 here, are left out of the theory of thin sheets.
TEST(RolledStripRefinement, BecomesACircle) {
  Refinement table("strip rolled up by a moment, radius (m)", kRadius);
  Rolled rolled{};
  for (const int cells : {10, 14, 20, 28}) {
    rolled = roll(cells);
    table.add(cells, rolled.radius);
  }
  table.print();
  EXPECT_LT(rolled.roughness, 1e-3 * kRadius);
  EXPECT_LT(table.last_error(), 0.01);
  EXPECT_GT(table.last_order(), 1.7);
}

}  // namespace
}  // namespace plekton::test::rolled_strip_refinement_test

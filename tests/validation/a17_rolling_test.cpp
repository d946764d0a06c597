// SPDX-License-Identifier: GPL-3.0-or-later
// A17: a ball released on an incline of fixed facets, or on two rails of fixed cylinders, rolls or
// slides down with the acceleration of a rigid ball, over all the edges and joints on its way.
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace plekton::test::a17_rolling_test {
namespace {

using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSphere = 0.05;      // m
constexpr double kSurface = 0.01;     // m
constexpr double kYoung = 1e7;        // Pa
constexpr double kDensity = 2500.0;   // kg/m³
constexpr double kGravity = 9.81;     // m/s²
constexpr double kTime = 0.6;         // s
constexpr double kRailOffset = 0.03;  // m, of each rail from the middle
constexpr double kTolerance = 2e-3;
constexpr double kMass = kDensity * 4.0 / 3.0 * std::numbers::pi * kSphere * kSphere * kSphere;
constexpr double kStiffness = 2.0 * kYoung * kSphere * kSurface / (kSphere + kSurface);  // N/m
constexpr contact::MaterialId kMaterial{0};

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

Scene scene_with_friction(double friction_angle) {
  Scene scene;
  scene.materials = {{kYoung, 0.3, std::tan(friction_angle)}};
  return scene;
}

/// Flat sheet along x from 0, two cells wide, fixed; diagonals cut in turns.
void add_sheet(Scene& scene, int cells, double cell_length) {
  constexpr double kWidth = 0.15;  // m, of a cell
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= 2; ++j)
      scene.add_node(Vec3(i * cell_length, (j - 1) * kWidth, 0), Held::everything);
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j;
      const NodeId n[] = {NodeId{a}, NodeId{a + 3}, NodeId{a + 4}, NodeId{a + 1}};
      const bool rising = (i + j) % 2 == 0;
      scene.add_facet(n[0], n[1], rising ? n[2] : n[3], kSurface, kMaterial);
      scene.add_facet(rising ? n[0] : n[1], n[2], n[3], kSurface, kMaterial);
    }
  }
}

void add_rail(Scene& scene, double y) {
  NodeId last = scene.add_node(Vec3(0, y, 0), Held::everything);
  for (int i = 1; i < 15; ++i) {
    const NodeId next = scene.add_node(Vec3(0.2 * i, y, 0), Held::everything);
    scene.add_cylinder(last, next, kSurface, kMaterial);
    last = next;
  }
}

/// Releases the ball from a place and measures its mean acceleration (m/s²) along x, 2 s / t². The
/// start counts: until the tangential spring is loaded there is less friction, 0.11 % on the slide.
double acceleration_from(const Vec3& start, Scene scene, double slope) {
  scene.add_sphere(start, kSphere, kDensity, kMaterial);
  dynamics::SimulationOptions options;
  options.time_step = 0.1 * std::sqrt(kMass / kStiffness);
  options.motion.gravity = kGravity * Vec3(std::sin(slope), 0, -std::cos(slope));
  Simulation simulation(std::move(scene), options);
  while (simulation.time() < kTime) simulation.step();
  const Vec3 way = simulation.state().position.back() - start;
  EXPECT_NEAR(way.y(), 0.0, 1e-9);
  return 2.0 * way.x() / (simulation.time() * simulation.time());
}

/// Place on the sheet where its push carries the ball.
Vec3 resting_place(double slope) {
  const double overlap = kMass * kGravity * std::cos(slope) / kStiffness;
  return Vec3(0.07, 0.013, kSphere + kSurface - overlap);
}

// a = 5/7 g sin(slope) = 1.21678 m/s²: a full ball with the inertia 2/5 m R².
TEST(A17Rolling, ASphereRollsDownASheetOfManyFacets) {
  const double slope = radians(10.0);
  Scene scene = scene_with_friction(radians(30.0));
  add_sheet(scene, 14, 0.2);

  const double acceleration = acceleration_from(resting_place(slope), std::move(scene), slope);

  EXPECT_NEAR(5.0 / 7.0 * kGravity * std::sin(slope), 1.21678, 1e-5);
  EXPECT_NEAR(acceleration / 1.21678, 1.0, kTolerance);
}

TEST(A17Rolling, ASphereRollsDownASheetOfFewFacets) {
  const double slope = radians(10.0);
  Scene scene = scene_with_friction(radians(30.0));
  add_sheet(scene, 1, 2.8);

  const double acceleration = acceleration_from(resting_place(slope), std::move(scene), slope);

  EXPECT_NEAR(acceleration / 1.21678, 1.0, kTolerance);
}

// a = g (sin(slope) - tan(phi) cos(slope)) = 4.16172 m/s².
TEST(A17Rolling, ASphereSlidesDownASmoothSheet) {
  const double slope = radians(30.0);
  const double friction_angle = radians(5.0);
  Scene scene = scene_with_friction(friction_angle);
  add_sheet(scene, 14, 0.2);

  const double acceleration = acceleration_from(resting_place(slope), std::move(scene), slope);

  EXPECT_NEAR(kGravity * (std::sin(slope) - std::tan(friction_angle) * std::cos(slope)), 4.16172,
              1e-5);
  EXPECT_NEAR(acceleration / 4.16172, 1.0, kTolerance);
}

// a = g sin(slope) / (1 + 2/5 R² / h²) = 1.11097 m/s², h the height of the centre over the contact
// points.
TEST(A17Rolling, ASphereRollsDownTwoRails) {
  const double slope = radians(10.0);
  Scene scene = scene_with_friction(radians(30.0));
  add_rail(scene, -kRailOffset);
  add_rail(scene, kRailOffset);
  const double reach = kSphere + kSurface;
  const Vec3 start(0.07, 0.0, std::sqrt(reach * reach - kRailOffset * kRailOffset));

  const double acceleration = acceleration_from(start, std::move(scene), slope);

  const double height_squared =
      kSphere * kSphere * (1.0 - kRailOffset * kRailOffset / (reach * reach));
  EXPECT_NEAR(kGravity * std::sin(slope) / (1.0 + 0.4 * kSphere * kSphere / height_squared),
              1.11097, 1e-5);
  EXPECT_NEAR(acceleration / 1.11097, 1.0, kTolerance);
}

}  // namespace
}  // namespace plekton::test::a17_rolling_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/plane_forces.hpp"

#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plekton::dynamics::plane_forces_test {
namespace {

constexpr double kRadius = 0.1;  // m

/// A ball in a floor by a hundredth of its radius.
Scene ball_in_floor() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  scene.add_sphere(Vec3(0.3, 0, 0.99 * kRadius), kRadius, 2600.0, contact::MaterialId{0});
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  return scene;
}

TEST(PlaneForces, PressAtNoWayIsWhatActsAndGrowsWithTheWay) {
  const Simulation simulation(ball_in_floor(), {});
  const std::vector<Vec3> x = simulation.force_positions();
  const contact::Contacts& contacts = simulation.contacts();
  const std::vector<contact::Plane>& planes = simulation.planes();
  const contact::PlaneAction& acts = contacts.on_plane(0);
  const PlanePress now = press_on_plane(contacts, planes, 0, 0.0, x);
  const PlanePress further = press_on_plane(contacts, planes, 0, 1e-4, x);

  EXPECT_LT(acts.force.z(), 0.0);
  EXPECT_NEAR(now.force, -acts.force.z(), 1e-12 * now.force);
  EXPECT_NEAR(acts.moment.y(), -0.3 * acts.force.z(), 1e-12 * now.force);
  EXPECT_NEAR(acts.push, now.force, 1e-12 * now.force);
  // The linear law: a spring over the whole overlap.
  EXPECT_NEAR(further.force - now.force, 1e-4 * now.stiffness, 1e-9 * now.force);
  EXPECT_NEAR(now.force, 0.01 * kRadius * now.stiffness, 1e-9 * now.force);
}

/// The floor turns about an axis through the origin, and the ball rubs on it 0.3 m from there.
TEST(PlaneForces, OnATurningPlaneTakeThePowerOfFrictionAtItsLever) {
  Scene scene = ball_in_floor();
  scene.planes[0].axis = Vec3::UnitZ();
  scene.planes[0].angular_velocity = 2.0;
  Simulation simulation(scene, {});
  for (int i = 0; i < 5; ++i) simulation.step();
  const contact::PlaneAction& acts = simulation.contacts().on_plane(0);
  EXPECT_NE(acts.force.y(), 0.0);
  const double by_hand = 2.0 * simulation.state().position[0].x() * acts.force.y();
  EXPECT_NEAR(power_on_turning(simulation.contacts(), simulation.planes()), by_hand,
              1e-2 * std::abs(by_hand));
}

TEST(PlaneForces, FastestOfAPlaneThatTurnsIsWhereANodeIsFurthestFromItsAxis) {
  contact::Plane plane{Vec3::Zero(), Vec3::UnitZ()};
  plane.velocity = Vec3(0, 0, 1);
  const std::vector<Vec3> x{Vec3(1, 0, 0), Vec3(0, 3, 5)};
  EXPECT_EQ(fastest_on_planes(std::vector{plane}, x), 1.0);
  plane.velocity = Vec3::Zero();
  plane.axis = Vec3::UnitZ();
  plane.angular_velocity = 2.0;
  EXPECT_DOUBLE_EQ(fastest_on_planes(std::vector{plane}, x), 6.0);
}

}  // namespace
}  // namespace plekton::dynamics::plane_forces_test

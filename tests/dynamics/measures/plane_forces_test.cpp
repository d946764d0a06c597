// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/plane_forces.hpp"

#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

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
  const ForceAndMoment acts = force_on_plane(contacts, x, 0, Vec3::Zero());
  const PlanePress now = press_on_plane(contacts, planes, 0, 0.0, x);
  const PlanePress further = press_on_plane(contacts, planes, 0, 1e-4, x);

  EXPECT_LT(acts.force.z(), 0.0);
  EXPECT_NEAR(now.force, -acts.force.z(), 1e-12 * now.force);
  EXPECT_NEAR(acts.moment.y(), -0.3 * acts.force.z(), 1e-12 * now.force);
  EXPECT_NEAR(push_on_plane(contacts, 0), now.force, 1e-12 * now.force);
  // The linear law: a spring over the whole overlap.
  EXPECT_NEAR(further.force - now.force, 1e-4 * now.stiffness, 1e-9 * now.force);
  EXPECT_NEAR(now.force, 0.01 * kRadius * now.stiffness, 1e-9 * now.force);
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

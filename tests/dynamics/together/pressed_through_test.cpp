// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Grains that are pressed through a facet or through each other: their centre goes through the
/// core of the other body, where the normal force turns over. The certificate names it, but nothing
/// may be lost or made in it beyond what a chosen step promises, 1/16 of what went through.
namespace plekton::test::pressed_through_test {
namespace {

constexpr double kRadius = 0.01;        // m
constexpr double kThickness = 0.002;    // m, of the facet
constexpr double kPromised = 1.0 / 16;  // apps/scenario.md
constexpr contact::MaterialId kMaterial{0};

/// A facet around the origin, in a plane that slopes down along x.
/// @param slope  rad
Scene facet(double friction, double slope, dynamics::Held held) {
  Scene scene;
  scene.materials = {{1e6, 0.5, friction}};
  std::vector<NodeId> nodes;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi / 3.0 * i;
    const double along = 0.1 * std::cos(angle);
    nodes.push_back(
        scene.add_node({along * std::cos(slope), 0.1 * std::sin(angle), -along * std::sin(slope)}));
    scene.properties.held.back() = held;
  }
  scene.elements.facets.push_back({{nodes[0], nodes[1], nodes[2]}, 0.5 * kThickness});
  scene.facet_materials.push_back(kMaterial);
  return scene;
}

void add_grain(Scene& scene, const Vec3& place, const Vec3& velocity) {
  scene.add_sphere(place, kRadius, 2650.0, kMaterial);
  scene.state.velocity.back() = velocity;
}

/// Grains in ten phases of the step in which they go through. @returns the largest closure
template <class MakeScene>
double largest_closure(const MakeScene& make_scene, double duration, int& passed) {
  double largest = 0.0;
  for (int phase = 0; phase < 10; ++phase) {
    LoadedSimulation simulation = simulation_of(make_scene(1e-4 * phase), 0.0);
    largest = std::max(largest, closure_until(simulation, duration));
    passed += simulation.pass_throughs() > 0;
  }
  return largest;
}

// A plane presses it onto a facet that slopes by less than the friction angle: when it goes through,
// the tangential spring has two thirds of what the normal force has stored.
TEST(PressedThroughAFacet, FrictionIsNotLostUnderAPlane) {
  const auto pressed = [](double offset) {
    Scene scene = facet(0.7, 0.5, dynamics::Held::everything);
    add_grain(scene, {0.0, 0.0, 0.0125 + offset}, Vec3::Zero());
    scene.planes.push_back(
        {{0.0, 0.0, 0.023 + offset}, -Vec3::UnitZ(), {0.0, 0.0, -1.0}, kMaterial});
    return scene;
  };
  int passed = 0;

  const double closure = largest_closure(pressed, 0.05, passed);

  EXPECT_EQ(passed, 10);
  EXPECT_LT(closure, kPromised);
}

TEST(PressedThroughAFacet, FrictionIsNotLostAtSpeed) {
  const auto thrown = [](double offset) {
    Scene scene = facet(0.7, 0.5, dynamics::Held::everything);
    add_grain(scene, {0.0, 0.0, 0.0125 + offset}, {0.0, 0.0, -7.0});
    return scene;
  };
  int passed = 0;

  const double closure = largest_closure(thrown, 0.02, passed);

  EXPECT_EQ(passed, 10);
  EXPECT_LT(closure, kPromised);
}

// Both move towards each other, with the mass of the grain each: the nearer they come in a step, the
// more the mean of the forces at its ends differs from what the way between them takes.
TEST(PressedThroughAFacet, AChosenStepFollowsTheForceThatTurnsOver) {
  for (const double speed : {4.4, 4.8, 5.4, 6.0, 8.0}) {
    const auto thrown = [&](double offset) {
      Scene scene = facet(0.0, 0.0, dynamics::Held::nothing);
      add_grain(scene, {0.0, 0.0, 0.0125 + offset}, {0.0, 0.0, -speed});
      for (std::size_t node = 0; node < 3; ++node) {
        scene.properties.mass[node] = scene.properties.mass.back() / 3.0;
        scene.properties.inertia[node] = scene.properties.inertia.back();
        scene.state.velocity[node] = {0.0, 0.0, speed};
      }
      return scene;
    };
    int passed = 0;

    const double closure = largest_closure(thrown, 0.05 / speed, passed);

    EXPECT_EQ(passed, 10) << speed;
    EXPECT_LT(closure, kPromised) << speed;
  }
}

// Both are moved. They pass each other by a thousandth of their radius, which turns the normal over
// within a step; one spins, so that it slips across the plane in which the normal turns.
TEST(PressedThroughAGrain, FrictionIsNotLost) {
  constexpr double kSpeed = 1.0;  // m/s
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.7}};
  add_grain(scene, Vec3::Zero(), Vec3::Zero());
  add_grain(scene, {2.05 * kRadius, 1e-3 * kRadius, 0.0}, {-kSpeed, 0.0, 0.0});
  scene.state.angular_velocity.back() = {0.0, 2.0 * kSpeed / kRadius, 0.0};
  for (dynamics::Held& held : scene.properties.held) held = dynamics::Held::everything;
  LoadedSimulation simulation = simulation_of(scene, 0.02 * kRadius / kSpeed);

  const double closure = closure_until(simulation, 3.0 * kRadius / kSpeed);

  EXPECT_LT(closure, 0.01);
}

}  // namespace
}  // namespace plekton::test::pressed_through_test

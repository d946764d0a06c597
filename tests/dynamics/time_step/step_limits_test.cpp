// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_limits.hpp"

#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/named_laws.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

/// Critical steps with dashpots, against the step at which the matrix of one step of a leapfrog
/// whose damping follows the speed of half a step before gets an eigenvalue beyond 1.
namespace plekton::dynamics::step_limits_test {
namespace {

using contact::AnyLaw;
using geometry::NodeId;

constexpr contact::MaterialId kMaterial{0};
constexpr double kStiffness = 1e4;  // N/m
constexpr double kHeavy = 1.0;      // kg, of the balls that press
constexpr double kRadius = 0.05;    // m

/// Masses (kg) on lines, each with springs and dashpots to others.
struct Link {
  int a;
  int b;           ///< -1: held
  double damping;  ///< N s/m
};

/// @param drag  1/s, damping over mass
double largest_modulus(const std::vector<double>& masses, const std::vector<Link>& links,
                       double drag, double dt) {
  const auto size = static_cast<Eigen::Index>(masses.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), damping = stiffness;
  for (const Link& link : links) {
    Eigen::VectorXd way = Eigen::VectorXd::Zero(size);
    way[link.a] = 1.0;
    if (link.b >= 0) way[link.b] = -1.0;
    stiffness += kStiffness * way * way.transpose();
    damping += link.damping * way * way.transpose();
  }
  Eigen::MatrixXd per_mass = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    per_mass(i, i) = 1.0 / masses[static_cast<std::size_t>(i)];
    damping(i, i) += drag * masses[static_cast<std::size_t>(i)];
  }
  // x <- x + dt v, v <- v - dt M^-1 (K x + C v).
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd step(2 * size, 2 * size);
  step << one, dt * one, -dt * per_mass * stiffness,
      one - dt * per_mass * damping - dt * dt * per_mass * stiffness;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

/// s, the shortest step at which something grows.
double true_limit(const std::vector<double>& masses, const std::vector<Link>& links,
                  double drag = 0.0) {
  double stable = 0.0, growing = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double dt = 0.5 * (stable + growing);
    (largest_modulus(masses, links, drag, dt) <= 1.0 + 1e-9 ? stable : growing) = dt;
  }
  return stable;
}

double dashpot(double xi, double mass) {
  return 2.0 * xi * std::sqrt(mass * kStiffness);
}

contact::ContactModel damped(double xi) {
  const contact::PairProperties<AnyLaw> properties{
      {{kMaterial, kMaterial},
       test::with<contact::LinearFrictional>({.normal_stiffness = kStiffness}, {}, {xi})}};
  return contact::any_law(properties);
}

Scene with_ball(const Vec3& centre) {
  Scene scene;
  scene.materials = {{1e6, 0.0, 0.0}};
  scene.add_sphere(centre, kRadius, 1.0, kMaterial);
  scene.properties.mass.back() = kHeavy;
  return scene;
}

void expect_limit(const Scene& scene, double xi, double limit) {
  Simulation simulation(scene, {.motion = {.gravity = Vec3::Zero()}}, damped(xi));
  EXPECT_LE(simulation.time_step(), kLargestStep * limit) << xi;
  simulation.step();  // finds the contacts
  EXPECT_LE(simulation.present_critical_step().dt, limit * (1.0 + 1e-6)) << xi;
  EXPECT_GE(simulation.present_critical_step().dt, 0.99 * limit) << xi;
  EXPECT_NEAR(simulation.exact_critical_step().dt, limit, 0.01 * limit) << xi;
}

TEST(StepWithDashpots, IsLimitedByTheLightNodeThatAHeavyBallLiesOn) {
  constexpr double kLight = 1e-3;  // kg
  constexpr double kWire = 0.01;   // m, radius
  for (const double xi : {0.05, 0.3, 1.0}) {
    Scene scene = with_ball(Vec3(0, 0, kRadius + kWire - 1e-4));
    const NodeId a = scene.add_node(Vec3::Zero());
    const NodeId b = scene.add_node(Vec3(1, 0, 0));
    scene.add_cylinder(a, b, kWire, kMaterial);
    for (const NodeId node : {a, b}) {
      scene.properties.mass[index_of(node)] = kLight;
      scene.properties.inertia[index_of(node)] = 1.0;
    }
    expect_limit(scene, xi, true_limit({kHeavy, kLight}, {{0, 1, dashpot(xi, kHeavy)}}));
  }
}

// Where nothing but a structure could touch itself, its dashpots were not counted.
TEST(StepWithDashpots, KnowsThoseOfAStructureThatTouchesItself) {
  constexpr double kWire = 0.01;  // m, radius
  const auto step_of = [](double xi) {
    Scene scene;
    scene.materials = {{1e6, 0.0, 0.0}};
    const double above = 2.0 * kWire - 1e-4;  // m, of the last bar over the first
    std::vector<NodeId> nodes;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1.5, 1, 0), Vec3(0.5, 0.5, above),
                          Vec3(0.5, -0.5, above)}) {
      nodes.push_back(scene.add_node(x));
      scene.properties.mass.back() = 1e-3;
      scene.properties.inertia.back() = 1.0;
    }
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      scene.add_cylinder(nodes[i], nodes[i + 1], kWire, kMaterial);
    return Simulation(scene, {.motion = {.gravity = Vec3::Zero()}}, damped(xi)).time_step();
  };

  EXPECT_LT(step_of(1.0), 0.8 * step_of(0.0));
}

TEST(StepWithDashpots, IsLimitedByTheSumOfThoseAroundABall) {
  for (const double xi : {0.05, 0.3, 1.0}) {
    Scene scene = with_ball(Vec3::Zero());
    constexpr double kApart = 2.0 * kRadius - 1e-4;  // m
    for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0)}) {
      scene.add_sphere(kApart * side, kRadius, 1.0, kMaterial);
      scene.properties.mass.back() = 1e6;
    }
    const double c = dashpot(xi, kHeavy / (1.0 + kHeavy / 1e6));
    expect_limit(scene, xi, true_limit({kHeavy}, {{0, -1, c}, {0, -1, c}}));
  }
}

// What drags on the nodes made a step shorter in which the dashpots had counted for less: up to 17 %
// too long.
TEST(StepWithDashpots, IsLimitedByThemTogetherWithWhatDragsOnTheNodes) {
  for (const double xi : {0.05, 0.3, 1.0}) {
    for (const double drag : {50.0, 300.0}) {  // 1/s; omega is 141 /s
      Scene scene = with_ball(Vec3::Zero());
      scene.loads.mass_damping = {{.nodes = {NodeId{0}}, .rate = drag}};
      constexpr double kApart = 2.0 * kRadius - 1e-4;  // m
      for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0)}) {
        scene.add_sphere(kApart * side, kRadius, 1.0, kMaterial);
        scene.properties.mass.back() = 1e6;
      }
      const double c = dashpot(xi, kHeavy / (1.0 + kHeavy / 1e6));
      expect_limit(scene, xi, true_limit({kHeavy}, {{0, -1, c}, {0, -1, c}}, drag));
    }
  }
}

// A ball of 1 kg that presses on light nodes through a strong dashpot: at a step that only looked
// at the ball the net tears itself apart.
TEST(StepWithDashpots, LetsNoLightNetGainEnergyUnderAHeavyBall) {
  constexpr double kPitch = 0.02, kWire = 0.001;  // m
  constexpr int kNodes = 6;
  for (const double xi : {0.15, 0.5}) {
    Scene scene = with_ball(Vec3(0.003, 0.001, kRadius + kWire + 1e-4));
    scene.state.velocity.back() = Vec3(0.3, 0.2, -1.0);
    for (int i = 0; i < kNodes * kNodes; ++i) {
      const NodeId node = scene.add_node(kPitch * Vec3(i % kNodes - 2.5, i / kNodes - 2.5, 0.0));
      const auto before = [&](int count) {
        return geometry::id_at<NodeId>(index_of(node) - static_cast<std::size_t>(count));
      };
      const auto section = circular_section(kWire, 1e8, 0.3);
      const auto add = [&](NodeId other) {
        scene.add_cylinder(other, node, kWire, kMaterial);
        scene.add_beam(other, node, section, 1500.0);
      };
      if (i % kNodes > 0) add(before(1));
      if (i >= kNodes) add(before(kNodes));
    }
    Simulation simulation(scene, {.motion = {.gravity = Vec3::Zero()}}, damped(xi));
    double largest = 0.0;
    while (simulation.time() < 0.01) {
      simulation.step();
      largest = std::max(largest, simulation.energy().closure());
    }

    EXPECT_GT(simulation.energy().friction, 0.0) << xi;  // it has met the net
    EXPECT_LE(largest, 0.01) << xi;
  }
}

}  // namespace
}  // namespace plekton::dynamics::step_limits_test

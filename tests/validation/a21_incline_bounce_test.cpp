// SPDX-License-Identifier: GPL-3.0-or-later
// A21: a hollow sphere of facets and beams falls on a fixed incline of two facets and bounces down
// it. What it gets back of the speed along the normal does not depend on the step, and it stays in
// the plane of symmetry in which it falls.
#include "dynamics/simulation.hpp"
#include "tests/support/lattice_body.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>

namespace plekton::test::a21_incline_bounce_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;
using geometry::Vec3;

constexpr double kThickness = 0.005;                           // m, radius of facets and beams
constexpr double kModulus = 3e8;                               // Pa
constexpr double kDensity = 2650.0;                            // kg/m³
constexpr double kSlope = 16.35 / 180.0 * std::numbers::pi;    // rad
constexpr double kFriction = 20.0 / 180.0 * std::numbers::pi;  // rad
constexpr double kPlace = 0.1;                                 // m, y of the plane of symmetry
constexpr std::size_t kInclineNodes = 4;

void add_incline(dynamics::Scene& scene) {
  const double fall = std::tan(kSlope);
  for (const auto& [x, y] : {std::array{-0.4, -0.6}, {1.2, -0.6}, {1.2, 0.6}, {-0.4, 0.6}})
    scene.add_node(Vec3(x, y, -x * fall), Held::everything);
  const auto node = [](int i) { return geometry::NodeId{i}; };
  scene.add_facet(node(0), node(1), node(2), kThickness, contact::MaterialId{0});
  scene.add_facet(node(0), node(2), node(3), kThickness, contact::MaterialId{0});
}

struct Fall {
  double restitution;  ///< along the normal
  double drift;        ///< m, largest, out of the plane of symmetry
};

Fall fall_on_incline(double friction, double time_step) {
  dynamics::Scene scene;
  scene.materials = {{kModulus, 0.3, friction}};
  add_incline(scene);
  add_lattice(scene, geometry::icosphere(0.1, 1), Vec3(0.02, kPlace, 0.16 + 2.0 * kThickness),
              {kThickness, dynamics::circular_section(kThickness, kModulus, 0.3), kDensity},
              [](const Vec3&) { return Held::nothing; });
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  Simulation simulation(std::move(scene), options);
  const Vec3 normal(std::sin(kSlope), 0.0, std::cos(kSlope));
  double fastest_in = 0.0, fastest_out = 0.0, drift = 0.0;
  while (simulation.time() < 0.9) {
    simulation.step();
    const CentreOfMass centre =
        centre_of_mass(simulation, kInclineNodes, simulation.state().size() - kInclineNodes);
    drift = std::max(drift, std::abs(centre.position.y() - kPlace));
    const double speed = centre.velocity.dot(normal);
    if (simulation.time() < 0.15) fastest_in = std::max(fastest_in, -speed);
    if (simulation.time() < 0.21) fastest_out = std::max(fastest_out, speed);
  }
  std::printf(
      "incline, tan(phi) = %.3f, step %.3g s: in %.4f, out %.4f m/s, e_n = %.4f, drift %.1e m\n",
      friction, time_step, fastest_in, fastest_out, fastest_out / fastest_in, drift);
  return {fastest_out / fastest_in, drift};
}

TEST(A21InclineBounce, DoesNotDependOnTheStepAndStaysInItsPlane) {
  constexpr double kStep = 2.25e-5;  // s
  for (const double friction : {std::tan(kFriction), 0.0}) {
    const Fall coarse = fall_on_incline(friction, kStep);
    const Fall fine = fall_on_incline(friction, 0.5 * kStep);

    EXPECT_LT(std::abs(fine.restitution / coarse.restitution - 1.0), 5e-3);
    EXPECT_LT(coarse.drift, 1e-9);
    EXPECT_LT(fine.drift, 1e-9);
    EXPECT_GT(coarse.restitution, 0.5);
    EXPECT_LT(coarse.restitution, 1.0);
  }
}

}  // namespace
}  // namespace plekton::test::a21_incline_bounce_test

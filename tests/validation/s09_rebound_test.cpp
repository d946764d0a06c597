// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

/// S9: what follows the stiffness and radius of a contact: the restitution is what was asked for,
/// and the time step what the contact allows, whatever a ball of 10 mm falls on.
namespace plekton::dynamics::s09_rebound_test {
namespace {

using contact::AnyLaw;
using contact::LinearFrictional;
using contact::SpringKind;
using geometry::NodeId;

constexpr double kRadius = 0.01;  // m
constexpr double kSpeed = 0.05;   // m/s
constexpr double kRestitution = 0.6;
constexpr contact::MaterialId kMaterial{0};

struct Ground {
  const char* name;
  void (*lay)(Scene&);  ///< what has its top at z = 0, held
};

void lay_plane(Scene& scene) {
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
}
void lay_sheet(Scene& scene) {
  constexpr double kHalf = 0.001;  // m, half of the thickness
  const auto node = [&](double x, double y) {
    return scene.add_node(Vec3(x, y, -kHalf), Held::everything);
  };
  scene.add_facet(node(-1, -1), node(1, -1), node(0, 1), kHalf, kMaterial);
}
void lay_bar(Scene& scene) {
  constexpr double kWire = 0.002;  // m, radius
  const NodeId a = scene.add_node(Vec3(-1, 0, -kWire), Held::everything);
  const NodeId b = scene.add_node(Vec3(1, 0, -kWire), Held::everything);
  scene.add_cylinder(a, b, kWire, kMaterial);
}

constexpr Ground kGrounds[] = {{"Plane", lay_plane}, {"ThinSheet", lay_sheet}, {"Bar", lay_bar}};

Scene ball_above(const Ground& ground, double gap) {
  Scene scene;
  scene.materials = {{1e7, 0.2, 0.0, 0.3}};
  scene.add_sphere(Vec3(0, 0, kRadius + gap), kRadius, 2000.0, kMaterial);
  ground.lay(scene);
  return scene;
}

template <class Law>
test::NamedLaw damped(const char* name, const contact::PropertiesOf<Law>& law, SpringKind kind) {
  return {name, test::with<Law>(law, {}, {contact::damping_ratio(kind, kRestitution)})};
}
const test::NamedLaw kHertz = damped<contact::HertzMindlin>("Hertz", {}, SpringKind::hertz);
const test::NamedLaw kGiven =
    damped<LinearFrictional>("GivenStiffness", {.normal_stiffness = 2e5}, SpringKind::linear);
const test::NamedLaw kCurvature = damped<LinearFrictional>(
    "Curvature", {.radius = LinearFrictional::StiffnessRadius::curvature}, SpringKind::linear);

TEST(Rebound, IsTheRestitutionThatWasAskedForWhateverASphereFallsOn) {
  for (const test::NamedLaw& law : {kHertz, kGiven, kCurvature}) {
    for (const Ground& ground : kGrounds) {
      Scene scene = ball_above(ground, 1e-6);
      scene.state.velocity[0] = Vec3(0, 0, -kSpeed);
      Simulation simulation(std::move(scene),
                            {.time_step = 5e-7, .motion = {.gravity = Vec3::Zero()}},
                            contact::any_law({{{kMaterial, kMaterial}, law.properties}}));
      while (simulation.time() < 0.01) simulation.step();

      // The dashpot is half a step late: by omega dt = 0.003 at most.
      EXPECT_NEAR(simulation.state().velocity[0][2] / kSpeed, kRestitution, 0.003)
          << law.name << " on " << ground.name;
    }
  }
}

/// A ball of mass m on a spring k: 2 / omega = 2 sqrt(m / k). Sliding turns it with 7/2 of the
/// tangential stiffness, here 0.35 k.
TEST(CriticalStep, IsThatOfTheStiffnessOfThePair) {
  constexpr double kStiffness = 3e5;  // N/m
  const contact::PairProperties<LinearFrictional> pairs{
      {{kMaterial, kMaterial},
       {.normal_stiffness = kStiffness, .tangential_stiffness = 0.1 * kStiffness}}};
  for (const Ground& ground : kGrounds) {
    Scene scene = ball_above(ground, -1e-5);
    const double expected = 2.0 * std::sqrt(scene.properties.mass[0] / kStiffness);
    const Simulation simulation(std::move(scene), {}, contact::linear_frictional(pairs));

    EXPECT_LE(simulation.critical_step().dt, expected) << ground.name;
    EXPECT_LE(simulation.time_step(), 0.5 * expected) << ground.name;
    if (ground.lay == lay_plane) {
      EXPECT_NEAR(simulation.exact_critical_step().dt / expected, 1.0, 1e-3);
    }
  }
}

/// Johnson (1985), 4.2 and 7.2: dP/dd = 2 E* sqrt(R d) with the ball's R, and a tangential
/// stiffness of 2 (1 - nu) / (2 - nu) of it, 7/2 of which turns the ball.
TEST(CriticalStep, IsThatOfTheCurvatureUnderHertz) {
  constexpr double kOverlap = 1e-5;  // m
  const double modulus = 1e7 / (2.0 * (1.0 - 0.3 * 0.3));
  const double stiffness = 2.0 * modulus * std::sqrt(kRadius * kOverlap);
  const double turning = 3.5 * 2.0 * (1.0 - 0.3) / (2.0 - 0.3) * stiffness;
  for (const Ground& ground : {kGrounds[0], kGrounds[1]}) {
    Scene scene = ball_above(ground, -kOverlap);
    const double expected = 2.0 * std::sqrt(scene.properties.mass[0] / turning);
    const Simulation simulation(
        std::move(scene), {},
        contact::any_law({{{kMaterial, kMaterial}, test::with<contact::HertzMindlin>({})}}));

    EXPECT_LE(simulation.critical_step().dt, expected) << ground.name;
    // What exact_critical_step() promises.
    EXPECT_NEAR(simulation.exact_critical_step().dt / expected, 1.0, 1e-3) << ground.name;
  }
}

}  // namespace
}  // namespace plekton::dynamics::s09_rebound_test

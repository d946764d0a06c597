// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dashpot.hpp"
#include "contact/law/restitution.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/dynamics/ball_on_ground.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// A dashpot beside a linear spring against a leapfrog of one number, written here.
namespace plekton::dynamics::dashpot_work_test {
namespace {

using ball_on_ground::add_ball;
using ball_on_ground::kDensity;
using ball_on_ground::kMaterial;
using ball_on_ground::kRadius;
using ball_on_ground::lay_ball;
using ball_on_ground::lay_facet;
using ball_on_ground::lay_plane;
using contact::AnyLaw;

constexpr double kSpeed = 0.4;  // m/s
constexpr double kXi = 0.2;
const double kMass = kDensity * 4.0 / 3.0 * std::acos(-1.0) * kRadius * kRadius * kRadius;

struct Ground {
  const char* name;
  void (*lay)(Scene&);  ///< what has its top at z = 0 and does not move
  double speed;         ///< m/s, of what comes from below
  double reduced;       ///< mass that moves, in parts of the ball's
};

/// What a leapfrog does to the overlap of a spring and a dashpot that never pull, and what the
/// dashpot takes: its push over half of the ways before and after it.
struct Rebound {
  double speed;       ///< m/s, at the end
  double dissipated;  ///< J
};
Rebound rebound(double mass, double stiffness, double gap, double speed, double dt) {
  const double c = 2.0 * kXi * std::sqrt(mass * stiffness);
  double overlap = -gap, rate = speed, push = 0.0, dissipated = 0.0;
  bool has_touched = false;
  for (;;) {
    overlap += dt * rate;
    const double before = push;
    const double elastic = stiffness * std::max(0.0, overlap);
    push = overlap > 0.0 ? std::max(-elastic, c * rate) : 0.0;
    dissipated += 0.5 * (before + push) * rate * dt;
    rate -= dt / mass * (elastic + push);
    has_touched = has_touched || overlap > 0.0;
    if (has_touched && overlap < 0.0) return {-rate, dissipated};
  }
}

/// A ball that does not move, for which its own mass counted: a restitution of 0.5 became 0.6.
void lay_held_ball(Scene& scene) {
  scene.add_sphere(Vec3(0, 0, -kRadius), kRadius, kDensity, kMaterial);
  scene.properties.held.back() = Held::everything;
}

class DashpotOn : public testing::TestWithParam<Ground> {};

/// Overlaps of 4 % of the radius, with some ten steps for a contact: half a step of the dashpot is
/// several per cent of what it takes.
TEST_P(DashpotOn, TakesTheWorkOfItsPushUpToTheEndOfTheStepInWhichTheBodiesPart) {
  const Ground& ground = GetParam();
  for (const double phase : {0.05, 0.3, 0.55, 0.8}) {
    Scene scene;
    scene.materials = {{2e5, 0.0, 0.0}};
    const double mass = ground.reduced * kMass;
    const double stiffness = 1000.0;  // N/m
    const double dt = 0.3 * std::sqrt(mass / stiffness);
    const double speed = kSpeed + ground.speed;
    const double gap = phase * speed * dt;
    add_ball(scene, gap, -kSpeed);
    ground.lay(scene);
    const contact::PairProperties<AnyLaw> properties{
        {{kMaterial, kMaterial},
         test::with<contact::LinearFrictional>({.normal_stiffness = stiffness}, {}, {kXi})}};
    Simulation simulation(scene, {.time_step = dt, .motion = {.gravity = Vec3::Zero()}},
                          contact::any_law(properties));
    for (int i = 0; i < 40; ++i) simulation.step();

    const Rebound expected = rebound(mass, stiffness, gap, speed, dt);
    const Vec3 parting = simulation.state().velocity[0] -
                         (ground.speed > 0.0 ? simulation.state().velocity[1] : Vec3::Zero());
    EXPECT_NEAR(parting.z(), expected.speed, 1e-10 * speed) << phase;
    EXPECT_NEAR(simulation.energy().friction, expected.dissipated, 1e-10 * expected.dissipated)
        << phase;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DashpotOn,
                         testing::Values(Ground{"APlane", lay_plane, 0.0, 1.0},
                                         Ground{"AFacet", lay_facet, 0.0, 1.0},
                                         Ground{"AHeldBall", lay_held_ball, 0.0, 1.0},
                                         Ground{"ABall", lay_ball, kSpeed, 0.5}),
                         [](const auto& ground) { return std::string(ground.param.name); });

}  // namespace
}  // namespace plekton::dynamics::dashpot_work_test

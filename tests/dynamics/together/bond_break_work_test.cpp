// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/dynamics/ball_on_ground.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

/// A glued ball that is torn off in a few steps: what its bond takes is what is missing.
namespace plekton::dynamics::bond_break_work_test {
namespace {

using ball_on_ground::add_ball;
using ball_on_ground::kMaterial;
using ball_on_ground::kRadius;
using ball_on_ground::lay_ball;
using ball_on_ground::lay_facet;
using ball_on_ground::lay_plane;
using contact::AnyLaw;

struct Ground {
  const char* name;
  void (*lay)(Scene&);  ///< what has its top at z = 0
  double smaller;       ///< m, radius that a strength is multiplied with
  double speed;         ///< at which both part, in parts of the ball's
  double reduced;       ///< mass that swings, in parts of the ball's
  double sideways;      ///< speed along the ground, in parts of the ball's
  Held held;
};

class BondTo : public testing::TestWithParam<Ground> {};

/// In steps of a tenth of 1 / omega the last pull does a quarter of what the bond stored.
TEST_P(BondTo, LosesWhatItHasStoredLessTheWorkOfItsLastPullWhereItIsTornApart) {
  const Ground& ground = GetParam();
  for (const double speed : {1.0, 1.1, 1.3}) {
    Scene scene;
    scene.materials = {{2e5, 0.5, 0.3}};
    add_ball(scene, -1e-5, speed);
    scene.state.velocity[0].y() = ground.sideways * speed;
    scene.properties.held[0] = ground.held;
    ground.lay(scene);
    const double stiffness = 1000.0;                                                         // N/m
    const double swings = std::sqrt(ground.reduced * scene.properties.mass[0] / stiffness);  // s
    const double dt = 0.1 * swings;
    const double tension = 0.4 * ground.speed * speed * stiffness * swings;  // N
    contact::CohesiveFrictional::Properties glue;
    glue.elastic.normal_stiffness = stiffness;
    glue.tensile_strength = tension / (ground.smaller * ground.smaller);
    glue.shear_strength = 10.0 * glue.tensile_strength;
    glue.bonds = contact::Bonds::at_start;
    const contact::PairProperties<AnyLaw> properties{
        {{kMaterial, kMaterial}, AnyLaw::of<contact::CohesiveFrictional>(glue)}};
    Simulation simulation(scene, {.time_step = dt, .motion = {.gravity = Vec3::Zero()}},
                          contact::any_law(properties));
    for (int i = 0; i < 60; ++i) simulation.step();

    const Energy energy = simulation.energy();
    EXPECT_TRUE(simulation.contact_rows().empty());
    EXPECT_GT(energy.friction, 0.01 * energy.initial) << speed;
    EXPECT_LT(energy.closure(), 1e-10) << speed;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BondTo,
    testing::Values(
        Ground{"APlane", lay_plane, kRadius, 1.0, 1.0, 0.0, Held::nothing},
        Ground{"AFacet", lay_facet, 0.001, 1.0, 1.0, 0.0, Held::nothing},
        Ground{"ABall", lay_ball, kRadius, 2.0, 0.5, 0.0, Held::nothing},
        Ground{"APlaneAlongWhichItGoes", lay_plane, kRadius, 1.0, 1.0, 0.5, Held::rotation},
        Ground{"AFacetAlongWhichItGoes", lay_facet, 0.001, 1.0, 1.0, 0.5, Held::rotation}),
    [](const auto& ground) { return std::string(ground.param.name); });

}  // namespace
}  // namespace plekton::dynamics::bond_break_work_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/dynamics/ball_on_ground.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <tuple>

/// Bodies that slide, roll or twist on what they bounce off. The bounce goes on as without it, so
/// that what the books are off by is the same: the last force and moment of a contact are accounted
/// for to the end of the step that ends it.
namespace plekton::dynamics::last_force_test {
namespace {

using ball_on_ground::add_ball;
using ball_on_ground::kDensity;
using ball_on_ground::kMaterial;
using ball_on_ground::kRadius;
using ball_on_ground::lay_facet;
using ball_on_ground::lay_plane;

constexpr double kSpeed = 0.4;    // m/s, towards the ground
constexpr double kHalf = 0.001;   // m, radius of structures
constexpr double kStep = 4e-5;    // s, some ten of them for a contact
constexpr double kHeight = 0.01;  // m

/// Scenes with a body that is on its way down; all of what moves is among the first nodes.
void ball_on_plane(Scene& scene, double gap) {
  add_ball(scene, gap, -kSpeed);
  lay_plane(scene);
}
void ball_on_facet(Scene& scene, double gap) {
  add_ball(scene, gap, -kSpeed);
  lay_facet(scene);
}
void ball_on_held_ball(Scene& scene, double gap) {
  add_ball(scene, gap, -kSpeed);
  scene.add_sphere(Vec3(0, 0, -kRadius), kRadius, kDensity, kMaterial);
  scene.properties.held.back() = Held::everything;
}
void add_heavy_node(Scene& scene, const Vec3& x) {
  scene.add_node(x);
  scene.state.velocity.back() = Vec3(0, 0, -kSpeed);
  scene.properties.mass.back() = 0.004;
  scene.properties.inertia.back() = 4e-8;
}
/// Touches with its middle.
void bar_on_bar(Scene& scene, double gap) {
  for (const double x : {-0.01, 0.01}) add_heavy_node(scene, Vec3(x, 0, 2 * kHalf + gap));
  scene.add_cylinder(NodeId{0}, NodeId{1}, kHalf, kMaterial);
  const NodeId a = scene.add_node(Vec3(0, -1, 0), Held::everything);
  const NodeId b = scene.add_node(Vec3(0, 1, 0), Held::everything);
  scene.add_cylinder(a, b, kHalf, kMaterial);
}
/// Stands upright, and touches with its first node.
void corner_on_facet(Scene& scene, double gap) {
  add_heavy_node(scene, Vec3(0, 0, kHalf + gap));
  for (const double x : {-0.01, 0.01}) add_heavy_node(scene, Vec3(x, 0, kHalf + kHeight));
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, kHalf, kMaterial);
  lay_facet(scene);
}

struct Ground {
  const char* name;
  void (*lay)(Scene&, double);
  std::size_t moving;  ///< nodes

  friend void PrintTo(const Ground& ground, std::ostream* out) { *out << ground.name; }
};
struct Beside {
  const char* name;
  Vec3 velocity;  ///< m/s
  Vec3 spin;      ///< rad/s
  Held held;
  double friction;

  friend void PrintTo(const Beside& beside, std::ostream* out) { *out << beside.name; }
};
using Case = std::tuple<Ground, Beside, test::NamedLaw>;

class LastForceOf : public testing::TestWithParam<Case> {};

Energy energy_of(const Case& given, double phase, bool is_still) {
  const auto& [ground, beside, law] = given;
  Scene scene;
  scene.materials = {{2e6, 0.5, beside.friction}};
  ground.lay(scene, phase * kSpeed * kStep);
  for (std::size_t i = 0; i < ground.moving; ++i) {
    scene.properties.held[i] = beside.held;
    if (is_still) continue;
    scene.state.velocity[i] += beside.velocity;
    scene.state.angular_velocity[i] = beside.spin;
  }
  Simulation simulation(scene, {.time_step = kStep, .motion = {.gravity = Vec3::Zero()}},
                        contact::any_law({{{kMaterial, kMaterial}, law.properties}}));
  bool has_touched = false;
  bool is_over = false;
  for (int i = 0; i < 500 && !is_over; ++i) {
    simulation.step();
    const bool touches = !simulation.contact_rows().empty();
    is_over = has_touched && !touches;
    has_touched = has_touched || touches;
  }
  EXPECT_TRUE(is_over);
  simulation.step();
  return simulation.energy();
}

TEST_P(LastForceOf, LeavesTheBooksAsABounceWithoutItDoes) {
  for (const double phase : {0.05, 0.3, 0.55, 0.8}) {
    const Energy still = energy_of(GetParam(), phase, true);
    const Energy moving = energy_of(GetParam(), phase, false);

    const double more = moving.initial - still.initial;
    EXPECT_GT(more, 0.0);
    EXPECT_NEAR(moving.closure_error(), still.closure_error(), 1e-10 * more) << phase;
  }
}

const contact::RollingTwisting::Properties kRolling{1.0, 1.0};

const Beside kSlides{"Slides", Vec3(0, 0.3, 0), Vec3::Zero(), Held::rotation, 0.5};
const Beside kRolls{"Rolls", Vec3::Zero(), Vec3(0, 20, 0), Held::nothing, 0.0};
const Beside kTwists{"Twists", Vec3::Zero(), Vec3(0, 0, 20), Held::nothing, 0.5};
const auto kUnderBoth = testing::Values(
    test::NamedLaw{"LinearFrictional", test::with<contact::LinearFrictional>({}, kRolling)},
    test::NamedLaw{"HertzMindlin", test::with<contact::HertzMindlin>({}, kRolling)});
const auto kByName = [](const testing::TestParamInfo<Case>& item) {
  return std::string(std::get<1>(item.param).name) + std::get<0>(item.param).name +
         std::get<2>(item.param).name;
};

INSTANTIATE_TEST_SUITE_P(Flat, LastForceOf,
                         testing::Combine(testing::Values(Ground{"ABallOnAPlane", ball_on_plane, 1},
                                                          Ground{"ABallOnAFacet", ball_on_facet, 1},
                                                          Ground{"ABarOnABar", bar_on_bar, 2},
                                                          Ground{"ACornerOnAFacet", corner_on_facet,
                                                                 3}),
                                          testing::Values(kSlides, kRolls, kTwists), kUnderBoth),
                         kByName);
// What slides on a ball goes round it, and bounces otherwise.
INSTANTIATE_TEST_SUITE_P(Round, LastForceOf,
                         testing::Combine(testing::Values(Ground{"ABallOnABall", ball_on_held_ball,
                                                                 1}),
                                          testing::Values(kRolls, kTwists), kUnderBoth),
                         kByName);

}  // namespace
}  // namespace plekton::dynamics::last_force_test

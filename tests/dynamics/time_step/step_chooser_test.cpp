// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_chooser.hpp"

#include "dynamics/time_step/motion_step.hpp"
#include "geometry/base/state_archive.hpp"
#include "tests/support/resisting_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace plekton::dynamics::step_chooser_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRadius = 0.05;  // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two spheres that are far from each other and rest: nothing but motion limits their step, beside
/// the contacts that may come.
Scene two_spheres() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  for (const double x : {-1.0, 1.0})
    scene.add_sphere(Vec3(x, 0, 0), kRadius, 1000.0, contact::MaterialId{0});
  return scene;
}

struct Chosen : test::ResistingScene {
  explicit Chosen(Scene of = two_spheres()) : ResistingScene(std::move(of)) {}

  double first(const Pace& pace) {
    NodalStiffness space(scene.state.size(), &scene.properties, &rigid);
    const double critical = limits.critical(space, scene.state.position).dt;
    return chooser.first(critical, std::move(space), pace);
  }

  StepLimits limits{resistance()};
  StepChooser chooser{resistance(), limits};
};

TEST(StepChooser, BeginsBelowItsPartOfTheCriticalStepAndWithTheMotion) {
  Chosen slow;
  const double critical = slow.limits.critical(slow.scene.state.position).dt;
  const double usual = slow.first({0, 0.0, 0.0});
  EXPECT_LE(usual, kSafety * critical);
  EXPECT_GT(usual, 0.0);
  EXPECT_EQ(slow.chooser.last_chosen(), usual);

  // At such a speed a tenth of the radius takes a tenth of that.
  const double speed = kLargestMotion * kRadius / (0.1 * usual);
  EXPECT_NEAR(Chosen().first({0, speed, 0.0}), 0.1 * usual, 8.0 * kEpsilon * usual);
  // And falling: 64 steps add to the speed.
  const double gravity = 1e3 * speed * speed;
  EXPECT_NEAR(Chosen().first({0, speed, gravity}), longest_step(speed, gravity, kRadius),
              8.0 * kEpsilon * usual);
}

TEST(StepChooser, HasNothingToChooseWhereNothingIsStiffAndFree) {
  Scene scene;
  scene.add_node(Vec3::Zero());
  scene.properties.mass[0] = scene.properties.inertia[0] = 1.0;
  Chosen lump(std::move(scene));

  EXPECT_EQ(lump.first({0, 1e6, 0.0}), kInfinity);
}

TEST(StepChooser, GrowsByATenthAfterSixtyFourStepsAndShrinksAtOnce) {
  Chosen spheres;
  const double usual = spheres.first({0, 0.0, 0.0});
  const double fast = kLargestMotion * kRadius / (0.25 * usual);

  double dt = spheres.chooser.choose(usual, {7, fast, 0.0});
  EXPECT_NEAR(dt, 0.25 * usual, 8.0 * kEpsilon * usual);
  EXPECT_EQ(spheres.chooser.choose(dt, {8, 0.0, 0.0}), dt);

  for (int look = 1; look <= 20; ++look) {
    const double next = spheres.chooser.choose(dt, {64 * look, 0.0, 0.0});
    EXPECT_NEAR(next, std::min(kGrowth * dt, usual), 8.0 * kEpsilon * usual);
    dt = next;
  }
  EXPECT_NEAR(dt, usual, 8.0 * kEpsilon * usual);
}

TEST(StepChooser, LooksAgainEverySixtyFourStepsAndWhenItIsAskedTo) {
  Chosen spheres;
  const double dt = spheres.first({0, 1.0, 0.0});
  spheres.chooser.moved(0.0);

  for (const std::int64_t steps : {0, 1, 63, 65, 127}) {
    EXPECT_FALSE(spheres.chooser.is_due(steps, dt, 0.0)) << steps;
    EXPECT_TRUE(spheres.chooser.is_due(steps, dt, 1.01 / dt)) << steps;  // it turns by a radian
    EXPECT_FALSE(spheres.chooser.is_due(steps, dt, 0.99 / dt)) << steps;
  }
  for (const std::int64_t steps : {64, 128}) EXPECT_TRUE(spheres.chooser.is_due(steps, dt, 0.0));

  spheres.chooser.look_again();
  EXPECT_TRUE(spheres.chooser.is_due(1, dt, 0.0));
  spheres.chooser.choose(dt, {1, 1.0, 0.0});
  EXPECT_FALSE(spheres.chooser.is_due(1, dt, 0.0));
}

/// So that what is nearer than twice the way counts, and all that may touch is: with the drift that
/// begins, as fast as the last one and faster by as much again.
TEST(StepChooser, LooksAgainBeforeAnythingHasGoneFurtherThanItLooked) {
  int looks = 0;
  for (const double speed : {0.01, 1.0, 10.0, 100.0}) {
    Chosen spheres;
    const double dt = spheres.first({0, speed, 0.0});
    const double way = dt * speed;  // m, in a step
    const double looked = std::max(kLongestWay * kRadius, way);

    EXPECT_FALSE(spheres.chooser.is_due(1, dt, 0.0));
    double gone = 0.0;
    for (int step = 1; step < 64 && !spheres.chooser.is_due(step, dt, 0.0); ++step) {
      spheres.chooser.moved(way);
      gone += way;
      ASSERT_LE(gone, (1.0 + 1e-12) * looked);
    }
    looks += spheres.chooser.is_due(1, dt, 0.0);
  }
  EXPECT_GE(looks, 2);  // of the fast ones
}

TEST(StepChooser, GoesOnFromAStateAsItWouldHaveGoneOn) {
  Chosen one, other;
  const double dt = one.first({0, 2.0, 0.0});
  one.chooser.moved(1e-3 * kRadius);
  geometry::StateTree tree;
  one.chooser.exchange(geometry::StateArchive::writer(tree));

  other.first({0, 30.0, 0.0});
  other.chooser.exchange(geometry::StateArchive::reader(tree));

  EXPECT_EQ(other.chooser.last_chosen(), dt);
  for (int step = 1; step < 64; ++step) {
    const bool is_due = one.chooser.is_due(step, dt, 0.0);
    EXPECT_EQ(other.chooser.is_due(step, dt, 0.0), is_due);
    one.chooser.moved(2e-3 * kRadius);
    other.chooser.moved(2e-3 * kRadius);
  }
  EXPECT_TRUE(one.chooser.is_due(63, dt, 0.0));
  const Pace slower{64, 0.5, 0.0};
  EXPECT_EQ(other.chooser.choose(dt, slower), one.chooser.choose(dt, slower));
}

}  // namespace
}  // namespace plekton::dynamics::step_chooser_test

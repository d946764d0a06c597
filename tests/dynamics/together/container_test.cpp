// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/base/plane.hpp"
#include "dynamics/carry_over/scene_change.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

/// Balls and sheets in containers, against the mechanics of a point on a circle.
namespace plekton::dynamics::container_test {
namespace {

using contact::Plane;
using geometry::NodeId;

constexpr contact::MaterialId kMaterial{0};
constexpr double kBall = 0.01;     // m
constexpr double kInside = 0.1;    // m
constexpr double kGravity = 9.81;  // m/s²
constexpr double kDensity = 2500.0;

Plane cylinder() {
  return {.point = Vec3(0.3, -0.2, 0.5),
          .normal = Vec3::Zero(),
          .material = kMaterial,
          .form = Plane::Form::cylinder,
          .radius = kInside,
          .axis = Vec3::UnitX()};
}
Plane sphere() {
  Plane plane = cylinder();
  plane.form = Plane::Form::sphere;
  return plane;
}

/// m, of a centre that touches at an angle from the lowest place, about the x-axis.
Vec3 place_at(const Plane& plane, double angle, double gap = 0.0) {
  return plane.point + (kInside - kBall - gap) * Vec3(0.0, std::sin(angle), -std::cos(angle));
}
double angle_of(const Plane& plane, const Vec3& centre) {
  const Vec3 way = centre - plane.point;
  return std::atan2(way.y(), -way.z());
}

/// @param friction  tangent of the friction angle
Scene with(const Plane& plane, double friction, double stiffness) {
  Scene scene;
  scene.materials = {{stiffness, 0.5, friction}};
  scene.planes = {plane};
  return scene;
}
Simulation run_of(const Scene& scene, double step) {
  return {scene, {.time_step = step, .motion = {.gravity = Vec3(0, 0, -kGravity)}}};
}

struct Swing {
  const char* name;
  Plane plane;
  double friction;  ///< tangent of its angle
  double moved;     ///< mass that swings, in parts of that which falls
};
class SwingIn : public testing::TestWithParam<Swing> {};

/// A ball that slides is a pendulum of the length R - r; one that rolls has 2/5 of its mass more
/// to move (Goldstein, Poole and Safko, Classical Mechanics, 2002, section 1.4).
TEST_P(SwingIn, TakesThePeriodOfAPendulum) {
  const Swing& swing = GetParam();
  constexpr double kAmplitude = 0.05;  // rad
  constexpr double kStep = 2e-5;       // s
  Scene scene = with(swing.plane, swing.friction, 1e7);
  scene.add_sphere(place_at(swing.plane, kAmplitude), kBall, kDensity, kMaterial);
  Simulation simulation = run_of(scene, kStep);

  // From the first passage through the lowest place to the third: one period.
  double first = 0.0, third = 0.0, before = kAmplitude;
  for (int passages = 0; passages < 3;) {
    simulation.step();
    const double now = angle_of(swing.plane, simulation.state().position[0]);
    if (now * before < 0.0) {
      ++passages;
      const double time = simulation.time() - kStep * now / (now - before);
      (passages == 1 ? first : third) = time;
    }
    before = now;
  }

  const double period = 2.0 * std::numbers::pi *
                        std::sqrt(swing.moved * (kInside - kBall) / kGravity) *
                        (1.0 + kAmplitude * kAmplitude / 16.0);
  // The overlap is m g / k, 1e-5 of the length; the rest is the fourth power of the amplitude
  // and that the ball bounces as it is let go.
  EXPECT_NEAR(third - first, period, 1e-4 * period);
  EXPECT_LT(simulation.energy().closure(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, SwingIn,
                         testing::Values(Swing{"ACylinderWithoutFriction", cylinder(), 0.0, 1.0},
                                         Swing{"ASphereWithoutFriction", sphere(), 0.0, 1.0},
                                         Swing{"ACylinderRolling", cylinder(), 0.8, 1.4},
                                         Swing{"ASphereRolling", sphere(), 0.8, 1.4}),
                         [](const auto& swing) { return std::string(swing.param.name); });

/// A ball that begins at the lowest place of a drum that turns.
class BallInDrum : public testing::Test {
 protected:
  static constexpr double kTurning = 3.0;   // rad/s
  static constexpr double kFriction = 0.4;  // tangent of its angle
  static constexpr double kModulus = 1e7;   // Pa
  static constexpr double kStep = 2e-5;     // s

  /// As deep in the wall as its weight presses it: E r as stiffness of both sides in series.
  BallInDrum() : scene_(with(drum(), kFriction, kModulus)) {
    scene_.add_sphere(place_at(drum(), 0.0, -overlap()), kBall, kDensity, kMaterial);
  }

  NodeState after(double time, double damping = 0.0) const {
    SimulationOptions options{.time_step = kStep, .motion = {.gravity = Vec3(0, 0, -kGravity)}};
    options.motion.damping = damping;
    Simulation simulation(scene_, options);
    while (simulation.time() < time) simulation.step();
    return simulation.state();
  }
  static double overlap() {
    const double volume = 4.0 / 3.0 * std::numbers::pi * kBall * kBall * kBall;
    return kDensity * volume * kGravity / (kModulus * kBall);
  }
  static Plane drum() {
    Plane plane = cylinder();
    plane.angular_velocity = kTurning;
    return plane;
  }

  Scene scene_;
};

/// What does not turn slides on the wall, which carries it up to where its weight along the wall is
/// the friction. About x the lowest place of a drum goes from y = 0 towards +y. Each swing of 0.6 s
/// takes away more than a third: 1e-8 of the first one is left.
TEST_F(BallInDrum, IsCarriedToItsFrictionAngleWhileItSlides) {
  scene_.properties.held[0] = Held::rotation;
  EXPECT_NEAR(angle_of(drum(), after(20.0, 0.3).position[0]), std::atan(kFriction), 1e-6);
}

/// A sliding ball has the spin 5/2 mu g t / r (Coriolis, Theorie mathematique des effets du jeu de
/// billard, 1835); meanwhile it has gone mu g t² / 2, which is 5e-4 rad.
TEST_F(BallInDrum, IsTurnedByTheFrictionOfTheWall) {
  constexpr double kTime = 5e-3;
  const double spin = 2.5 * kFriction * kGravity * kTime / kBall;

  EXPECT_NEAR(after(kTime).angular_velocity[0].x(), spin, 0.01 * spin);
}

/// Both touch in the middle of their overlap, where they are as fast.
TEST_F(BallInDrum, GoesOnRollingAtTheLowestPlace) {
  const double spin = kTurning * (kInside + 0.5 * overlap()) / (kBall - 0.5 * overlap());
  scene_.state.angular_velocity[0] = Vec3(spin, 0, 0);
  const NodeState state = after(2.0);

  EXPECT_NEAR(angle_of(drum(), state.position[0]), 0.0, 1e-8);
  EXPECT_NEAR(state.angular_velocity[0].x(), spin, 1e-8 * spin);
}

/// What the motor of a drum does is what bodies do to it about its axis, times its turn.
TEST(Drum, IsTurnedByWorkAgainstTheMomentOfItsBodies) {
  constexpr double kTurning = 3.0;
  constexpr double kStep = 2e-5;
  Plane drum = cylinder();
  drum.angular_velocity = kTurning;
  Scene scene = with(drum, 0.4, 1e7);
  for (const double angle : {-0.3, 0.0, 0.3})
    scene.add_sphere(place_at(drum, angle), kBall, kDensity, kMaterial);
  Simulation simulation = run_of(scene, kStep);
  double work = 0.0;
  for (int i = 0; i < 5000; ++i) {
    simulation.step();
    work -= kStep * kTurning * simulation.plane_reaction(0).moment.dot(drum.axis);
  }

  EXPECT_NEAR(simulation.energy().external_work, work, 1e-3 * work);
  EXPECT_LT(simulation.energy().closure(), 2e-3);
}

/// A state of another turn is that of another scene, as its velocity would be that of the state.
TEST(Drum, IsNotGoneOnWithAtAnotherPace) {
  const SimulationOptions options{.time_step = 2e-5, .motion = {.gravity = Vec3::Zero()}};
  const auto turning = [&](double pace) {
    Plane drum = cylinder();
    drum.angular_velocity = pace;
    Scene scene = with(drum, 0.4, 1e7);
    scene.add_sphere(place_at(drum, 0.0), kBall, kDensity, kMaterial);
    return Simulation(scene, options);
  };
  Simulation slow = turning(3.0), fast = turning(4.0);

  EXPECT_THROW(fast.restore(slow.snapshot()), geometry::StateMismatch);
  EXPECT_NO_THROW(turning(3.0).restore(slow.snapshot()));
}

/// Of the bodies in a container, moved and turned with it, nothing is different.
TEST(Container, PushesASheetByItsNodesWhereverItLies) {
  const Plane plane = cylinder();
  Scene scene = with(plane, 0.4, 1e6);
  const auto node = [&](double angle, double along) {
    return scene.add_node(place_at(plane, angle) + along * plane.axis, Held::nothing);
  };
  scene.add_facet(node(0.4, 0.0), node(-0.4, 0.0), node(0.0, 0.05), kBall, kMaterial);
  for (std::size_t i = 0; i < 3; ++i) {
    scene.properties.mass[i] = 0.01;
    scene.properties.inertia[i] = 1e-6;
  }
  Simulation simulation = run_of(scene, 1e-5);

  for (int i = 0; i < 2000; ++i) simulation.step();

  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_GT(plane.height(simulation.state().position[i]), 0.99 * kBall);
  EXPECT_EQ(simulation.contacts().counts().with_planes, 3U);
}

/// Balls around the axis of a cylinder, or the centre of a sphere, between the wall and a held ball.
class ServoOn : public testing::TestWithParam<Plane::Form> {
 protected:
  static constexpr double kModulus = 1e6;  // Pa
  static constexpr double kWanted = 8.0;   // N, of all together
  static constexpr int kBalls = 4;

  /// A held ball in the middle, and others around it that touch it and not quite the container.
  static Scene scene() {
    Plane plane = cylinder();
    plane.form = GetParam();
    plane.radius = 3.0 * kBall + kGap;
    Scene scene = with(plane, 0.3, kModulus);
    scene.add_sphere(plane.point, kBall, kDensity, kMaterial);
    scene.properties.held[0] = Held::everything;
    for (int i = 0; i < kBalls; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kBalls;
      scene.add_sphere(plane.point + 2.0 * kBall * Vec3(0, std::cos(angle), std::sin(angle)), kBall,
                       kDensity, kMaterial);
    }
    PlaneServo servo;
    servo.force = kWanted;
    servo.largest_speed = 0.05;
    scene.loads.servos = {servo};
    return scene;
  }
  /// Of a scene of the same bodies.
  static SceneChange nothing_else() { return {{{0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, {0}}, {}}; }
  static constexpr double kGap = 1e-4;  // m
};

/// Each ball bears its share k u between two springs k in a row: the container and the middle.
TEST_P(ServoOn, ClosesAContainerUntilAllThatItHoldsBearsTheForce) {
  SimulationOptions options{.time_step = 2e-5, .motion = {.gravity = Vec3::Zero()}};
  options.motion.damping = 0.3;
  Simulation simulation(scene(), options);

  for (int i = 0; i < 20000; ++i) simulation.step();

  const double stiffness = kModulus * kBall;
  const double overlap = kWanted / kBalls / stiffness;
  const Plane& plane = simulation.planes()[0];
  EXPECT_NEAR(simulation.pressing_on(0), kWanted, 1e-6 * kWanted);
  EXPECT_NEAR(plane.radius, 3.0 * kBall - 2.0 * overlap, 1e-6 * overlap);
  EXPECT_NEAR(plane.widening, 0.0, 1e-9);
  EXPECT_LT(simulation.energy().closure(), 1e-3);
}

/// Springs hold, and bodies have, what the servo puts in: with linear springs that go on touching a
/// leapfrog has it to rounding.
TEST_P(ServoOn, DoesTheWorkThatItsContentsTakeUp) {
  Simulation simulation(scene(), {.time_step = 5e-6, .motion = {.gravity = Vec3::Zero()}});

  double error = 0.0;
  for (int i = 0; i < 20000; ++i) {
    simulation.step();
    error = std::max(error, std::abs(simulation.energy().closure_error()));
  }

  EXPECT_GT(simulation.energy().external_work, 0.0);
  EXPECT_LT(error, 1e-9 * simulation.energy().external_work);
}

/// Also where it closes by itself, as it was made.
TEST_P(ServoOn, IsNotNeededForTheWorkToBeCounted) {
  Scene closing = scene();
  closing.loads.servos.clear();
  closing.planes[0].widening = -0.01;
  Simulation simulation(closing, {.time_step = 5e-6, .motion = {.gravity = Vec3::Zero()}});

  for (int i = 0; i < 6000; ++i) simulation.step();

  EXPECT_GT(simulation.energy().external_work, 0.0);
  EXPECT_LT(simulation.energy().closure(), 1e-4);
}

TEST_P(ServoOn, GoesOnFromAStateAsIfItHadNotBeenStopped) {
  const SimulationOptions options{.time_step = 2e-5, .motion = {.gravity = Vec3::Zero()}};
  Simulation whole(scene(), options);
  for (int i = 0; i < 200; ++i) whole.step();
  const geometry::StateTree kept = whole.snapshot();
  Simulation next(scene(), options);
  next.restore(kept);
  for (int i = 0; i < 300; ++i) {
    whole.step();
    next.step();
  }

  EXPECT_EQ(state_hash(next), state_hash(whole));
  EXPECT_NE(whole.planes()[0].radius, scene().planes[0].radius);
}

/// What drives it from now on says all of how it moves.
TEST_P(ServoOn, LeavesNothingOfItsPaceToAMotionThatFollows) {
  const SimulationOptions options{.time_step = 2e-5, .motion = {.gravity = Vec3::Zero()}};
  Simulation before(scene(), options);
  for (int i = 0; i < 50; ++i) before.step();
  ASSERT_LT(before.planes()[0].widening, 0.0);
  Scene moved = scene();
  moved.loads.servos.clear();
  moved.loads.plane_motions = {{0, Vec3(0.01, 0, 0), {}}};
  Simulation next(moved, options);
  next.go_on_from(before, nothing_else());
  const double radius = next.planes()[0].radius;

  for (int i = 0; i < 50; ++i) next.step();

  EXPECT_EQ(radius, before.planes()[0].radius);
  EXPECT_EQ(next.planes()[0].radius, radius);
}

TEST_P(ServoOn, TakesNothingOfTheVelocityOfAMotionBefore) {
  const SimulationOptions options{.time_step = 2e-5, .motion = {.gravity = Vec3::Zero()}};
  Scene moved = scene();
  moved.loads.servos.clear();
  moved.loads.plane_motions = {{0, Vec3(0.01, 0, 0), {}}};
  Simulation before(moved, options);
  for (int i = 0; i < 50; ++i) before.step();
  Simulation next(scene(), options);
  next.go_on_from(before, nothing_else());

  for (int i = 0; i < 50; ++i) next.step();

  EXPECT_EQ(next.planes()[0].point, before.planes()[0].point);
  EXPECT_LT(next.planes()[0].radius, before.planes()[0].radius);
}

/// A held ball bears 1e4 N/m times what it is deep in the wall: far less than the force.
TEST_P(ServoOn, NeverClosesAContainerAltogether) {
  Plane plane = cylinder();
  plane.form = GetParam();
  Scene pressed = with(plane, 0.3, kModulus);
  pressed.add_sphere(plane.point, kBall, kDensity, kMaterial);
  pressed.properties.held[0] = Held::everything;
  pressed.loads.servos = scene().loads.servos;
  pressed.loads.servos[0].force = 1e6;
  pressed.loads.servos[0].largest_speed = 10.0;
  Simulation simulation(pressed, {.time_step = 1e-4, .motion = {.gravity = Vec3::Zero()}});

  for (int i = 0; i < 1000; ++i) simulation.step();

  EXPECT_GT(simulation.planes()[0].radius, 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ServoOn, testing::Values(Plane::Form::cylinder, Plane::Form::sphere),
                         [](const auto& form) {
                           return form.param == Plane::Form::cylinder ? "ACylinder" : "ASphere";
                         });

}  // namespace
}  // namespace plekton::dynamics::container_test

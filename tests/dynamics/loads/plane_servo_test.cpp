// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/plane_servo.hpp"

#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace plekton::test {
namespace {

using dynamics::PlaneMotion;
using dynamics::PlanePress;
using dynamics::PlaneServo;
using dynamics::TimeTable;
using testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr contact::MaterialId kMaterial{0};

PlaneServo servo_of(double force) {
  PlaneServo servo;
  servo.force = force;
  servo.largest_speed = 0.5;
  return servo;
}

/// Springs of 1e4 N/m, one of which the plate presses already and one that is a gap (m) away.
std::function<PlanePress(double)> springs(double pressed, double gap) {
  constexpr double kStiffness = 1e4;
  return [=](double way) {
    PlanePress press;
    for (const double overlap : {pressed + way, way - gap}) {
      if (!(overlap > 0.0)) continue;
      press.force += kStiffness * overlap;
      press.stiffness += kStiffness;
    }
    return press;
  };
}

TEST(ServoSpeed, BringsTheForceNearerByItsGainInAStep) {
  PlaneServo servo = servo_of(10.0);
  servo.gain = 0.2;
  constexpr double kStep = 1e-3;
  const auto press = springs(1e-3, 1.0);

  // 2 N are missing: 0.2 of them are 0.4 N, for which the contacts have to be pressed by 40 um.
  EXPECT_NEAR(servo_speed({servo.largest_speed, servo.gain}, 2.0, press, kStep), 0.04, 1e-3 * 0.04);
  EXPECT_DOUBLE_EQ(servo_speed({servo.largest_speed, servo.gain}, -2.0, press, kStep), -0.04);
}

TEST(ServoSpeed, IsBoundedAndComesOnWithoutContacts) {
  const PlaneServo servo = servo_of(10.0);
  const auto touching = springs(1e-3, 1.0);
  const auto apart = springs(-1.0, 1.0);

  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, 1e6, touching, 1e-3), 0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, -1e6, touching, 1e-3), -0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, 10.0, apart, 1e-3), 0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, 0.0, apart, 1e-3), 0.0);
}

TEST(ServoSpeed, TouchesFirstAndThenPressesWithNoMoreThanItsGain) {
  PlaneServo servo = servo_of(10.0);
  servo.gain = 0.2;
  constexpr double kStep = 1e-3;
  const auto way = [&](double pressed, double gap) {
    return servo_speed({servo.largest_speed, servo.gain}, 10.0, springs(pressed, gap), kStep) *
           kStep;
  };

  // 2 N are 0.2 mm: from 0.3 mm away it goes to the spring, from 0.1 mm away it presses.
  EXPECT_NEAR(way(-3e-4, 1.0), 3e-4, 2e-3 * 2e-4);
  EXPECT_NEAR(way(-1e-4, 1.0), 3e-4, 1e-3 * 3e-4);
  // With a second spring that begins 0.1 mm further on, half of the rest falls to each.
  EXPECT_NEAR(way(1e-9, 1e-4), 1.5e-4, 1e-3 * 1.5e-4);
}

TEST(PlateArea, IsWhatTheFacingPlanesLeaveFree) {
  PlaneServo servo = servo_of(1.0);
  const std::vector<contact::Plane> planes = {{Vec3(-1.0, 0, 0), Vec3::UnitX()},
                                              {Vec3(2.0, 5, 5), -Vec3::UnitX()}};
  servo.area = 0.5;
  EXPECT_EQ(plate_area(servo, planes), 0.5);
  servo.between = {{0, 1}};
  EXPECT_EQ(plate_area(servo, planes), 1.5);
}

/// A grain on a floor, and a plate a little above.
Scene grain_under_a_plate() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_sphere(Vec3(0.0, 0.0, 0.01), 0.01, 2650.0, kMaterial);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.planes.push_back({Vec3(0.0, 0.0, 0.0205), -Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  return scene;
}

TEST(PlaneServo, PressesAGrainWithItsForceAndStopsThere) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(3.0)};
  scene.loads.servos[0].plane = 1;
  auto simulation = simulation_of(scene, 0.25 * LoadedSimulation(scene, {}).time_step());

  const double error = closure_until(simulation, 0.3);

  EXPECT_NEAR(simulation.contacts().force_on_plane(1).z(), 3.0, 1e-6 * 3.0);
  EXPECT_NEAR(simulation.contacts().force_on_plane(0).z(), -3.0,
              0.05 * 3.0);  // the grain rings without damping
  EXPECT_GT(simulation.energy().external_work, 0.0);
  EXPECT_LT(error, 0.01);  // of first order: the moment at which the plate strikes
}

// A plate that struck at 1 m/s would be in the grain by up to 0.4 % of its radius when it is felt.
TEST(PlaneServo, KeepsTheEnergyBalanceAtWhateverMomentOfAStepItArrives) {
  constexpr int kPhases = 8;
  for (int phase = 0; phase < kPhases; ++phase) {
    Scene scene = grain_under_a_plate();
    scene.materials[0].young_modulus = 5e7;
    scene.loads.servos = {servo_of(10.0)};
    scene.loads.servos[0].plane = 1;
    scene.loads.servos[0].largest_speed = 1.0;
    const double step = LoadedSimulation(scene, {}).time_step();
    scene.planes[1].point.z() = 0.0205 + step * phase / kPhases;
    auto simulation = simulation_of(scene, 0.0);

    EXPECT_LT(closure_until(simulation, 0.05), 0.005) << "phase " << phase;
    EXPECT_NEAR(simulation.contacts().force_on_plane(1).z(), 10.0, 0.01) << phase;
  }
}

TEST(PlaneServo, KeepsItsVelocityAcrossTheNormal) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(3.0)};
  scene.loads.servos[0].plane = 1;
  scene.planes[1].velocity = Vec3(0.1, 0.0, 0.0);
  LoadedSimulation simulation(scene, {});

  for (int i = 0; i < 1000; ++i) simulation.step();

  EXPECT_NEAR(simulation.planes()[1].point.x(), 0.1 * simulation.time(), 1e-15);
  EXPECT_LT(simulation.planes()[1].point.z(), 0.0205);
}

TEST(PlaneMotion, IsAtTheIntegralOfItsTableAfterEveryStep) {
  Scene scene = grain_under_a_plate();
  PlaneMotion motion{1, Vec3(0.5, 0.0, -0.01), TimeTable({{0.0, 0.0}, {0.02, 1.0}, {0.05, -1.0}})};
  scene.loads.plane_motions = {motion};
  LoadedSimulation simulation(scene, {});

  while (simulation.time() < 0.06) {
    simulation.step();
    const Vec3 expected =
        Vec3(0.0, 0.0, 0.0205) + motion.factor.integral(simulation.time()) * motion.velocity;
    EXPECT_LE((simulation.planes()[1].point - expected).norm(), 8.0 * kEps * 0.03);
  }
}

TEST(PlaneMotion, IsCountedInTheEnergyToSecondOrder) {
  Scene scene = grain_under_a_plate();
  scene.planes[1].point.z() = 0.01995;
  scene.loads.plane_motions = {
      {1, Vec3(0.01, 0.0, -0.02), TimeTable({{0.0, 0.0}, {0.01, 1.0}, {0.02, -0.5}})}};
  const double dt = LoadedSimulation(scene, {}).time_step();
  auto coarse = simulation_of(scene, 0.25 * dt);

  EXPECT_LT(closure_until(coarse, 0.02), 1e-3);
  EXPECT_GT(coarse.energy().external_work, 0.0);
}

TEST(PlaneServo, IsRefusedWithoutATargetOrWithAPlaneThatIsDrivenAlready) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(0.0), servo_of(2.0), servo_of(2.0)};
  scene.loads.servos[1].plane = 7;
  scene.loads.servos[2].largest_speed = 0.0;
  scene.loads.servos[2].gain = 1.5;
  scene.loads.servos[2].area = -1.0;
  scene.loads.servos[2].between = {{0, 0}};
  scene.loads.plane_motions = {{0, Vec3::UnitX(), {}}};
  scene.planes[0].velocity = Vec3::UnitX();

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("servo 0: has no target; give a force (N) or a pressure (Pa)"));
  EXPECT_THAT(problems, HasSubstr("servo 1: there is no plane 7, only 2 planes"));
  EXPECT_THAT(problems, HasSubstr("servo 2: its largest speed must be above 0"));
  EXPECT_THAT(problems, HasSubstr("servo 2: its gain must be above 0, at most 1"));
  EXPECT_THAT(problems, HasSubstr("servo 2: its area must be above 0"));
  EXPECT_THAT(problems, HasSubstr("servo 2: planes 0 and 0 do not face each other"));
  EXPECT_THAT(problems, HasSubstr("servo 0: plane 0 is driven already"));
  EXPECT_THAT(problems, HasSubstr("motion of a plane 0: plane 0 has a velocity of its own"));
}

}  // namespace
}  // namespace plekton::test

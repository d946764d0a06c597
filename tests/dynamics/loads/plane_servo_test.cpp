// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/plane_servo.hpp"

#include "contact/models.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plekton::test::plane_servo_test {
namespace {

using dynamics::PlaneMotion;
using dynamics::PlanePress;
using dynamics::PlaneServo;
using dynamics::ServoTime;
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

/// A plate at rest that feels 10 N.
dynamics::ServoPlate missing(double force) {
  return {10.0 + force, 10.0, 0.0};
}

/// Springs of 1e4 N/m, one of which the plate presses already and one that is a gap (m) away.
dynamics::PressOfWay springs(double pressed, double gap) {
  constexpr double kStiffness = 1e4;
  return [=](double way, ServoTime) {
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
  EXPECT_NEAR(servo_speed({servo.largest_speed, servo.gain}, missing(2.0), press, kStep), 0.04,
              1e-3 * 0.04);
  EXPECT_DOUBLE_EQ(servo_speed({servo.largest_speed, servo.gain}, missing(-2.0), press, kStep),
                   -0.04);
}

// v = gain (wanted - felt + c v_last) / (k dt + gain c), whatever the plate felt of c v_last.
TEST(ServoSpeed, DoesNotFollowWhatItFeelsOfItsOwnSpeed) {
  constexpr double kStep = 1e-3;
  constexpr double kStiffness = 1e4;
  constexpr double kDashpot = 500.0;  // N s/m: gain c / (k dt) is 10
  constexpr double kElastic = 10.0;   // N
  const auto press = [](double way, ServoTime) {
    return PlanePress{kElastic + kStiffness * way, kStiffness, kDashpot};
  };
  const double expected = 0.2 * 2.0 / (kStiffness * kStep + 0.2 * kDashpot);
  for (const double last : {0.0, 0.03, -0.01}) {
    const double felt = kElastic + kDashpot * last;
    const double speed =
        dynamics::servo_speed({0.5, 0.2}, {kElastic + 2.0, felt, last}, press, kStep);
    EXPECT_NEAR(speed, expected, 1e-3 * expected) << last;
  }
  // A dashpot never pulls: a plate that went back so fast felt nothing, and comes on again.
  const double speed = dynamics::servo_speed({0.5, 0.2}, {kElastic + 2.0, 0.0, -0.2}, press, kStep);
  EXPECT_NEAR(speed, expected, 1e-3 * expected);
}

TEST(ServoSpeed, IsBoundedAndComesOnWithoutContacts) {
  const PlaneServo servo = servo_of(10.0);
  const auto touching = springs(1e-3, 1.0);
  const auto apart = springs(-1.0, 1.0);

  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, missing(1e6), touching, 1e-3), 0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, missing(-1e6), touching, 1e-3), -0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, missing(10.0), apart, 1e-3), 0.5);
  EXPECT_EQ(servo_speed({servo.largest_speed, servo.gain}, missing(0.0), apart, 1e-3), 0.0);
}

TEST(ServoSpeed, TouchesFirstAndThenPressesWithNoMoreThanItsGain) {
  PlaneServo servo = servo_of(10.0);
  servo.gain = 0.2;
  constexpr double kStep = 1e-3;
  const auto way = [&](double pressed, double gap) {
    return servo_speed({servo.largest_speed, servo.gain}, missing(10.0), springs(pressed, gap),
                       kStep) *
           kStep;
  };

  // 2 N are 0.2 mm. It goes to the spring, a thousandth of that deep, however near it is.
  EXPECT_NEAR(way(-3e-4, 1.0), 3e-4, 2e-3 * 2e-4);
  EXPECT_NEAR(way(-1e-4, 1.0), 1e-4, 2e-3 * 2e-4);
  EXPECT_NEAR(way(1e-9, 1.0), 2e-4, 1e-3 * 2e-4);
  // With a second spring that begins 0.1 mm further on, half of the rest falls to each.
  EXPECT_NEAR(way(1e-9, 1e-4), 1.5e-4, 1e-3 * 1.5e-4);
}

// A body that comes on at 0.2 m/s is 0.2 mm nearer at the end of the drift.
TEST(ServoSpeed, MeetsWhatComesToItWhereThatWillBe) {
  constexpr double kStep = 1e-3;
  const auto speed = [&](double gap) {
    const auto press = [gap](double way, ServoTime when) {
      const double nearer = when == ServoTime::now ? 0.0 : 0.2 * kStep;
      return springs(-1.0, gap - nearer)(way, when);
    };
    return servo_speed({0.5, 0.2}, missing(10.0), press, kStep);
  };
  EXPECT_NEAR(speed(5e-4), 0.3, 1e-2 * 0.3);
  EXPECT_EQ(speed(1e-4), 0.0);  // it comes by itself
}

TEST(PlateArea, IsWhatTheFacingPlanesLeaveFree) {
  PlaneServo servo = servo_of(1.0);
  const std::vector<contact::Plane> planes = {{Vec3(-1.0, 0, 0), Vec3::UnitX()},
                                              {Vec3(2.0, 5, 5), -Vec3::UnitX()}};
  servo.area = 0.5;
  EXPECT_EQ(dynamics::plate_area(servo.area, servo.between, planes), 0.5);
  servo.between = {{0, 1}};
  EXPECT_EQ(dynamics::plate_area(servo.area, servo.between, planes), 1.5);
  servo.pressure = 4.0;
  EXPECT_EQ(dynamics::full_target(servo, planes), 1.0 + 4.0 * 1.5);
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

  EXPECT_NEAR(simulation.contacts().on_plane(1).force.z(), 3.0, 1e-6 * 3.0);
  EXPECT_NEAR(simulation.contacts().on_plane(0).force.z(), -3.0,
              0.05 * 3.0);  // the grain rings without damping
  EXPECT_GT(simulation.energy().external_work, 0.0);
  EXPECT_LT(error, 0.01);  // of first order: the moment at which the plate strikes
}

TEST(PlaneServo, FollowsATargetThatIsSetWhileItRuns) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(3.0)};
  scene.loads.servos[0].plane = 1;
  auto simulation = simulation_of(scene, 0.25 * LoadedSimulation(scene, {}).time_step());
  closure_until(simulation, 0.2);
  EXPECT_NEAR(simulation.contacts().on_plane(1).force.z(), 3.0, 1e-4 * 3.0);

  simulation.set_servo(0, 1.0, 4.0);  // N, and Pa on 1 m²
  const double error = closure_until(simulation, 0.4);

  EXPECT_NEAR(simulation.contacts().on_plane(1).force.z(), 5.0, 1e-4 * 5.0);
  EXPECT_LT(error, 0.01);
  EXPECT_THROW(simulation.set_servo(1, 1.0), std::out_of_range);
  EXPECT_THROW(simulation.set_servo(0, 0.0), std::invalid_argument);
  EXPECT_THROW(simulation.set_servo(0, -1.0, 2.0), std::invalid_argument);
  EXPECT_THROW(simulation.set_servo(0, std::numeric_limits<double>::infinity()),
               std::invalid_argument);
}

// The floor goes up under a grain that lies under a plate which does not move: the work is counted
// by the mean of the forces over each drift, also in that of the change.
TEST(PlaneVelocity, IsSetWhileItRunsAndItsWorkIsCounted) {
  Scene scene = grain_under_a_plate();
  scene.planes[1].point.z() = 0.02;
  auto simulation = simulation_of(scene, 0.1 * LoadedSimulation(scene, {}).time_step());
  simulation.step();

  simulation.set_plane_velocity(0, Vec3(0, 0, 1e-3));
  const double there = closure_until(simulation, 0.02);
  simulation.set_plane_velocity(0, Vec3(0, 0, -1e-3));
  const double back = closure_until(simulation, 0.03);

  EXPECT_NEAR(simulation.planes()[0].point.z(), 1e-5, 2.0 * simulation.time_step() * 1e-3);
  EXPECT_GT(simulation.energy().external_work, 0.0);
  EXPECT_LT(there, 1e-3);
  EXPECT_LT(back, 1e-3);
  EXPECT_THROW(simulation.set_plane_velocity(2, Vec3::Zero()), std::out_of_range);
  EXPECT_THROW(simulation.set_plane_velocity(0, Vec3(0, std::nan(""), 0)), std::invalid_argument);
}

TEST(PlaneVelocity, IsNotThatOfAPlaneThatALoadMoves) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(3.0)};
  scene.loads.servos[0].plane = 1;
  LoadedSimulation simulation(scene, {});
  EXPECT_THROW(simulation.set_plane_velocity(1, Vec3::Zero()), std::invalid_argument);
  EXPECT_NO_THROW(simulation.set_plane_velocity(0, Vec3::Zero()));
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
    EXPECT_NEAR(simulation.contacts().on_plane(1).force.z(), 10.0, 0.01) << phase;
  }
}

/// A limp sheet on a floor, without friction, and a plate a little above it, which presses with 21
/// N.
Scene sheet_under_a_plate(const geometry::Mesh& mesh, double gap, double speed) {
  constexpr double kHalf = 0.004;  // m
  Scene scene;
  scene.materials = {{9.856e6, 0.3, 0.0}};
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vec3& x : mesh.points) {
    scene.add_node(x, dynamics::Held::rotation);
    lowest = std::min(lowest, x.z());
    highest = std::max(highest, x.z());
  }
  for (const auto& nodes : mesh.facets) {
    scene.add_facet(nodes[0], nodes[1], nodes[2], kHalf, kMaterial);
    scene.add_sheet_facet(nodes, {1574.0, 0.3, 0.0, 2.0 * kHalf}, 950.0);
  }
  scene.planes.push_back({{0, 0, lowest - kHalf}, Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.planes.push_back({{0, 0, highest + kHalf + gap}, -Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.loads.servos = {servo_of(21.0)};
  scene.loads.servos[0].plane = 1;
  scene.loads.servos[0].largest_speed = speed;
  return scene;
}

/// Largest closure error, over the largest turnover, of any moment at which the plate arrives.
/// @param part  of the step that is chosen
double closure_of_sheet(const geometry::Mesh& mesh, double speed, double part = 1.0) {
  constexpr int kPhases = 8;
  constexpr double kGap = 5e-4;  // m
  const double step = LoadedSimulation(sheet_under_a_plate(mesh, kGap, speed), {}).time_step();
  double largest = 0.0;
  for (int phase = 0; phase < kPhases; ++phase) {
    auto simulation =
        simulation_of(sheet_under_a_plate(mesh, kGap + step * speed * phase / kPhases, speed),
                      part < 1.0 ? part * step : 0.0);
    largest = std::max(largest, closure_until(simulation, 0.03));
    // It has pressed, and nothing is made in contacts.
    EXPECT_GT(simulation.energy().external_work, 0.0) << phase;
    EXPECT_EQ(simulation.energy().friction, 0.0) << phase;
    EXPECT_EQ(simulation.energy().tracking, 0.0) << phase;
  }
  return largest;
}

// A plate at 1 m/s strikes a tube with a step of 0.3 ms, in which it goes 0.3 mm, a thirtieth of the
// thickness. It touches the tube before it presses, but where the tube springs back from it a force
// ends within a step: 0.6 % of all energy is made then, by a plate at 14.5 m/s, with steps as much
// shorter, less. A quarter of the step has a quarter of an error of the first order.
TEST(PlaneServo, KeepsTheEnergyBalanceOnMembranesAtWhateverMomentOfAStepItArrives) {
  const geometry::Mesh flat = geometry::plane_sheet({0.2, 0.2, 4, 4});
  const geometry::Mesh standing = geometry::tube({0.06, 0.24, 12, 3});
  geometry::Mesh lying = standing;
  for (Vec3& x : lying.points) x = Vec3(x.z(), x.y(), x.x());
  for (const geometry::Mesh& mesh : {flat, standing, lying}) {
    EXPECT_LT(closure_of_sheet(mesh, 1.0), 0.0065);
    EXPECT_LT(closure_of_sheet(mesh, 1.0, 0.25), 0.003);
    EXPECT_LT(closure_of_sheet(mesh, 14.5), 0.001);
    EXPECT_LT(closure_of_sheet(mesh, 14.5, 0.25), 0.00025);
  }
}

/// One grain, or a small one on another and a larger one beside them, on a floor under a plate that
/// presses with 1.1 N, with Hertz' contacts and dashpots.
Scene damped_grains(bool many, double gap) {
  constexpr double kRadius = 0.01;  // m
  Scene scene;
  scene.materials = {{5e6, 0.3, 0.5}};
  scene.add_sphere(Vec3(0.0, 0.0, kRadius), kRadius, 900.0, kMaterial);
  if (many) {
    scene.add_sphere(Vec3(0.0015, 0.001, 3.0 * kRadius), kRadius, 900.0, kMaterial);
    scene.add_sphere(Vec3(0.03, 0.001, 1.2 * kRadius), 1.2 * kRadius, 900.0, kMaterial);
  }
  const double top = (many ? 4.0 : 2.0) * kRadius;
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.planes.push_back({Vec3(0.0, 0.0, top + gap), -Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.loads.servos = {servo_of(1.1)};
  scene.loads.servos[0].plane = 1;
  scene.loads.servos[0].largest_speed = 1.0;
  return scene;
}

/// @param part  of the step that is chosen
void expect_balance_on_damped_grains(double restitution, double gain, double part,
                                     double largest_closure) {
  const auto model =
      contact::any_law({}, with<contact::HertzMindlin>(
                               {}, {0.8767, 0.01118, 0.01151, 0.2486},
                               {contact::damping_ratio(contact::SpringKind::hertz, restitution)}));
  constexpr int kPhases = 8;
  constexpr double kGap = 5e-4;  // m
  for (const bool many : {false, true}) {
    for (int phase = 0; phase < kPhases; ++phase) {
      Scene scene = damped_grains(many, kGap);
      scene.loads.servos[0].gain = gain;
      const double step = LoadedSimulation(scene, {}, model).time_step();
      scene.planes[1].point.z() += step * phase / kPhases;
      dynamics::SimulationOptions options;
      if (part < 1.0) options.time_step = part * step;
      LoadedSimulation simulation(scene, options, model);

      const double closure = closure_until(simulation, 0.06);
      EXPECT_LT(closure, largest_closure) << many << ' ' << phase;
      EXPECT_GT(simulation.energy().friction, 0.0) << many << ' ' << phase;
      EXPECT_NEAR(simulation.contacts().on_plane(1).force.z(), 1.1, 0.02) << many << ' ' << phase;
    }
  }
}

TEST(PlaneServo, KeepsTheEnergyBalanceOnDampedGrainsAtWhateverMomentOfAStepItArrives) {
  expect_balance_on_damped_grains(0.5, 0.1, 1.0, 0.015);
  expect_balance_on_damped_grains(0.5, 0.1, 0.25, 0.005);
}

// A plate that followed the force of the dashpots at its last speed would swing from step to step and
// hammer such a grain with up to 5 N.
TEST(PlaneServo, KeepsTheEnergyBalanceOnStronglyDampedGrains) {
  expect_balance_on_damped_grains(0.1, 0.1, 1.0, 0.005);
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

TEST(PlaneServo, IsRefusedBetweenPlanesThatBoundNoAreaOfAFlatPlate) {
  Scene scene = grain_under_a_plate();
  for (const Vec3& normal : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    for (const double side : {1.0, -1.0})
      scene.planes.push_back({-side * normal, side * normal, Vec3::Zero(), kMaterial});
  scene.loads.servos = {servo_of(1.0)};
  const auto problems_between = [&](std::vector<std::array<std::size_t, 2>> between) {
    scene.loads.servos[0].between = std::move(between);
    return problems_of(scene);
  };

  EXPECT_EQ(problems_between({{2, 3}, {4, 5}}), "");
  const auto is_refused =
      HasSubstr("servo 0: the planes that it lies between bound no area across its direction");
  EXPECT_THAT(problems_between({{2, 3}}), is_refused);
  EXPECT_THAT(problems_between({{2, 3}, {3, 2}}), is_refused);
  EXPECT_THAT(problems_between({{2, 3}, {0, 1}}), is_refused);
}

TEST(PlaneServo, IsRefusedWithAFactorThatWouldHaveItPull) {
  Scene scene = grain_under_a_plate();
  scene.loads.servos = {servo_of(1.0)};
  scene.loads.servos[0].factor = TimeTable({{0.0, 1.0}, {1.0, -0.5}, {2.0, 1.0}});

  EXPECT_THAT(problems_of(scene),
              HasSubstr("servo 0: its factor falls to -0.5, and a servo does not pull"));
}

/// Two planes bound the side of a cylinder across its axis, and no sphere.
TEST(PlaneServo, IsRefusedWithPlanesBetweenWhichItsContainerHasNoArea) {
  Scene scene = grain_under_a_plate();
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ()}, {Vec3::UnitZ(), -Vec3::UnitZ()}};
  for (const auto form : {contact::Plane::Form::cylinder, contact::Plane::Form::sphere})
    scene.planes.push_back({.point = Vec3::Zero(),
                            .normal = Vec3::Zero(),
                            .form = form,
                            .radius = 9.0,
                            .axis = Vec3::UnitZ()});
  const auto with_servo = [&](std::size_t plane, std::vector<std::array<std::size_t, 2>> between) {
    PlaneServo servo = servo_of(1.0);
    servo.plane = plane;
    servo.between = std::move(between);
    scene.loads.servos = {servo};
    return problems_of(scene);
  };
  EXPECT_EQ(with_servo(2, {{0, 1}}), "");

  EXPECT_THAT(with_servo(3, {{0, 1}}), HasSubstr("servo 0: plane 3 is a ball; give its area"));
  EXPECT_THAT(with_servo(2, {{0, 1}, {1, 0}}),
              HasSubstr("servo 0: plane 2 is a cylinder; give the two planes at its ends"));
  scene.planes[2].axis = Vec3::UnitX();
  EXPECT_THAT(with_servo(2, {{0, 1}}),
              HasSubstr("servo 0: plane 2 is a cylinder; give the two planes at its ends"));
}

}  // namespace
}  // namespace plekton::test::plane_servo_test

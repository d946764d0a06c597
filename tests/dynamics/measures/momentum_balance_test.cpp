// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/momentum_balance.hpp"

#include "dynamics/simulation.hpp"
#include "tests/support/reported_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace plekton::dynamics::momentum_balance_test {
namespace {

using test::NamedLaw;
using test::ReportedScene;

/// Forces on two nodes, 2 m from each other, that are said to be those between bodies.
class TwoNodes : public testing::Test {
 protected:
  TwoNodes() : simulation_(Scene(), options()), balance_(position_), forces_(2) {}

  static SimulationOptions options() {
    SimulationOptions options;
    options.time_step = 1.0;
    return options;
  }

  MomentumDrift drift(double carried = 0.0, int looks = 1) {
    geometry::ThreadPool pool;
    for (int k = 0; k < looks; ++k)
      balance_.look(
          {position_, forces_, simulation_.contacts(), {}, simulation_.ties(), carried, 0.5}, pool);
    return balance_.drift();
  }

  std::vector<Vec3> position_ = {Vec3(3, 0, 0), Vec3(5, 0, 0)};
  Simulation simulation_;  // for contacts, of which there are none
  MomentumBalance balance_;
  contact::NodeForces forces_;
};

TEST_F(TwoNodes, KeepMomentumIfTheyPushEachOther) {
  forces_.force = {Vec3(-7, 0, 0), Vec3(7, 0, 0)};

  EXPECT_EQ(drift().linear, 0.0);
  EXPECT_EQ(drift().angular, 0.0);
}

TEST_F(TwoNodes, DriftByAForceWithoutItsOpposite) {
  forces_.force = {Vec3(-7, 0, 0), Vec3(7.5, 0, 0)};

  EXPECT_DOUBLE_EQ(drift().linear, 0.5 / 14.5);
  EXPECT_DOUBLE_EQ(drift(0.0, 9).linear, 0.5 / 14.5);
  EXPECT_EQ(drift().angular, 0.0);
}

/// A pair of forces 2 m apart, about the middle; with torques that balance it, and without.
TEST_F(TwoNodes, DriftInTurnsByAPairOfForces) {
  forces_.force = {Vec3(0, -7, 0), Vec3(0, 7, 0)};
  forces_.torque = {Vec3(0, 0, -7), Vec3(0, 0, -7)};
  EXPECT_EQ(drift().angular, 0.0);
  forces_.torque = {Vec3::Zero(), Vec3::Zero()};
  balance_ = MomentumBalance(position_);

  EXPECT_EQ(drift().linear, 0.0);
  EXPECT_DOUBLE_EQ(drift().angular, 1.0);  // 14 N m of 2 * 7 N * 1 m
}

/// Rounding of what cancels at each node is left of forces that are much larger.
TEST_F(TwoNodes, AreMeasuredByWhatBodiesCarry) {
  forces_.force = {Vec3(1e-13, 0, 0), Vec3::Zero()};

  EXPECT_NEAR(drift(1e3).linear, 1e-16, 1e-28);
}

/// A drift that turns back has been there.
TEST_F(TwoNodes, RememberTheLargestDrift) {
  forces_.force = {Vec3(1, 0, 0), Vec3::Zero()};
  drift();
  forces_.force = {Vec3(-1, 0, 0), Vec3::Zero()};

  EXPECT_DOUBLE_EQ(drift().linear, 0.5);  // of the impulse of both
}

class MomentumOfScenes : public testing::TestWithParam<NamedLaw> {
 protected:
  static MomentumDrift drift_after(int steps, int threads) {
    const ReportedScene scene;
    Simulation simulation = scene.simulation(GetParam(), threads);
    for (int k = 0; k < steps; ++k) simulation.step();
    return simulation.momentum_drift();
  }
};

/// Spheres, a sheet, cylinders and planes that touch: rounding of some hundred forces.
TEST_P(MomentumOfScenes, IsKeptWithTheSameBitsForAnyNumberOfThreads) {
  const MomentumDrift one = drift_after(200, 1);

  EXPECT_LE(one.linear, 1e-14);
  EXPECT_LE(one.angular, 1e-14);
  EXPECT_GT(one.angular, 0.0);
  for (const int threads : {2, 3}) {
    const MomentumDrift more = drift_after(200, threads);
    EXPECT_EQ(more.linear, one.linear);
    EXPECT_EQ(more.angular, one.angular);
  }
}

/// A weight that swings on a post: what the post bears comes from outside.
TEST(MomentumOfATie, IsKeptWhereItHoldsOnToAFixedPoint) {
  Scene scene;
  scene.materials = {{1e6, 0.0, 0.0}};
  scene.add_sphere(Vec3(1, 0, 0), 0.1, 1000.0, contact::MaterialId{0});
  scene.ties.push_back({.node = geometry::NodeId{0},
                        .to = FixedPoint{Vec3::Zero()},
                        .stiffness = 1e4,
                        .rest_length = 1.0});
  Simulation simulation(scene, {.motion = {.gravity = Vec3(0, 0, -9.81)}});
  for (int k = 0; k < 500; ++k) simulation.step();

  EXPECT_GT(simulation.ties().pull(0), 0.0);
  EXPECT_LE(simulation.momentum_drift().linear, 1e-14);
  EXPECT_LE(simulation.momentum_drift().angular, 1e-14);
}

/// At 1e5 times the width of the scene from the origin places are rounded by 1e-11 of it, and so
/// are the levers of forces.
TEST_P(MomentumOfScenes, IsKeptFarFromTheOrigin) {
  const Vec3 far(3e4, -2e4, 1e4);
  ReportedScene moved;
  for (Vec3& x : moved.scene.state.position) x += far;
  for (contact::Plane& plane : moved.scene.planes) plane.point += far;
  Simulation simulation = moved.simulation(GetParam());
  for (int k = 0; k < 100; ++k) simulation.step();

  EXPECT_LE(simulation.momentum_drift().linear, 1e-14);
  EXPECT_LE(simulation.momentum_drift().angular, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(, MomentumOfScenes, testing::ValuesIn(test::kLaws),
                         [](const auto& law) { return std::string(law.param.name); });

}  // namespace
}  // namespace plekton::dynamics::momentum_balance_test

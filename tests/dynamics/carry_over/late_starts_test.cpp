// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/late_starts.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/rigid/rigid_bodies.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "geometry/base/state_archive.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace plekton::dynamics::late_starts_test {
namespace {

using geometry::StateArchive;
using geometry::StateMismatch;
using geometry::StateTree;
using test::Random;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr LateStarts::Lengths kLengths{0.3, 0.2};  // s
const Vec3 kGravity(1.0, -2.0, 3.0);               // m/s²

/// A node that moves and turns, with forces on it.
struct LoadedNode {
  explicit LoadedNode(Held held) {
    Random random(81);
    scene.add_node(Vec3::Zero(), held);
    scene.properties.mass[0] = 2.0;
    scene.properties.inertia[0] = 0.5;
    scene.state.velocity[0] = random.in_cube(1.0);
    scene.state.angular_velocity[0] = random.in_cube(1.0);
    forces.force[0] = random.in_cube(10.0);
    forces.torque[0] = random.in_cube(10.0);
  }
  double put_back(LateStarts& starts) {
    RigidBodies bodies({}, scene.state);
    return starts.put_back(kLengths,
                           {scene.state, forces, scene.properties, RigidNodes(), bodies, kGravity});
  }

  Scene scene;
  NodeForces forces{1};
};

/// The kick over half of both drifts that follows leaves what half of the next one alone gives: as
/// at any start.
TEST(LateStarts, AreKickedByHalfOfTheNextDriftAlone) {
  LoadedNode node(Held::along_y | Held::about_z);
  const NodeState before = node.scene.state;
  LateStarts starts;
  // It is held along y, and moved along z before.
  starts.add(NodeId{0}, Held::along_x | Held::along_y | Held::about_x | Held::about_z);

  const double energy = node.put_back(starts);

  const double kick = 0.5 * (kLengths.last_drift + kLengths.drift);
  const double first_kick = 0.5 * kLengths.drift;
  const Vec3 acceleration = kGravity + node.forces.force[0] / 2.0;
  const Vec3 turning = node.forces.torque[0] / 0.5;
  const Vec3 velocity = node.scene.state.velocity[0] + kick * acceleration;
  const Vec3 spin = node.scene.state.angular_velocity[0] + kick * turning;
  constexpr double kTolerance = 16.0 * kEpsilon * 10.0;  // m/s and rad/s, of kicks below 10
  EXPECT_NEAR(velocity.x(), before.velocity[0].x() + first_kick * acceleration.x(), kTolerance);
  EXPECT_NEAR(spin.x(), before.angular_velocity[0].x() + first_kick * turning.x(), kTolerance);
  // What is held, or went on before, is as it was.
  for (const int axis : {1, 2}) {
    EXPECT_EQ(node.scene.state.velocity[0][axis], before.velocity[0][axis]);
    EXPECT_EQ(node.scene.state.angular_velocity[0][axis], before.angular_velocity[0][axis]);
  }
  // 1/8 m (a dt)², and as much of the turning.
  const double expected =
      0.125 * kLengths.drift * kLengths.drift *
      (2.0 * acceleration.x() * acceleration.x() + 0.5 * turning.x() * turning.x());
  EXPECT_NEAR(energy, expected, 16.0 * kEpsilon * expected);
}

TEST(LateStarts, AreForgottenOnceTheyArePutBack) {
  LoadedNode node(Held::nothing);
  LateStarts starts;
  starts.add(NodeId{0}, Held::nothing);
  starts.add(NodeId{0}, Held::by_body);  // not a motion
  EXPECT_TRUE(starts.empty());
  starts.add(NodeId{0}, Held::translation);
  EXPECT_FALSE(starts.empty());
  EXPECT_GT(node.put_back(starts), 0.0);
  EXPECT_TRUE(starts.empty());

  const Vec3 velocity = node.scene.state.velocity[0];
  EXPECT_EQ(node.put_back(starts), 0.0);
  EXPECT_EQ(node.scene.state.velocity[0], velocity);
}

TEST(LateStarts, OfARigidBodyTakeItsAngularMomentumBackAndLeaveWhatFollowsIt) {
  Scene scene;
  scene.add_node(Vec3::UnitX());
  scene.add_rigid_body(std::vector{NodeId{0}},
                       {3.0, Vec3::Zero(), Mat3(Vec3(2, 5, 4).asDiagonal())});
  const auto body = static_cast<std::size_t>(1);  // its reference node
  scene.state.orientation[body] =
      Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())) * scene.state.orientation[body];
  scene.state.angular_velocity[body] = Vec3(1, 2, 3);
  NodeForces forces(2);
  forces.force = {Vec3(1, 1, 1), Vec3(3, 6, 9)};
  forces.torque = {Vec3(1, 1, 1), Vec3(1, -2, 4)};
  RigidBodies bodies(scene.rigid_bodies, scene.state);
  bodies.start(scene.state, scene.properties);
  const RigidNodes rigid(scene.rigid_bodies, scene.state, scene.properties);
  const NodeState before = scene.state;
  const Vec3 momentum = bodies.angular_momentum(0);
  LateStarts starts;
  starts.add(NodeId{0}, Held::everything);
  starts.add(NodeId{1}, Held::everything);

  const double energy = starts.put_back(
      kLengths, {scene.state, forces, scene.properties, rigid, bodies, Vec3::Zero()});

  const Vec3 torque = forces.torque[1];
  const Vec3 back = momentum - 0.5 * kLengths.last_drift * torque;
  EXPECT_LT((bodies.angular_momentum(0) - back).norm(), 16.0 * kEpsilon * momentum.norm());
  EXPECT_LT((scene.state.velocity[1] -
             (before.velocity[1] - 0.5 * kLengths.last_drift / 3.0 * forces.force[1]))
                .norm(),
            16.0 * kEpsilon);
  EXPECT_EQ(scene.state.angular_velocity[1], before.angular_velocity[1]);
  EXPECT_EQ(scene.state.velocity[0], before.velocity[0]);
  // 1/8 dt² (F² / m + T . I^-1 T), I with the moments along the axes of the body.
  const Vec3 of_body = scene.state.orientation[body].conjugate() * torque;
  const double turning = of_body.cwiseQuotient(scene.rigid_bodies[0].moments).dot(of_body);
  const double expected =
      0.125 * kLengths.drift * kLengths.drift * (forces.force[1].squaredNorm() / 3.0 + turning);
  EXPECT_NEAR(energy, expected, 64.0 * kEpsilon * expected);
}

TEST(LateStarts, GoOnFromAStateAndAreNoneInOneThatHasNothingOfThem) {
  LateStarts starts;
  StateTree none, some;
  starts.exchange(StateArchive::writer(none), 1);
  EXPECT_TRUE(none.arrays.empty());
  starts.add(NodeId{0}, Held::along_z);
  starts.exchange(StateArchive::writer(some), 1);

  LateStarts read;
  read.exchange(StateArchive::reader(some), 1);
  LoadedNode one(Held::nothing), other(Held::nothing);
  EXPECT_EQ(one.put_back(starts), other.put_back(read));
  EXPECT_EQ(one.scene.state.velocity[0], other.scene.state.velocity[0]);

  read.add(NodeId{0}, Held::along_x);
  read.exchange(StateArchive::reader(none), 1);
  EXPECT_TRUE(read.empty());

  EXPECT_THAT([&] { read.exchange(StateArchive::reader(some), 0); },
              ThrowsMessage<StateMismatch>(HasSubstr("\"late_starts/node\"")));
  std::get<std::vector<std::int64_t>>(some.arrays.at("late_starts/motions").numbers)[0] = 64;
  EXPECT_THAT([&] { read.exchange(StateArchive::reader(some), 1); },
              ThrowsMessage<StateMismatch>(HasSubstr("\"late_starts/motions\"")));
}

}  // namespace
}  // namespace plekton::dynamics::late_starts_test

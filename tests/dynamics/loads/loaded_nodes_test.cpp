// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/loaded_nodes.hpp"

#include <gtest/gtest.h>

namespace plekton::dynamics::loaded_nodes_test {
namespace {

/// Nodes 3 and 1 of five, under forces and torques that tell them apart.
class LoadedNodesTest : public testing::Test {
 protected:
  LoadedNodesTest() {
    nodes_.set(pool_, [](std::size_t i) {
      return i == 0 ? LoadedNodes::Force{Vec3(1, 2, 3), Vec3(0, 0, 4)}
                    : LoadedNodes::Force{Vec3(-5, 0, 0)};
    });
  }

  geometry::ThreadPool pool_{2};
  LoadedNodes nodes_{{NodeId{3}, NodeId{1}}};
};

TEST_F(LoadedNodesTest, AddToWhatActsOnTheirNodesAndOnNoOthers) {
  NodeForces forces(5);
  forces.force[3] = Vec3(10, 10, 10);
  forces.force[2] = Vec3(7, 0, 0);
  nodes_.add_to(forces, pool_);
  EXPECT_EQ(forces.force[3], Vec3(11, 12, 13));
  EXPECT_EQ(forces.torque[3], Vec3(0, 0, 4));
  EXPECT_EQ(forces.force[1], Vec3(-5, 0, 0));
  EXPECT_EQ(forces.torque[1], Vec3(0, 0, 0));
  EXPECT_EQ(forces.force[2], Vec3(7, 0, 0));
  EXPECT_EQ(forces.force[0], Vec3(0, 0, 0));
}

TEST_F(LoadedNodesTest, HaveThePowerOfForcesAndTorques) {
  NodeState state;
  state.velocity.assign(5, Vec3::Zero());
  state.angular_velocity.assign(5, Vec3::Zero());
  state.velocity[3] = Vec3(2, 0, 1);
  state.angular_velocity[3] = Vec3(9, 0, 0.5);
  state.velocity[1] = Vec3(3, 8, 8);
  state.velocity[0] = Vec3(100, 100, 100);  // not loaded
  EXPECT_EQ(nodes_.power(state, pool_), (2.0 + 3.0) + 4.0 * 0.5 - 5.0 * 3.0);
}

}  // namespace
}  // namespace plekton::dynamics::loaded_nodes_test

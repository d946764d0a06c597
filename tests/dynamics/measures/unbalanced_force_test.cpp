// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/unbalanced_force.hpp"

#include "dynamics/model/scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plekton::dynamics::unbalanced_force_test {
namespace {

using test::Random;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Nodes of 2 kg with forces on them.
struct LoadedNodes {
  void add(Held held, const Vec3& force) {
    scene.add_node(Vec3::Zero(), held);
    scene.properties.mass.back() = 2.0;
    forces.force.push_back(force);
    forces.torque.emplace_back(100.0, 0.0, 0.0);  // turns, and does not count
  }
  double ratio(double carried, const Vec3& gravity = Vec3::Zero()) const {
    return unbalanced_force_ratio({scene.state.position, forces, scene.properties, gravity},
                                  carried);
  }

  Scene scene;
  NodeForces forces{0};
};

/// Against the sum over components that are free.
TEST(UnbalancedForce, IsTheMeanResultantOnWhatIsFreeAlongSomeAxis) {
  Random random(91);
  const Vec3 gravity(0.1, 0.2, -9.81);
  constexpr double kCarried = 7.0;  // N
  LoadedNodes nodes;
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    const int held = random.integer(0, 63);
    const Vec3 force = random.in_cube(10.0);
    nodes.add(static_cast<Held>(held), force);
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double resultant = force[k] + 2.0 * gravity[k];
      if ((held >> k & 1) == 0) squared += resultant * resultant;
    }
    sum += std::sqrt(squared);
    count += (held & 7) != 7;
  }
  const double expected = sum / count / kCarried;

  EXPECT_NEAR(nodes.ratio(kCarried, gravity), expected, 200.0 * kEpsilon * expected);
}

TEST(UnbalancedForce, IsNothingInBalanceWhateverIsCarried) {
  LoadedNodes nodes;
  nodes.add(Held::nothing, Vec3(0.0, 0.0, 4.0));
  nodes.add(Held::along_x, Vec3(3.0, 0.0, 4.0));
  nodes.add(Held::translation, Vec3(1.0, 2.0, 3.0));
  const Vec3 gravity(0.0, 0.0, -2.0);

  for (const double carried : {0.0, 1e-300, 5.0}) EXPECT_EQ(nodes.ratio(carried, gravity), 0.0);
  EXPECT_EQ(nodes.ratio(0.0), kInfinity);
  EXPECT_EQ(LoadedNodes().ratio(0.0, gravity), 0.0);
}

/// A node that is held does not bring the mean down.
TEST(UnbalancedForce, DoesNotChangeWithTheNodesThatAreHeld) {
  LoadedNodes nodes;
  nodes.add(Held::rotation, Vec3(0.0, 6.0, 0.0));
  nodes.add(Held::along_y | Held::along_z, Vec3(2.0, 9.0, 9.0));
  EXPECT_EQ(nodes.ratio(2.0), 2.0);

  for (int i = 0; i < 10; ++i) nodes.add(Held::everything, Vec3(5.0, 5.0, 5.0));

  EXPECT_EQ(nodes.ratio(2.0), 2.0);
}

}  // namespace
}  // namespace plekton::dynamics::unbalanced_force_test

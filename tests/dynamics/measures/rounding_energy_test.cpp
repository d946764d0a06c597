// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/rounding_energy.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::dynamics::rounding_energy_test {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A free node of 2 kg at 3 m along x, at rest.
struct OneNode {
  NodeState state{.position = {Vec3(3, 0, 0)},
                  .velocity = {Vec3::Zero()},
                  .angular_velocity = {Vec3::Zero()},
                  .orientation = {Quat::Identity()}};
  NodeProperties properties{.mass = {2.0}, .inertia = {1.0}, .held = {Held::nothing}};
  NodeForces forces{1};
  Vec3 gravity = Vec3::Zero();
  NodalStiffness::Total springs;

  double after(std::int64_t steps) const {
    return rounding_energy({state, properties, forces, gravity, springs, 0.1, steps});
  }
};

TEST(RoundingEnergy, IsNothingWhereNothingResistsAndNothingIsHeavy) {
  EXPECT_EQ(OneNode().after(1000), 0.0);
}

TEST(RoundingEnergy, OfASpringIsThatOfARandomWalkOfRoundedPlaces) {
  OneNode node;
  node.springs.translation = 10.0;
  EXPECT_DOUBLE_EQ(node.after(99), 100 * 0.5 * 10.0 * (kEps * 3.0) * (kEps * 3.0));
}

TEST(RoundingEnergy, OfWeightGrowsWithTheSteps) {
  OneNode node;
  node.gravity = Vec3(9.81, 0, 0);
  EXPECT_DOUBLE_EQ(node.after(49), kEps * 50 * 2.0 * 9.81 * 3.0);
  node.properties.held = {Held::translation};
  EXPECT_EQ(node.after(49), 0.0) << "what is held has no weight in the ledger";
}

}  // namespace
}  // namespace plekton::dynamics::rounding_energy_test

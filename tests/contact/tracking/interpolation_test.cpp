// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tracking/interpolation.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::contact::interpolation_test {
namespace {

using geometry::CorePoint;
using geometry::Feature;
using test::Random;

/// Nodes in random motion.
struct State {
  explicit State(Random& random) {
    for (int i = 0; i < 5; ++i) {
      x.push_back(random.in_cube(10.0));
      v.push_back(random.in_cube(1.0));
      w.push_back(random.in_cube(1.0));
    }
  }
  Motion motion() const { return {x, v, w}; }

  std::vector<Vec3> x, v, w;
};

CorePoint random_core(Random& random, int kind) {
  const NodeId a{0}, b{3}, c{4};
  const double s = random.unit();
  const double t = random.unit() * (1.0 - s);
  if (kind == 0) return geometry::core_point(b);
  if (kind == 1) return {{a, b, a}, Vec3(1.0 - s, s, 0.0), Feature(geometry::EdgeId{0})};
  return {{a, b, c}, Vec3(1.0 - s - t, s, t), Feature(geometry::FaceId{0})};
}

TEST(Interpolation, GivesTheNodesThePowerTheForceHas) {
  Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    const State state(random);
    const CorePoint core = random_core(random, trial % 3);
    const Vec3 lever = random.in_cube(1.0);
    const Vec3 force = random.in_cube(1.0);
    NodeForces forces(state.x.size());

    add_force_at(core, lever, force, forces);

    double power = 0.0;
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      power += forces.force[i].dot(state.v[i]) + forces.torque[i].dot(state.w[i]);
    }
    EXPECT_NEAR(power, force.dot(velocity_at(core, lever, state.motion())), 1e-14);
  }
}

TEST(Interpolation, GivesTheNodesTheForceAndItsMoment) {
  Random random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    const State state(random);
    const CorePoint core = random_core(random, trial % 3);
    const Vec3 lever = random.in_cube(1.0);
    const Vec3 force = random.in_cube(1.0);
    NodeForces forces(state.x.size());

    add_force_at(core, lever, force, forces);

    Vec3 sum = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      sum += forces.force[i];
      moment += state.x[i].cross(forces.force[i]) + forces.torque[i];
    }
    EXPECT_NEAR((sum - force).norm(), 0.0, 1e-15);
    EXPECT_NEAR((moment - (position(core, state.x) + lever).cross(force)).norm(), 0.0, 1e-13);
  }
}

TEST(Interpolation, FollowsARigidMotion) {
  Random random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    State state(random);
    const Vec3 velocity = random.in_cube(1.0);
    const Vec3 spin = random.in_cube(1.0);
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      state.v[i] = velocity + spin.cross(state.x[i]);
      state.w[i] = spin;
    }
    const CorePoint core = random_core(random, trial % 3);
    const Vec3 lever = random.in_cube(1.0);

    const Vec3 expected = velocity + spin.cross(position(core, state.x) + lever);
    EXPECT_NEAR((velocity_at(core, lever, state.motion()) - expected).norm(), 0.0, 1e-13);
    EXPECT_NEAR((angular_velocity_at(core, state.motion()) - spin).norm(), 0.0, 1e-15);
  }
}

}  // namespace
}  // namespace plekton::contact::interpolation_test

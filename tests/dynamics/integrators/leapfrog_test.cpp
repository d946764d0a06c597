// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/leapfrog.hpp"

#include "dynamics/integrators/leapfrog_lanes.hpp"
#include "geometry/base/vector_width.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace plekton::dynamics::leapfrog_test {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Nodes of mass 2 kg and inertia 0.5 kg m² at the origin, at rest.
struct Nodes {
  explicit Nodes(std::size_t count, Held held = Held::nothing) : forces(count) {
    state.position.assign(count, Vec3::Zero());
    state.velocity.assign(count, Vec3::Zero());
    state.angular_velocity.assign(count, Vec3::Zero());
    state.orientation.assign(count, Quat::Identity());
    properties.mass.assign(count, 2.0);
    properties.inertia.assign(count, 0.5);
    properties.held.assign(count, held);
  }

  StepWork step(double kick, double drift, const MotionOptions& options = {}) {
    return leapfrog.step(state, forces, properties, options, {kick, drift}, pool).total();
  }
  StepSums step_some(std::span<const NodeId> nodes, double kick, double drift,
                     const MotionOptions& options) {
    return leapfrog.step_some(nodes, state, forces, properties, options, {kick, drift}, pool);
  }

  NodeState state;
  NodeProperties properties;
  NodeForces forces;
  Leapfrog leapfrog;
  geometry::ThreadPool pool;
};

constexpr double kStiffness = 50.0;  // N/m; with 2 kg the angular frequency is 5 rad/s
constexpr double kFrequency = 5.0;   // rad/s
const Vec3 kStart(1.0, -0.5, 0.2);
const Vec3 kStartVelocity(0.5, 2.0, -1.0);

struct Errors {
  double position;
  double velocity;
};

/// Of an oscillator against x0 cos(wt) + v0/w sin(wt), after 2 s.
Errors oscillator_errors(int steps) {
  Nodes node(1);
  node.state.position[0] = kStart;
  node.state.velocity[0] = kStartVelocity;
  const double dt = 2.0 / steps;
  for (int i = 0; i < steps; ++i) {
    node.forces.force[0] = -kStiffness * node.state.position[0];
    node.step(i == 0 ? 0.5 * dt : dt, dt);
  }

  const double phase = kFrequency * 2.0;
  const double middle = phase - 0.5 * kFrequency * dt;  // of the last drift, where the velocity is
  const Vec3 position = std::cos(phase) * kStart + std::sin(phase) / kFrequency * kStartVelocity;
  const Vec3 velocity = std::cos(middle) * kStartVelocity - kFrequency * std::sin(middle) * kStart;
  return {(node.state.position[0] - position).norm(), (node.state.velocity[0] - velocity).norm()};
}

TEST(Leapfrog, IsOfSecondOrderForAnOscillator) {
  const Errors coarse = oscillator_errors(400);
  const Errors fine = oscillator_errors(800);

  // Halving the step divides the error by 4, but for terms of the fourth order: (w dt)² = 6e-4 of
  // the errors. The velocity is that of half a step before the end, at another phase for either
  // step: w dt / 2 = 0.0125 of the errors more.
  EXPECT_NEAR(coarse.position / fine.position, 4.0, 0.01);
  EXPECT_NEAR(coarse.velocity / fine.velocity, 4.0, 4.0 * 0.0125);
}

TEST(Leapfrog, KeepsTheEnergyOfAnOscillatorToRoundOff) {
  constexpr int kSteps = 2000;
  constexpr double kStep = 0.2;  // s; half of the critical 2/w
  Nodes node(1);
  node.state.position[0] = kStart;
  node.state.velocity[0] = kStartVelocity;
  double first = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 x = node.state.position[0];
    node.forces.force[0] = -kStiffness * x;
    const StepWork work = node.step(i == 0 ? 0.5 * kStep : kStep, kStep);
    const double energy = work.kinetic + 0.5 * kStiffness * x.squaredNorm();
    if (i == 1) first = energy;
    // A step rounds a few numbers, each of the size of the whole energy at most 4 times.
    if (i > 1) {
      ASSERT_NEAR(energy, first, 16.0 * i * kEps * first) << "step " << i;
    }
  }
}

TEST(Leapfrog, DampsAForceThatSpeedsUpAndHelpsOneThatSlowsDown) {
  Nodes node(1);
  node.state.velocity[0] = Vec3(3.0, -3.0, 3.0);
  node.forces.force[0] = Vec3(8.0, 8.0, -8.0);
  node.state.angular_velocity[0] = Vec3(1.0, -1.0, 0.0);
  node.forces.torque[0] = Vec3(0.5, 0.5, 0.0);
  constexpr double kDamping = 0.25;

  const StepWork work = node.step(0.5, 0.5, {.damping = kDamping});

  // a (1 - lambda sgn(a v)): 4 m/s² becomes 3 or 5, 1 rad/s² becomes 0.75 or 1.25.
  EXPECT_EQ(node.state.velocity[0], Vec3(4.5, -0.5, 0.5));
  EXPECT_EQ(node.state.angular_velocity[0], Vec3(1.375, -0.375, 0.0));
  // Force lambda |F| times the way: 2 N x (3.75 + 1.75 + 1.75) m/s x 0.5 s, 0.125 N m x 1.1875
  // rad/s and 0.125 N m x 0.6875 rad/s.
  EXPECT_DOUBLE_EQ(work.damped, 2.0 * 7.25 * 0.5 + 0.125 * (1.1875 + 0.6875) * 0.5);
}

TEST(Leapfrog, DampsNothingThatNeitherMovesNorIsPushed) {
  Nodes node(1);

  const StepWork work = node.step(0.5, 0.5, {.damping = 0.9});

  EXPECT_EQ(node.state.velocity[0], Vec3(0, 0, 0));
  EXPECT_EQ(work.damped, 0.0);
}

TEST(Leapfrog, DampsAFreeFallOnlyIfAskedTo) {
  const Vec3 gravity(0.0, 0.0, -10.0);
  for (const bool damps_gravity : {true, false}) {
    Nodes node(1);
    node.forces.force[0] = Vec3(4.0, 0.0, 0.0);

    const StepWork work = node.step(0.5, 0.5, {gravity, 0.5, damps_gravity});

    EXPECT_EQ(node.state.velocity[0], Vec3(0.5, 0.0, damps_gravity ? -2.5 : -5.0));
    // 2 N over 1/2 (0 + 0.5) m/s x 0.5 s, and 10 N over 1/2 (0 + 2.5) m/s x 0.5 s.
    EXPECT_DOUBLE_EQ(work.damped, damps_gravity ? 0.25 + 6.25 : 0.25);
  }
}

TEST(Leapfrog, MovesWhatIsHeldAsPrescribedAndCountsItsWork) {
  const Vec3 velocity(1.0, 2.0, -4.0);
  const Vec3 spin(0.0, 0.0, 0.5);
  Nodes node(1, Held::everything);
  node.state.velocity[0] = velocity;
  node.state.angular_velocity[0] = spin;
  node.forces.force[0] = Vec3(8.0, -1.0, 2.0);
  node.forces.torque[0] = Vec3(3.0, 3.0, 3.0);
  const MotionOptions options{Vec3(0.0, 0.0, -9.81), 0.3, true};

  const StepWork work = node.step(0.25, 0.5, options);

  EXPECT_EQ(node.state.velocity[0], velocity);
  EXPECT_EQ(node.state.angular_velocity[0], spin);
  EXPECT_EQ(node.state.position[0], 0.5 * velocity);
  EXPECT_EQ(work.kinetic, 0.0);
  EXPECT_EQ(work.damped, 0.0);
  // It holds against the forces: -F.v - T.w = 2 W - 1.5 W, for the 0.25 s of the kick.
  EXPECT_DOUBLE_EQ(work.external, 0.25 * (2.0 - 1.5));
}

TEST(Leapfrog, HoldsTranslationAndRotationEachByItself) {
  Nodes fixed_place(1, Held::translation);
  Nodes fixed_turn(1, Held::rotation);
  for (Nodes* node : {&fixed_place, &fixed_turn}) {
    node->forces.force[0] = Vec3(2.0, 0.0, 0.0);
    node->forces.torque[0] = Vec3(0.0, 0.5, 0.0);
    node->step(0.5, 0.5);
  }

  EXPECT_EQ(fixed_place.state.position[0], Vec3(0, 0, 0));
  EXPECT_EQ(fixed_place.state.angular_velocity[0], Vec3(0, 0.5, 0));
  EXPECT_EQ(fixed_turn.state.velocity[0], Vec3(0.5, 0, 0));
  EXPECT_EQ(fixed_turn.state.orientation[0].coeffs(), Quat::Identity().coeffs());
}

TEST(Leapfrog, TurnsByAConstantSpinExactly) {
  const Vec3 axis = Vec3(1.0, -2.0, 0.5).normalized();
  const Quat start(Eigen::AngleAxisd(0.7, Vec3(0.0, 0.6, 0.8)));
  constexpr int kSteps = 1000;
  for (const double turn : {1e-9, 1e-3, 0.3, 2.5}) {  // rad in a step: short series, and beyond
    Nodes node(1);
    node.state.orientation[0] = start;
    node.state.angular_velocity[0] = (turn / 0.5) * axis;

    for (int i = 0; i < kSteps; ++i) node.step(0.5, 0.5);

    const Quat expected = Quat(Eigen::AngleAxisd(kSteps * turn, axis)) * start;
    const Quat got = node.state.orientation[0];
    const double sign = got.dot(expected) < 0.0 ? -1.0 : 1.0;
    // A step rounds the spin, the half angle and the product: 8 eps of a unit quaternion.
    EXPECT_LT((sign * got.coeffs() - expected.coeffs()).norm(), 8.0 * kSteps * kEps * (1.0 + turn))
        << turn << " rad";
  }
}

/// Has nodes move and spin at random, some so fast that they are turned one by one, some held.
void make_all_kinds(Nodes& all) {
  test::Random random(4);
  for (std::size_t i = 0; i < all.state.size(); ++i) {
    all.state.velocity[i] = random.in_cube(1.0);
    all.state.angular_velocity[i] = random.in_cube(i % 7 == 0 && i < 300 ? 100.0 : 1.0);
    all.forces.force[i] = random.in_cube(10.0);
    all.forces.torque[i] = random.in_cube(10.0);
    if (i > 100 && i < 400) all.properties.held[i] = static_cast<Held>(i % 64);
  }
}

void expect_same_motion(const Nodes& a, const Nodes& b) {
  for (std::size_t i = 0; i < a.state.size(); ++i) {
    ASSERT_EQ(a.state.position[i], b.state.position[i]) << i;
    ASSERT_EQ(a.state.velocity[i], b.state.velocity[i]) << i;
    ASSERT_EQ(a.state.angular_velocity[i], b.state.angular_velocity[i]) << i;
    ASSERT_EQ(a.state.orientation[i].coeffs(), b.state.orientation[i].coeffs()) << i;
  }
}

TEST(Leapfrog, StepsSomeNodesAndThenTheOthersToTheBitAsAllAtOnce) {
  constexpr std::size_t kCount = 900;
  const MotionOptions options{Vec3(0, 0, -9.81), 0.3, true};
  Nodes all(kCount), in_parts(kCount);
  make_all_kinds(all);
  make_all_kinds(in_parts);
  test::Random random(8);
  std::array<std::vector<NodeId>, 3> parts;  // mixed at first, then in a row
  for (std::size_t i = 0; i < kCount; ++i)
    parts[i < 600 ? random.index(3) : 1].push_back(geometry::id_at<NodeId>(i));

  const StepWork expected = all.step(0.1, 0.1, options);
  StepSums sums;
  for (const std::size_t part : {2U, 0U, 1U})
    sums += in_parts.step_some(parts[part], 0.1, 0.1, options);

  expect_same_motion(in_parts, all);
  const StepWork work = sums.total();
  EXPECT_EQ(work.kinetic, expected.kinetic);
  EXPECT_EQ(work.damped, expected.damped);
  EXPECT_EQ(work.external, expected.external);
  EXPECT_EQ(work.fastest_squared, expected.fastest_squared);
  EXPECT_EQ(work.fastest_spin_squared, expected.fastest_spin_squared);
}

TEST(Leapfrog, LeavesAloneNodesThatItIsNotAskedToStep) {
  Nodes nodes(20), before(20);
  make_all_kinds(nodes);
  make_all_kinds(before);
  const std::vector<NodeId> some{NodeId{3}, NodeId{4}, NodeId{19}};
  nodes.step_some(some, 0.1, 0.1, {});
  for (std::size_t i = 0; i < 20; ++i) {
    const bool is_asked = i == 3 || i == 4 || i == 19;
    EXPECT_EQ(nodes.state.position[i] != before.state.position[i], is_asked) << i;
  }
}

TEST(Leapfrog, StepsManyNodesToTheBitAsEachAlone) {
  constexpr std::size_t kCount = 600;  // several chunks, blocks and a rest
  Nodes all(kCount);
  make_all_kinds(all);
  std::vector<NodeState> alone;
  for (std::size_t i = 0; i < kCount; ++i) {
    Nodes one(1, all.properties.held[i]);
    one.state.velocity[0] = all.state.velocity[i];
    one.state.angular_velocity[0] = all.state.angular_velocity[i];
    one.forces.force[0] = all.forces.force[i];
    one.forces.torque[0] = all.forces.torque[i];
    one.step(0.1, 0.1, {Vec3(0, 0, -9.81), 0.3, true});
    alone.push_back(one.state);
  }

  all.step(0.1, 0.1, {Vec3(0, 0, -9.81), 0.3, true});

  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(all.state.position[i], alone[i].position[0]) << i;
    ASSERT_EQ(all.state.velocity[i], alone[i].velocity[0]) << i;
    ASSERT_EQ(all.state.angular_velocity[i], alone[i].angular_velocity[0]) << i;
    ASSERT_EQ(all.state.orientation[i].coeffs(), alone[i].orientation[0].coeffs()) << i;
  }
}

template <class Width>
class LeapfrogLanes : public testing::Test {};
using Widths = testing::Types<geometry::Width<2>, geometry::Width<4>, geometry::Width<8>>;
TYPED_TEST_SUITE(LeapfrogLanes, Widths);

NodeArrays arrays(Nodes& nodes) {
  return {nodes.state.position.data(),         nodes.state.velocity.data(),
          nodes.state.angular_velocity.data(), nodes.state.orientation.data(),
          nodes.forces.force.data(),           nodes.forces.torque.data(),
          nodes.properties.mass.data(),        nodes.properties.inertia.data(),
          nodes.properties.held.data()};
}

TYPED_TEST(LeapfrogLanes, HaveTheBitsOfOneNodeAfterTheOther) {
  constexpr int W = TypeParam::value;
  const MotionOptions options{Vec3(0, 0, -9.81), 0.3, true};
  test::Random random(5);
  for (const double spin : {1.0, 100.0}) {  // rad/s: the short series, and beyond
    Nodes together(std::size_t{W});
    for (std::size_t i = 0; i < std::size_t{W}; ++i) {
      together.state.velocity[i] = random.in_cube(1.0);
      together.state.angular_velocity[i] = random.in_cube(spin);
      together.forces.force[i] = random.in_cube(10.0);
      together.forces.torque[i] = random.in_cube(10.0);
      if (spin > 1.0) together.properties.held[i] = static_cast<Held>(i % 64);
    }
    Nodes apart(std::size_t{W});
    apart.state = together.state;
    apart.forces = together.forces;
    apart.properties = together.properties;

    const auto work = step_lanes<W>(arrays(together), options, {0.1, 0.1});

    for (int i = 0; i < W; ++i) {
      const auto node = static_cast<std::size_t>(i);
      const auto work_of_one = step_lanes<1>(arrays(apart).from(node), options, {0.1, 0.1});
      EXPECT_EQ(work.kinetic.lanes[i], work_of_one.kinetic.lanes[0]);
      EXPECT_EQ(work.damped.lanes[i], work_of_one.damped.lanes[0]);
      EXPECT_EQ(work.external.lanes[i], work_of_one.external.lanes[0]);
      EXPECT_EQ(together.state.position[node], apart.state.position[node]);
      EXPECT_EQ(together.state.velocity[node], apart.state.velocity[node]);
      EXPECT_EQ(together.state.angular_velocity[node], apart.state.angular_velocity[node]);
      EXPECT_EQ(together.state.orientation[node].coeffs(), apart.state.orientation[node].coeffs());
    }
  }
}

TEST(Leapfrog, NamesTheSpeedOfTheFastestNode) {
  for (const std::size_t fastest : {0u, 7u, 8u, 300u, 530u}) {
    Nodes nodes(531);
    for (std::size_t i = 0; i < 531; ++i) nodes.state.velocity[i] = Vec3(1, -2, 0.001 * double(i));
    nodes.state.velocity[fastest] = Vec3(3, -4, 12);
    EXPECT_EQ(nodes.step(1.0, 1.0).fastest_squared, 169.0);
  }
}

TEST(Leapfrog, TakesMotionThatIsNoNumberForInfinitelyFast) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinite, 1e200}) {
    for (const std::size_t node : {0u, 5u, 8u, 17u}) {
      Nodes spins(18);
      spins.state.angular_velocity[node].y() = bad;
      EXPECT_EQ(spins.step(1.0, 1.0).fastest_squared, infinite);
      Nodes forces(18);
      forces.forces.force[node].x() = bad;
      EXPECT_EQ(forces.step(1.0, 1.0).fastest_squared, infinite);
    }
  }
}

}  // namespace
}  // namespace plekton::dynamics::leapfrog_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/lone_block.hpp"

#include "contact/laws/linear_frictional.hpp"
#include "contact/lone_contact.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

/// Balls side by side on the insides of facets, against one after the other: the same bits.
namespace plekton::test {
namespace {

using Law = LinearFrictional;
using Block = LoneBlock<Law>;

constexpr Law::Parameters kParameters{2.0e3, 6.0e2, 0.5};
constexpr double kStep = 1e-4;  // s

/// A ball over a facet, all in motion, and the memory of their contact.
struct Case {
  Complex complex;
  std::vector<Vec3> velocity;
  std::vector<Vec3> spin;
  double radius;
  double range;
  ContactMemory<Law> memory;

  Motion motion() const { return {complex.x, velocity, spin}; }
  const Vec3& centre() const { return complex.x[3]; }
};

/// Facets of any shape, slivers among them, and balls of any size over their insides.
Case random_case(Random& random) {
  Case c;
  const double thinness = random.coin() ? 1.0 : std::pow(10.0, -random.uniform(0.0, 6.0));
  const Mat3 turn = random.rotation();
  const Vec3 shift = random.in_cube(3.0);
  for (int k = 0; k < 3; ++k) {
    Vec3 corner = random.in_cube(2.0);
    corner[1] *= thinness;
    corner[2] = 0.0;
    c.complex.node(turn * corner + shift);
  }
  c.complex.facet(0, 1, 2);
  const auto& x = c.complex.x;
  c.radius = std::pow(10.0, random.uniform(-3.0, 1.0));
  c.range = 1.1 * c.radius;
  const Vec3 weights(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
  const Vec3 foot = (weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2]) / weights.sum();
  const Vec3 normal = (random.coin() ? 1.0 : -1.0) * turn.col(2);
  c.complex.node(foot - random.uniform(0.9, 1.01) * c.range * normal);
  for (int k = 0; k < 4; ++k) {
    c.velocity.push_back(random.in_cube(1.0));
    c.spin.push_back(random.in_cube(100.0));
  }
  c.memory.normal = (normal + 0.01 * random.in_cube(1.0)).normalized();
  c.memory.history.elastic_slip = 1e-4 * c.memory.normal.cross(random.in_cube(1.0));
  return c;
}

void put(const Case& c, std::size_t lane, Block& block) {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t node = k == 0 ? 3 : k - 1;
    block.position[k].set(lane, c.complex.x[node]);
    block.velocity[k].set(lane, c.velocity[node]);
    block.spin[k].set(lane, c.spin[node]);
  }
  block.radius.set(lane, c.radius);
  block.range.set(lane, c.range);
  block.parameters.set(lane, kParameters);
  block.history.set(lane, c.memory.history);
  block.normal.set(lane, c.memory.normal);
}

/// That the general way finds the inside of the facet alone, and makes the same of it.
void expect_general(const Case& c, const Block& block, std::size_t lane) {
  const Surface surface = c.complex.surface();
  PatchFinder finder(surface);
  const auto patches = finder.find(c.centre(), c.range, all_cells(surface), c.complex.x);
  ASSERT_EQ(patches.size(), 1u);
  ASSERT_TRUE(is_lone(finder.terms(patches[0])));
  ASSERT_EQ(patches[0].root, Feature(FaceId{0}));
  const PatchTerm& term = finder.terms(patches[0])[0];
  const PatchState state =
      lone_state<Law>(term, kParameters, NodeId{3}, c.radius, c.range, c.motion());
  Law::History history = carried_history<Law>(c.memory, state.normal, kStep * state.twist_rate);
  EXPECT_EQ(block.carried.at<Vec3>(lane), history.elastic_slip);
  const RelativeMotion relative =
      relative_motion(state.normal, state.gap, state.elastic_force, state.relative_velocity);
  const ContactForce answer = Law::force(kParameters, relative, history, kStep);
  const Vec3 other = answer.force - state.elastic_force * state.normal;
  const Vec3 lever_b = state.lever_a - term.distance * term.normal;

  EXPECT_EQ(block.weights.at<Vec3>(lane), term.core.weights);
  EXPECT_EQ(block.normal.at<Vec3>(lane), term.normal);
  EXPECT_EQ(block.history.at<Vec3>(lane), history.elastic_slip);
  EXPECT_EQ(block.gap.number(lane), state.gap);
  EXPECT_EQ(block.foot.at<Vec3>(lane), state.foot);
  EXPECT_EQ(block.force_b.at<Vec3>(lane), state.elastic_force * term.normal + other);
  EXPECT_EQ(block.torque_a.at<Vec3>(lane), -state.lever_a.cross(other));
  EXPECT_EQ(block.torque_b.at<Vec3>(lane), lever_b.cross(other));
  EXPECT_EQ(block.dissipated.number(lane), answer.dissipated);
}

template <class Width>
class LoneBlockOf : public testing::Test {};
using Widths = testing::Types<geometry::Width<2>, geometry::Width<4>, geometry::Width<8>>;
TYPED_TEST_SUITE(LoneBlockOf, Widths);

TYPED_TEST(LoneBlockOf, GivesTheBitsOfTheGeneralWayOrSaysThatItDoesNotKnow) {
  Random random(1);
  int right = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t count = 1 + random.index(kLoneLanes);
    std::vector<Case> cases;
    Block block;
    for (std::size_t k = 0; k < count; ++k) put(cases.emplace_back(random_case(random)), k, block);

    block.template advance<TypeParam::value>(count, kStep);

    for (std::size_t k = 0; k < count; ++k) {
      const bool is_right = block.is_right.number(k) > 0.0;
      right += is_right;
      if (is_right) expect_general(cases[k], block, k);
      ASSERT_FALSE(testing::Test::HasFailure()) << "trial " << trial << ", lane " << k;
    }
  }
  EXPECT_GT(right, 1000);
}

/// A ball over the middle of a facet.
Case ordinary_case() {
  Random random(2);
  Case c = random_case(random);
  c.complex.x = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0.9, 0.9, 0.4)};
  c.radius = 0.4;
  c.range = 0.44;
  c.memory.normal = -Vec3::UnitZ();
  return c;
}

template <class Width>
double right_of(const Case& c) {
  Block block;
  for (std::size_t k = 0; k < 8; ++k) put(c, k, block);
  block.template advance<Width::value>(8, kStep);
  return block.is_right.number(3);
}

TYPED_TEST(LoneBlockOf, LeavesToTheGeneralWayWhatIsNotCertain) {
  const auto with = [](auto change) {
    Case c = ordinary_case();
    change(c);
    return right_of<TypeParam>(c);
  };
  EXPECT_EQ(with([](Case&) {}), 1.0);
  EXPECT_EQ(with([](Case& c) { c.complex.x[3] = Vec3(0.9, 0.1, 0.4); }), 0.0);   // a side in range
  EXPECT_EQ(with([](Case& c) { c.complex.x[3] = Vec3(0.9, -0.1, 0.4); }), 0.0);  // foot outside
  EXPECT_EQ(with([](Case& c) { c.complex.x[3] = Vec3(0.9, 0.9, 0.44); }), 0.0);  // out of range
  EXPECT_EQ(with([](Case& c) { c.complex.x[3] = Vec3(0.9, 0.9, 0.0); }), 0.0);   // no direction
  EXPECT_EQ(with([](Case& c) { c.complex.x[2] = Vec3(1.5, 0, 0); }), 0.0);       // no area
  EXPECT_EQ(with([](Case& c) { c.memory.normal = Vec3::UnitZ(); }), 0.0);        // gone through
  EXPECT_EQ(with([](Case& c) { c.spin[3] = Vec3(0, 0, 0.3 / kStep); }), 0.0);    // twisted far
}

}  // namespace
}  // namespace plekton::test

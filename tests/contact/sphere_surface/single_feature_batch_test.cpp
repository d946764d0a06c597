// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/single_feature_batch.hpp"

#include "contact/law_table.hpp"
#include "contact/sphere_surface/single_feature_contact.hpp"
#include "geometry/primitives/cell_clearance.hpp"
#include "tests/support/contact_laws.hpp"
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/vector_width.hpp"

#include <gtest/gtest.h>

#include <cstring>

/// Balls side by side on the insides of facets, against one after the other: the same bits.
namespace plekton::test::single_feature_batch_test {
namespace {

using LinearLaw = LinearFrictional;

constexpr double kStep = 1e-4;  // s

/// A ball over a facet, all in motion, and the memory of their contact.
template <class Law>
struct Case {
  Complex complex;
  std::vector<Vec3> velocity;
  std::vector<Vec3> spin;
  double radius;
  double range;
  typename Law::Parameters parameters;
  ContactMemory<Law> memory;
  SideFlags sides = kNoSides;
  bool may_be_alone = true;  ///< all cells in range are beside the facet

  Motion motion() const { return {complex.x, velocity, spin}; }
  const Vec3& centre() const { return complex.x[3]; }
  /// m, within which nothing else may be.
  double reach() const { return range + interaction_range_of<Law>(parameters); }
};

/// Facets of any shape, slivers among them, and balls of any size over their insides.
template <class Law>
Case<Law> random_case(Random& random) {
  Case<Law> c;
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
  const Body ball{{2e3 / c.radius, 0.3, 0.5}, c.radius};
  c.parameters = combine<Law>(random_properties<Law>(random), ball, ball);
  for (const double gap : {-0.05, -0.01}) {
    const RelativeMotion motion = relative_motion(
        c.memory.normal, gap * c.range, Law::elastic_normal_force(c.parameters, gap * c.range),
        random.in_cube(1.0), random.in_cube(10.0));
    Law::force(c.parameters, motion, c.memory.history, kStep);
  }
  return c;
}

/// With facets along some of the sides, folded a little or sharply.
template <class Law>
Case<Law> random_case_with_neighbours(Random& random) {
  Case<Law> c = random_case<Law>(random);
  const Vec3 normal = c.memory.normal;
  for (int k = 0; k < 3; ++k) {
    if (random.coin()) continue;
    const std::array<int, 3> corner{k, (k + 1) % 3, (k + 2) % 3};
    const auto at = [&](std::size_t i) { return c.complex.x[static_cast<std::size_t>(corner[i])]; };
    const double fold = random.signed_power(-4.0, 1.0) * c.range;
    const int beyond = c.complex.node(at(0) + at(1) - at(2) + fold * normal);
    c.complex.facet(corner[1], corner[0], beyond);
    c.velocity.push_back(random.in_cube(1.0));
    c.spin.push_back(random.in_cube(100.0));
  }
  const Surface surface = c.complex.surface();
  std::vector<CellId> cells;
  for (const CellId cell : all_cells(surface)) {
    if (!(geometry::clearance(surface, cell, c.centre(), c.reach(), c.complex.x) > 0.0))
      cells.push_back(cell);
  }
  c.may_be_alone =
      are_beside(surface, FaceId{0}, cells, c.centre(), c.reach(), c.complex.x, c.sides);
  return c;
}

/// Cases as a batch reads them.
template <class Law>
struct Cases {
  struct Pair {
    double radius;
    double range;
    AnyLaw::Parameters parameters;
    ContactMemory<AnyLaw> memory;
  };
  std::vector<Vec3> position, velocity, spin;
  std::vector<Pair> pairs;
  std::vector<SideFlags> sides;
  std::vector<std::size_t> first_nodes;

  void add(const Case<Law>& c) {
    first_nodes.push_back(position.size());
    sides.push_back(c.sides);
    position.insert(position.end(), c.complex.x.begin(), c.complex.x.end());
    velocity.insert(velocity.end(), c.velocity.begin(), c.velocity.end());
    spin.insert(spin.end(), c.spin.begin(), c.spin.end());
    Pair& pair = pairs.emplace_back(Pair{c.radius, c.range, {}, {}});
    const AnyLaw::Functions& law = LawTable<Law>::functions;
    pair.parameters.keep(law, c.parameters);
    pair.memory.history.keep(law, c.memory.history);
    pair.memory.normal = c.memory.normal;
  }
  void advance(SingleFeatureBatch& batch) const {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto first = static_cast<std::int32_t>(first_nodes[k]);
      const Pair& pair = pairs[k];
      batch.add({{NodeId{first + 3}, NodeId{first}, NodeId{first + 1}, NodeId{first + 2}},
                 pair.radius,
                 pair.range,
                 &pair.parameters,
                 &pair.memory,
                 sides[k]});
    }
    batch.advance({position, velocity, spin}, kStep);
  }
};

/// As a patch takes it, of a law that is known as a type.
template <class Law>
struct NormalOf {
  const typename Law::Parameters& parameters;
  double elastic_force(double gap) const { return Law::elastic_normal_force(parameters, gap); }
  double energy(double gap) const { return Law::elastic_normal_energy(parameters, gap); }
};

/// That the general way finds the inside of the facet alone, and makes the same of it.
template <class Law>
void expect_general(const Case<Law>& c, const SingleFeatureBatch& block, std::size_t lane) {
  const typename Law::Parameters& parameters = c.parameters;
  const Surface surface = c.complex.surface();
  PatchFinder finder(surface);
  const auto patches = finder.find(c.centre(), c.reach(), all_cells(surface), c.complex.x);
  ASSERT_EQ(patches.size(), 1u);
  ASSERT_TRUE(is_single_feature(finder.terms(patches[0])));
  ASSERT_EQ(patches[0].root, Feature(FaceId{0}));
  const PatchTerm& term = finder.terms(patches[0])[0];
  const PatchState state = single_feature_state(term, NormalOf<Law>{parameters}, NodeId{3},
                                                c.radius, c.range, c.motion());
  typename Law::History history =
      carried_history<Law>(c.memory, state.normal, kStep * state.twist_rate);
  ASSERT_TRUE(state.gap < 0.0 || goes_on<Law>(parameters, history, state.gap));
  const RelativeMotion relative = relative_motion(state.normal, state.gap, state.elastic_force,
                                                  state.relative_velocity, state.relative_spin);
  const ContactForce answer = Law::force(parameters, relative, history, kStep);
  const Vec3 other = answer.force - state.elastic_force * state.normal;
  const Vec3 lever_b = state.lever_a - term.distance * term.normal;

  const auto& found = block.answer(lane);
  EXPECT_EQ(found.weights(), term.core.weights);
  EXPECT_EQ(found.normal(), term.normal);
  AnyLaw::History found_history;
  found.get_history(LawTable<Law>::functions, found_history);
  EXPECT_EQ(std::memcmp(found_history.numbers.data(), &history, sizeof(history)), 0);
  EXPECT_EQ(found.gap(), state.gap);
  EXPECT_EQ(found.foot(), state.foot);
  EXPECT_EQ(found.force_b(), state.elastic_force * term.normal + other);
  EXPECT_EQ(found.torque_a(), -state.lever_a.cross(other) - answer.moment);
  EXPECT_EQ(found.torque_b(), lever_b.cross(other) + answer.moment);
  EXPECT_EQ(found.dissipated(), answer.dissipated);
}

template <class Law>
class SingleFeatureBatchUnder : public testing::Test {};
TYPED_TEST_SUITE(SingleFeatureBatchUnder, LaneLaws);

/// @returns how many answers were right
template <class Law>
int compare_with_general(int width, Case<Law> (*make)(Random&)) {
  const VectorWidth vectors(width);
  Random random(1);
  int right = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t count = 1 + random.index(kSingleFeatureLanes);
    std::vector<Case<Law>> cases;
    Cases<Law> all;
    for (std::size_t k = 0; k < count; ++k) all.add(cases.emplace_back(make(random)));
    SingleFeatureBatch block;

    all.advance(block);

    for (std::size_t k = 0; k < count; ++k) {
      if (!block.answer(k).is_right() || !cases[k].may_be_alone) continue;
      ++right;
      expect_general(cases[k], block, k);
      if (testing::Test::HasFailure()) return trial;
    }
  }
  return right;
}

TYPED_TEST(SingleFeatureBatchUnder, GivesTheBitsOfTheGeneralWayOrSaysThatItDoesNotKnow) {
  for (const int width : vector_widths())
    EXPECT_GT(compare_with_general(width, random_case<TypeParam>), 1000);
}

TYPED_TEST(SingleFeatureBatchUnder, GivesTheBitsOfTheGeneralWayBesideOtherFacets) {
  for (const int width : vector_widths())
    EXPECT_GT(compare_with_general(width, random_case_with_neighbours<TypeParam>), 1000);
}

class SingleFeatureBatchOf : public testing::TestWithParam<int> {
  VectorWidth vectors_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Widths, SingleFeatureBatchOf, testing::ValuesIn(vector_widths()),
                         testing::PrintToStringParamName());

/// One side of the facet is in range, and another facet beyond it.
Case<LinearLaw> case_beside(double fold) {
  Random random(3);
  Case<LinearLaw> c = random_case<LinearLaw>(random);
  c.complex.x = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(1.2, 0.1, 0.4)};
  c.radius = 0.4;
  c.range = 0.44;
  c.memory.normal = -Vec3::UnitZ();
  c.complex.node(Vec3(1.5, -2.0, fold));
  c.complex.facet(0, 1, 4);
  c.velocity.push_back(Vec3::Zero());
  c.spin.push_back(Vec3::Zero());
  const Surface surface = c.complex.surface();
  c.may_be_alone =
      are_beside(surface, FaceId{0}, all_cells(surface), c.centre(), c.range, c.complex.x, c.sides);
  return c;
}

TEST_P(SingleFeatureBatchOf, KnowsASideThatDoesNotTouchByItself) {
  const auto knows = [](const Case<LinearLaw>& c) {
    Cases<LinearLaw> all;
    all.add(c);
    SingleFeatureBatch block;
    all.advance(block);
    return c.may_be_alone && block.answer(0).is_right();
  };
  EXPECT_TRUE(knows(case_beside(0.0)));
  EXPECT_TRUE(knows(case_beside(-0.2)));
  // The facet beyond comes up so steeply that the ball is over it as well.
  EXPECT_FALSE(knows(case_beside(4.0)));
}

/// A ball over the middle of a facet.
Case<LinearLaw> ordinary_case() {
  Random random(2);
  Case<LinearLaw> c = random_case<LinearLaw>(random);
  c.complex.x = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0.9, 0.9, 0.4)};
  c.radius = 0.4;
  c.range = 0.44;
  c.memory.normal = -Vec3::UnitZ();
  return c;
}

bool is_right(const Case<LinearLaw>& c) {
  Cases<LinearLaw> all;
  for (int k = 0; k < 5; ++k) all.add(c);
  SingleFeatureBatch block;
  all.advance(block);
  return block.answer(3).is_right();
}

TEST_P(SingleFeatureBatchOf, LeavesToTheGeneralWayWhatIsNotCertain) {
  const auto with = [](auto change) {
    Case<LinearLaw> c = ordinary_case();
    change(c);
    return is_right(c);
  };
  EXPECT_TRUE(with([](Case<LinearLaw>&) {}));
  EXPECT_FALSE(
      with([](Case<LinearLaw>& c) { c.complex.x[3] = Vec3(0.9, 0.1, 0.4); }));  // a side in range
  EXPECT_FALSE(
      with([](Case<LinearLaw>& c) { c.complex.x[3] = Vec3(0.9, -0.1, 0.4); }));  // foot outside
  EXPECT_FALSE(
      with([](Case<LinearLaw>& c) { c.complex.x[3] = Vec3(0.9, 0.9, 0.44); }));  // out of range
  EXPECT_FALSE(
      with([](Case<LinearLaw>& c) { c.complex.x[3] = Vec3(0.9, 0.9, 0.0); }));       // no direction
  EXPECT_FALSE(with([](Case<LinearLaw>& c) { c.complex.x[2] = Vec3(1.5, 0, 0); }));  // no area
  EXPECT_FALSE(with([](Case<LinearLaw>& c) { c.memory.normal = Vec3::UnitZ(); }));   // gone through
  EXPECT_FALSE(
      with([](Case<LinearLaw>& c) { c.spin[3] = Vec3(0, 0, 0.3 / kStep); }));  // twisted far
}

}  // namespace
}  // namespace plekton::test::single_feature_batch_test

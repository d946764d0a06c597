// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_table.hpp"
#include "contact/sphere_sphere/sphere_batch.hpp"
#include "contact/sphere_sphere/sphere_contacts.hpp"
#include "tests/support/contact_laws.hpp"
#include "tests/support/one_at_a_time.hpp"
#include "tests/support/vector_width.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

// The kernel for contacts side by side against its plain description, one pair after the other: the
// same bits.
namespace plekton::contact::sphere_kernel_test {
namespace {

constexpr double kStep = 1e-5;  // s
constexpr Material kStone{2e6, 0.3, 0.5};
constexpr double kMass = 1e-5;  // kg

template <class Law>
struct Case {
  SpherePairOf<double> pair;
  Vec3 separation;
  typename Law::Parameters parameters;
  ContactMemory<Law> memory;

  Body body(double radius) const { return {kStone, radius, kMass}; }
};

/// Overlapping balls in motion, or just apart; every fourth contact is new, about half of the
/// others slip.
template <class Law>
class RandomCases {
 public:
  Case<Law> operator()() {
    Case<Law> c;
    c.pair.radius_a = 1e-3 * (1.0 + 0.3 * number());
    c.pair.radius_b = 1e-3 * (1.0 + 0.3 * number());
    const Vec3 direction = vector().normalized();
    c.separation = (c.pair.radius_a + c.pair.radius_b) * (0.99 + 0.01 * number()) * direction;
    c.pair.distance = c.separation.norm();
    c.pair.normal = (1.0 / c.pair.distance) * c.separation;
    c.pair.velocity = vector();
    c.pair.spin_a = 100.0 * vector();
    c.pair.spin_b = 100.0 * vector();
    c.parameters = combine<Law>(test::random_properties<Law>(random_), c.body(c.pair.radius_a),
                                c.body(c.pair.radius_b));
    if (count_++ % 4 == 0) return c;
    c.memory.normal = (direction + 0.01 * vector()).normalized();
    // A contact that has slipped and rolled, towards the end over a distance.
    for (const double gap : {-1e-5, -2e-5, 1e-5 * number()}) {
      const RelativeMotion motion =
          relative_motion(c.memory.normal, gap, Law::elastic_normal_force(c.parameters, gap),
                          vector(), 1e3 * vector());
      Law::force(c.parameters, motion, c.memory.history, kStep);
    }
    return c;
  }

  double number() { return uniform_(engine_); }
  Vec3 vector() { return {number(), number(), number()}; }

 private:
  std::mt19937_64 engine_{20240229};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
  test::Random random_{3};
  int count_ = 0;
};

template <class Law>
void put(const Case<Law>& c, std::size_t lane, SphereBatch& block) {
  block.separation.set(lane, c.separation);
  block.velocity.set(lane, c.pair.velocity);
  block.spin_a.set(lane, c.pair.spin_a);
  block.spin_b.set(lane, c.pair.spin_b);
  block.radius_a.set(lane, c.pair.radius_a);
  block.radius_b.set(lane, c.pair.radius_b);
  block.parameters().set(lane, c.parameters);
  block.history().set(lane, c.memory.history);
  block.normal.set(lane, c.memory.normal);
}

template <class Rows>
Vec3 vector_of(const Rows& rows, std::size_t lane) {
  Vec3 v;
  rows.get(lane, v);
  return v;
}

/// The numbers that a thing consists of.
template <class Thing>
std::vector<double> numbers_of(const Thing& thing) {
  std::vector<double> numbers(sizeof(Thing) / sizeof(double));
  std::memcpy(numbers.data(), &thing, sizeof(Thing));
  return numbers;
}

template <class Law>
void expect_step_of(const Case<Law>& c, SphereBatch& block, std::size_t lane) {
  typename Law::History history =
      carried_history<Law>(c.memory, c.pair.normal, kStep * c.pair.twist_rate());
  const SphereStepOf<double> step = sphere_step<Law>(c.pair, c.parameters, history, kStep);

  EXPECT_EQ(vector_of(block.normal, lane), c.pair.normal);
  EXPECT_EQ(numbers_of(block.history().template at<typename Law::History>(lane)),
            numbers_of(history));
  EXPECT_EQ(vector_of(block.force, lane), step.force);
  EXPECT_EQ(vector_of(block.torque_a, lane), step.arm_a * step.force_cross_normal - step.moment);
  EXPECT_EQ(block.gap.number(lane), step.gap);
  EXPECT_EQ(block.dissipated.number(lane), step.dissipated);
}

template <class Law>
class SphereKernel : public testing::Test {};
TYPED_TEST_SUITE(SphereKernel, test::LaneLaws);

/// @returns whether all answers are right
template <class Law>
bool advance(SphereBatch& block, std::size_t count) {
  return LawTable<Law>::functions.advance_batch(block, count, kStep);
}

TYPED_TEST(SphereKernel, GivesTheBitsOfOnePairAfterTheOtherForAnyCountAndWidth) {
  for (const int width : test::vector_widths()) {
    const test::VectorWidth vectors(width);
    RandomCases<TypeParam> random;
    for (std::size_t count = 1; count <= 40; ++count) {
      std::vector<Case<TypeParam>> cases;
      SphereBatch block;
      for (std::size_t lane = 0; lane < count; ++lane)
        put(cases.emplace_back(random()), lane, block);

      ASSERT_TRUE(advance<TypeParam>(block, count));

      for (std::size_t lane = 0; lane < count; ++lane) expect_step_of(cases[lane], block, lane);
    }
  }
}

using Law = LinearFrictional;

class SphereKernelOf : public testing::TestWithParam<int> {
  test::VectorWidth vectors_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Widths, SphereKernelOf, testing::ValuesIn(test::vector_widths()),
                         testing::PrintToStringParamName());

TEST_P(SphereKernelOf, SaysWhenAPairNeedsThePlainWay) {
  RandomCases<Law> random;
  const auto all_right = [](const Case<Law>& odd, std::size_t lane) {
    RandomCases<Law> others;
    SphereBatch block;
    for (std::size_t k = 0; k < 11; ++k) put(k == lane ? odd : others(), k, block);
    return advance<Law>(block, 11);
  };
  Case<Law> ordinary = random();
  Case<Law> flipped = ordinary;
  flipped.memory.normal = -flipped.pair.normal;
  Case<Law> coincident = ordinary;
  coincident.separation.setZero();
  Case<Law> twisted = ordinary;
  twisted.pair.spin_a = twisted.pair.spin_b = 0.11 / kStep * twisted.pair.normal;

  for (std::size_t lane = 0; lane < 11; ++lane) {
    EXPECT_TRUE(all_right(ordinary, lane));
    EXPECT_FALSE(all_right(flipped, lane));
    EXPECT_FALSE(all_right(coincident, lane));
    EXPECT_FALSE(all_right(twisted, lane));
  }
}

using PlainLaw = test::OneAtATime<Law>;
static_assert(ContactLaw<PlainLaw> && !LaneLaw<PlainLaw> && LaneLaw<Law>);
static_assert(CombinesRadii<Law> && !CombinesRadii<PlainLaw>);

/// A crowd of balls and all their pairs, thrown about anew before every step.
/// @param knows_where  whether the list tells who touches at first
template <class Law>
std::vector<Vec3> forces_of_a_crowd(int threads, bool knows_where = false,
                                    const PropertiesOf<Law>& properties = {}) {
  constexpr std::size_t kBalls = 60;
  std::vector<SphereBody> balls;
  std::vector<geometry::IndexPair> pairs;
  for (std::int32_t b = 0; b < std::int32_t{kBalls}; ++b) {
    balls.push_back({NodeId{b}, 1e-3, MaterialId{0}, -1, kMass});
    for (std::int32_t a = 0; a < b; ++a) pairs.push_back({a, b});
  }
  std::sort(pairs.begin(), pairs.end());
  SphereContacts contacts;
  geometry::ThreadPool pool(threads);
  NodeForces forces(kBalls);
  std::vector<Vec3> all;
  RandomCases<LinearFrictional> random;
  std::vector<Vec3> x(kBalls), v(kBalls), w(kBalls);
  for (Vec3& p : x) p = 3e-3 * random.vector();
  const MaterialPairs materials({kStone},
                                {{{MaterialId{0}, MaterialId{0}}, AnyLaw::of<Law>(properties)}});
  contacts.rebuild(pairs, balls, materials, pool, knows_where ? Positions(x) : Positions());
  for (int step = 0; step < 20; ++step) {
    for (std::size_t i = 0; i < kBalls; ++i) {
      x[i] += 5e-5 * random.vector();
      v[i] = random.vector();
      w[i] = 200.0 * random.vector();
    }
    if (step % 5 == 1) x[7] = x[3];                          // no direction
    if (step % 5 == 2) std::swap(x[11], x[40]);              // flips where they touch
    if (step % 5 == 3) w[20] = Vec3::Constant(1.0 / kStep);  // a twist beyond any series
    contacts.advance({x, v, w}, kStep, pool, forces);
    all.insert(all.end(), forces.force.begin(), forces.force.end());
    all.insert(all.end(), forces.torque.begin(), forces.torque.end());
  }
  return all;
}

TEST(SphereContacts, SetTheForcesOfAllNodes) {
  const std::vector<Vec3> x{Vec3::Zero(),       Vec3::Zero(),  Vec3::Zero(),
                            Vec3(1.9e-3, 0, 0), Vec3(1, 0, 0), Vec3::Zero()};
  const std::vector<Vec3> still(x.size(), Vec3::Zero());
  const MaterialId stone{0};
  const std::vector<SphereBody> balls{
      {NodeId{1}, 1e-3, stone}, {NodeId{3}, 1e-3, stone}, {NodeId{4}, 1e-3, stone}};
  const std::vector<geometry::IndexPair> pairs{{0, 1}};
  for (const int threads : {1, 2}) {
    geometry::ThreadPool pool(threads);
    SphereContacts contacts;
    contacts.rebuild(pairs, balls, MaterialPairs({Material{2e6, 0.3, 0.5}}), pool, x);
    NodeForces forces(x.size());
    for (std::vector<Vec3>* sums : {&forces.force, &forces.torque})
      std::fill(sums->begin(), sums->end(), Vec3::Ones());

    contacts.advance({x, still, still}, kStep, pool, forces);

    EXPECT_LT(forces.force[1].x(), 0.0);
    EXPECT_EQ(forces.force[3], -forces.force[1]);
    for (const std::size_t node : {0U, 2U, 4U, 5U}) EXPECT_EQ(forces.force[node], Vec3::Zero());
    EXPECT_EQ(forces.torque, still);
  }
}

template <class Law>
class SphereContactsUnder : public testing::Test {};
TYPED_TEST_SUITE(SphereContactsUnder, test::LaneLaws);

TYPED_TEST(SphereContactsUnder, HaveTheSameBitsSideBySideAndOneAfterTheOther) {
  test::Random random(7);
  for (int trial = 0; trial < 5; ++trial) {
    const auto properties = test::random_properties<TypeParam>(random);

    const auto one_by_one = forces_of_a_crowd<test::OneAtATime<TypeParam>>(1, false, properties);
    for (const int width : test::vector_widths()) {
      const test::VectorWidth vectors(width);
      EXPECT_EQ(forces_of_a_crowd<TypeParam>(1, false, properties), one_by_one) << width;
    }
  }
}

/// One says what the others come to, so that parameters are kept instead of made anew.
TEST(SphereContacts, HaveTheSameBitsUnderAStiffnessThatIsGiven) {
  const Law::Properties same{.normal_stiffness = 2e6 * 1e-3,
                             .tangential_stiffness = 2e6 * 1e-3 * 0.3};
  const Law::Properties other{.normal_stiffness = 3e3, .tangential_stiffness = 1e3};

  EXPECT_EQ(forces_of_a_crowd<Law>(1, false, same), forces_of_a_crowd<Law>(1));
  const std::vector<Vec3> with_other = forces_of_a_crowd<Law>(1, false, other);
  EXPECT_NE(with_other, forces_of_a_crowd<Law>(1));
  EXPECT_EQ(with_other, forces_of_a_crowd<Law>(4, false, other));
}

TEST(SphereContacts, HaveTheSameBitsForAnyNumberOfThreads) {
  const std::vector<Vec3> of_one = forces_of_a_crowd<Law>(1);

  EXPECT_EQ(forces_of_a_crowd<Law>(2), of_one);
  EXPECT_EQ(forces_of_a_crowd<Law>(4), of_one);
}

TEST(SphereContacts, DoNotDependOnWhoTouchedWhenTheListWasMade) {
  const std::vector<Vec3> without = forces_of_a_crowd<Law>(1);
  const std::vector<Vec3> with = forces_of_a_crowd<Law>(1, true);

  // Only the order of sums differs: 20 steps of up to 59 forces, none larger than their stiffness
  // 2e3 N/m times the range 2e-3 m, or that times the radius as a torque.
  const double rounding = 20 * 59 * std::numeric_limits<double>::epsilon() * (20 * 59 * 4.0);
  for (std::size_t i = 0; i < with.size(); ++i)
    EXPECT_LE((with[i] - without[i]).norm(), rounding) << i;
  EXPECT_NE(with, without);
}

}  // namespace
}  // namespace plekton::contact::sphere_kernel_test

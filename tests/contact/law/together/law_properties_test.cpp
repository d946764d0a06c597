// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tracking/contact_memory.hpp"
#include "tests/support/contact_laws.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// What every contact law has to obey. A new law joins the list and is tested.
namespace plekton::contact::law_properties_test {
namespace {

using test::Random;

template <class Law>
class LawProperties : public ::testing::Test {
 public:
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;

  Body random_body() {
    return {{std::pow(10.0, random_.uniform(5.0, 8.0)), random_.uniform(0.1, 1.0),
             random_.uniform(0.0, 1.0), random_.uniform(0.0, 0.45)},
            random_.uniform(0.01, 0.1),
            random_.uniform(0.1, 1.0),
            static_cast<Shape>(random_.uniform(0.0, 3.0))};
  }

  /// A pair of bodies, and the scale of their overlap.
  Parameters random_parameters() {
    const Body a = random_body();
    const Body b = random_body();
    friction_ = std::min(a.material.friction, b.material.friction);
    return combine<Law>(test::random_properties<Law>(random_), a, b);
  }

  /// Motion along a normal and across it, at a gap.
  RelativeMotion motion(const Parameters& p, const Vec3& normal, double gap, const Vec3& velocity,
                        const Vec3& spin = Vec3::Zero()) const {
    return relative_motion(normal, gap, Law::elastic_normal_force(p, gap), velocity, spin);
  }

  /// A history after some random motion about a normal.
  History random_history(const Parameters& p, const Vec3& normal) {
    History history{};
    for (int k = 0; k < 5; ++k)
      Law::force(p, motion(p, normal, -kOverlap, random_.in_cube(1.0)), history, kOverlap);
    return history;
  }

  /// Tangential force on b of a history at rest.
  static Vec3 tangential_force(const Parameters& p, const Vec3& normal, History history) {
    const RelativeMotion rest =
        relative_motion(normal, -kOverlap, Law::elastic_normal_force(p, -kOverlap), Vec3::Zero());
    const Vec3 force = Law::force(p, rest, history, 0.0).force;
    return force - force.dot(normal) * normal;
  }

  static constexpr double kOverlap = 1e-4;  ///< m
  Random random_{1};
  double friction_ = 0.0;
};

TYPED_TEST_SUITE(LawProperties, test::AllLaws);

TYPED_TEST(LawProperties, TheOrderOfTheBodiesDoesNotMatter) {
  using Law = TypeParam;
  for (int trial = 0; trial < 100; ++trial) {
    const Body a = this->random_body();
    const Body b = this->random_body();
    const auto properties = test::random_properties<Law>(this->random_);
    const auto ab = combine<Law>(properties, a, b);
    const auto ba = combine<Law>(properties, b, a);
    const Vec3 normal = this->random_.direction();
    const RelativeMotion motion =
        this->motion(ab, normal, -this->kOverlap, this->random_.in_cube(1.0));
    typename Law::History first{};
    typename Law::History second{};

    EXPECT_EQ(Law::elastic_normal_force(ab, -this->kOverlap),
              Law::elastic_normal_force(ba, -this->kOverlap));
    const ContactForce of_ab = Law::force(ab, motion, first, 1e-5);
    const ContactForce of_ba = Law::force(ba, motion, second, 1e-5);
    EXPECT_EQ(of_ab.force, of_ba.force);
    EXPECT_EQ(of_ab.moment, of_ba.moment);
  }
}

TYPED_TEST(LawProperties, TheForceTurnsWithTheObserver) {
  using Law = TypeParam;
  for (int trial = 0; trial < 200; ++trial) {
    const auto p = this->random_parameters();
    const Mat3 turn = this->random_.rotation();
    const Vec3 normal = this->random_.direction();
    typename Law::History history{};
    typename Law::History turned_history{};
    for (int step = 0; step < 20; ++step) {
      const double gap = -this->kOverlap * this->random_.unit();
      const Vec3 velocity = this->random_.in_cube(1.0);
      const Vec3 spin = this->random_.in_cube(1.0);
      const double dt = 0.3 * this->kOverlap;
      const auto result = Law::force(p, this->motion(p, normal, gap, velocity, spin), history, dt);
      const auto turned = Law::force(
          p, this->motion(p, turn * normal, gap, turn * velocity, turn * spin), turned_history, dt);
      // A few dozen roundings of the largest force.
      const double scale =
          std::max(Law::normal_stiffness(p, gap) * this->kOverlap, result.force.norm());
      ASSERT_NEAR((turned.force - turn * result.force).norm(), 0.0, 1e-13 * scale);
      ASSERT_NEAR((turned.moment - turn * result.moment).norm(), 0.0, 1e-13 * scale);
      ASSERT_NEAR(turned.dissipated, result.dissipated,
                  1e-13 * (scale * this->kOverlap + std::abs(result.dissipated)));
    }
  }
}

TYPED_TEST(LawProperties, TheTangentialForceStaysWithinCoulombsCone) {
  using Law = TypeParam;
  for (int trial = 0; trial < 200; ++trial) {
    const auto p = this->random_parameters();
    const Vec3 normal = this->random_.direction();
    typename Law::History history{};
    for (int step = 0; step < 50; ++step) {
      const double gap = this->kOverlap * this->random_.uniform(-1.0, 0.2);
      const RelativeMotion motion = this->motion(p, normal, gap, this->random_.in_cube(1.0));
      const Vec3 force =
          Law::force(p, motion, history, this->kOverlap * this->random_.unit()).force;
      const Vec3 tangential = force - force.dot(normal) * normal;
      const double scale = std::max(Law::normal_stiffness(p, gap) * this->kOverlap, force.norm());
      ASSERT_LE(tangential.norm(),
                this->friction_ * motion.elastic_normal_force * (1.0 + 1e-12) + 1e-14 * scale);
    }
  }
}

TYPED_TEST(LawProperties, TheNormalForceIsTheSlopeOfItsEnergy) {
  using Law = TypeParam;
  const double step = 1e-4 * this->kOverlap;
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = this->random_parameters();
    const double gap = -this->kOverlap * this->random_.uniform(0.1, 1.0);
    const double slope =
        (Law::elastic_normal_energy(p, gap + step) - Law::elastic_normal_energy(p, gap - step)) /
        (2.0 * step);
    const double stiffness =
        (Law::elastic_normal_force(p, gap - step) - Law::elastic_normal_force(p, gap + step)) /
        (2.0 * step);

    EXPECT_NEAR(-slope, Law::elastic_normal_force(p, gap),
                1e-6 * Law::elastic_normal_force(p, gap));
    // What a time step has to be safe for: with a dashpot, more.
    if (test::kHasDashpot<Law>) {
      EXPECT_GE(Law::normal_stiffness(p, gap), (1.0 - 1e-6) * stiffness);
    } else {
      EXPECT_NEAR(stiffness, Law::normal_stiffness(p, gap), 1e-6 * stiffness);
    }
  }
  const auto p = this->random_parameters();
  EXPECT_EQ(Law::elastic_normal_force(p, 0.0), 0.0);
  EXPECT_EQ(Law::elastic_normal_force(p, 1.0), 0.0);
  EXPECT_EQ(Law::elastic_normal_energy(p, 0.0), 0.0);
}

TYPED_TEST(LawProperties, TheTangentialForceIsTheSlopeOfItsEnergyWhileNothingSlides) {
  using Law = TypeParam;
  const double step = 1e-6 * this->kOverlap;
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = this->random_parameters();
    const Vec3 normal = this->random_.direction();
    auto history = this->random_history(p, normal);
    // From the cone to well inside it.
    typename Law::History inside{};
    Law::accumulate_history(inside, history, 0.5);
    const Vec3 force = this->tangential_force(p, normal, inside);
    const Vec3 slip = normal.cross(this->random_.direction());
    typename Law::History moved = inside;
    const auto result = Law::force(p, this->motion(p, normal, -this->kOverlap, slip), moved, step);
    if (result.dissipated > 0.0) continue;  // no friction at all
    const double change = Law::history_energy(p, moved) - Law::history_energy(p, inside);

    EXPECT_NEAR(change, -force.dot(step * slip),
                Law::tangential_stiffness(p, -this->kOverlap) * step * step +
                    1e-12 * Law::history_energy(p, inside));
  }
}

TYPED_TEST(LawProperties, TheHistoryComesBackAfterARevolutionOfThePair) {
  using Law = TypeParam;
  for (const int steps : {5, 100, 1000}) {
    const auto p = this->random_parameters();
    const Vec3 axis = this->random_.direction();
    const Vec3 start = axis.unitOrthogonal();
    ContactMemory<Law> memory{this->random_history(p, start), start};
    const Vec3 before = this->tangential_force(p, start, memory.history);
    for (int k = 1; k <= steps; ++k) {
      const Vec3 normal = Eigen::AngleAxisd(2.0 * std::numbers::pi * k / steps, axis) * start;
      memory = {carried_history<Law>(memory, normal, 0.0), normal};
    }

    const Vec3 after = this->tangential_force(p, memory.normal, memory.history);

    EXPECT_NEAR((after - before).norm(), 0.0, 4e-15 * steps * before.norm());
  }
}

TYPED_TEST(LawProperties, TheHistoryTurnsWithTheTwistOfThePair) {
  using Law = TypeParam;
  const auto p = this->random_parameters();
  const Vec3 normal = this->random_.direction();
  const ContactMemory<Law> memory{this->random_history(p, normal), normal};
  const double twist = 1.234;

  const auto turned = carried_history<Law>(memory, normal, twist);

  const Vec3 before = this->tangential_force(p, normal, memory.history);
  const Vec3 expected = Eigen::AngleAxisd(twist, normal) * before;
  EXPECT_NEAR((this->tangential_force(p, normal, turned) - expected).norm(), 0.0,
              1e-14 * before.norm());
}

// As a centre goes through a facet: the contact plane stays as it is.
TYPED_TEST(LawProperties, TheHistoryGoesOnWhereTheNormalTurnsOver) {
  using Law = TypeParam;
  const auto p = this->random_parameters();
  const Vec3 normal = this->random_.direction();
  const ContactMemory<Law> memory{this->random_history(p, normal), normal};

  const auto behind = carried_history<Law>(memory, -normal, 0.0);

  const Vec3 before = this->tangential_force(p, normal, memory.history);
  EXPECT_NEAR((this->tangential_force(p, -normal, behind) - before).norm(), 0.0,
              1e-14 * before.norm());
  EXPECT_NEAR(Law::history_energy(p, behind), Law::history_energy(p, memory.history),
              1e-14 * std::abs(Law::history_energy(p, memory.history)));
  if constexpr (HasMoments<Law>) {
    const Vec3 moment = Law::moment(memory.history, normal);
    EXPECT_NEAR((Law::moment(behind, -normal) - moment).norm(), 0.0, 1e-14 * moment.norm());
  }
}

TYPED_TEST(LawProperties, ANormalThatNearlyTurnsOverKeepsTheLengthOfTheTangentialForce) {
  using Law = TypeParam;
  const auto p = this->random_parameters();
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 normal = this->random_.direction();
    const ContactMemory<Law> memory{this->random_history(p, normal), normal};
    const Vec3 other = Eigen::AngleAxisd(this->random_.uniform(2.0 / 3.0, 1.0) * std::numbers::pi,
                                         normal.unitOrthogonal()) *
                       normal;

    const auto behind = carried_history<Law>(memory, other, this->random_.uniform(-1.0, 1.0));

    const double before = this->tangential_force(p, normal, memory.history).norm();
    EXPECT_NEAR(this->tangential_force(p, other, behind).norm(), before, 1e-14 * before);
  }
}

TYPED_TEST(LawProperties, ANewContactHasNoHistory) {
  using Law = TypeParam;
  const auto p = this->random_parameters();
  const Vec3 normal = this->random_.direction();

  EXPECT_EQ(Law::history_energy(p, carried_history<Law>(ContactMemory<Law>{}, normal, 0.1)), 0.0);
}

TYPED_TEST(LawProperties, SharesOfAHistoryAddUpToIt) {
  using Law = TypeParam;
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = this->random_parameters();
    const Vec3 normal = this->random_.direction();
    const auto whole = this->random_history(p, normal);
    typename Law::History sum{};
    Law::accumulate_history(sum, whole, 0.3);
    Law::accumulate_history(sum, whole, 0.7);

    const Vec3 expected = this->tangential_force(p, normal, whole);
    EXPECT_NEAR((this->tangential_force(p, normal, sum) - expected).norm(), 0.0,
                1e-14 * expected.norm());
  }
}

TEST(LinearFrictional, HasTheStiffnessOfTwoSpringsInSeries) {
  const Body a{{1e6, 0.5, 0.4}, 0.1};
  const Body b{{3e6, 0.2, 0.3}, 0.2};

  const auto p = LinearFrictional::combine(a, b);

  EXPECT_DOUBLE_EQ(p.normal_stiffness, 2.0 * 1e5 * 6e5 / (1e5 + 6e5));
  EXPECT_DOUBLE_EQ(p.tangential_stiffness, 2.0 * 0.5e5 * 1.2e5 / (0.5e5 + 1.2e5));
  EXPECT_EQ(p.friction, 0.3);
}

TEST(LinearFrictional, LetsGoOfTheTangentialForceWithTheNormalForce) {
  const LinearFrictional::Parameters p{1e6, 5e5, 0.5};
  LinearFrictional::History history{Vec3(1e-5, 0, 0)};
  const RelativeMotion motion = relative_motion(Vec3::UnitZ(), -1e-6, 1.0, Vec3::Zero());

  const ContactForce result = LinearFrictional::force(p, motion, history, 1e-3);

  EXPECT_DOUBLE_EQ(result.force[0], -0.5);
  EXPECT_GT(result.dissipated, 0.0);
}

}  // namespace
}  // namespace plekton::contact::law_properties_test

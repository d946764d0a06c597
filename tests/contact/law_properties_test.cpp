// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contact_memory.hpp"
#include "contact/laws/linear_frictional.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// What every contact law has to obey. A new law joins the list and is tested.
namespace plekton::contact {
namespace {

using test::Random;

template <class Law>
class LawProperties : public ::testing::Test {
 public:
  using Parameters = typename Law::Parameters;
  using History = typename Law::History;

  Material random_material() {
    return {std::pow(10.0, random_.uniform(5.0, 8.0)), random_.uniform(0.1, 1.0),
            random_.uniform(0.0, 1.0)};
  }

  /// A pair of bodies, and the scale of their overlap.
  Parameters random_parameters() {
    const Material a = random_material();
    const Material b = random_material();
    friction_ = std::min(a.friction, b.friction);
    return Law::combine(a, random_.uniform(0.01, 0.1), b, random_.uniform(0.01, 0.1));
  }

  /// Motion along a normal and across it, at a gap.
  RelativeMotion motion(const Parameters& p, const Vec3& normal, double gap,
                        const Vec3& velocity) const {
    return relative_motion(normal, gap, Law::elastic_normal_force(p, gap), velocity);
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

using Laws = ::testing::Types<LinearFrictional, test::WeakeningSlider>;
TYPED_TEST_SUITE(LawProperties, Laws);

TYPED_TEST(LawProperties, TheOrderOfTheBodiesDoesNotMatter) {
  using Law = TypeParam;
  for (int trial = 0; trial < 100; ++trial) {
    const Material a = this->random_material();
    const Material b = this->random_material();
    const auto ab = Law::combine(a, 0.03, b, 0.05);
    const auto ba = Law::combine(b, 0.05, a, 0.03);
    const Vec3 normal = this->random_.direction();
    const RelativeMotion motion =
        this->motion(ab, normal, -this->kOverlap, this->random_.in_cube(1.0));
    typename Law::History first{};
    typename Law::History second{};

    EXPECT_EQ(Law::elastic_normal_force(ab, -this->kOverlap),
              Law::elastic_normal_force(ba, -this->kOverlap));
    EXPECT_EQ(Law::force(ab, motion, first, 1e-5).force,
              Law::force(ba, motion, second, 1e-5).force);
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
      const double dt = 0.3 * this->kOverlap;
      const auto result = Law::force(p, this->motion(p, normal, gap, velocity), history, dt);
      const auto turned =
          Law::force(p, this->motion(p, turn * normal, gap, turn * velocity), turned_history, dt);
      // A few dozen roundings of the largest force.
      const double scale = Law::normal_stiffness(p, gap) * this->kOverlap;
      ASSERT_NEAR((turned.force - turn * result.force).norm(), 0.0, 1e-13 * scale);
      ASSERT_NEAR(turned.dissipated, result.dissipated, 1e-13 * scale * this->kOverlap);
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
      ASSERT_LE(tangential.norm(), this->friction_ * motion.elastic_normal_force * (1.0 + 1e-12) +
                                       1e-14 * Law::normal_stiffness(p, gap) * this->kOverlap);
    }
  }
}

TYPED_TEST(LawProperties, NoEnergyIsGainedInAClosedCycle) {
  // A smooth random loop of gap and slip, gone round three times. What is put in and not stored at
  // the end has been dissipated; the error of the sum over the steps falls with their number.
  using Law = TypeParam;
  for (int trial = 0; trial < 40; ++trial) {
    const auto p = this->random_parameters();
    const Vec3 normal = this->random_.direction();
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    std::array<double, 9> shape;
    for (double& s : shape) s = this->random_.uniform(-1.0, 1.0);
    const double size = this->kOverlap;
    const auto place = [&](double t) {  // of b relative to a
      const double gap =
          size * (-0.6 + 0.6 * shape[0] * std::sin(t) + 0.3 * shape[1] * std::cos(2 * t));
      const double x =
          size * (shape[2] * std::sin(t) + shape[3] * std::cos(2 * t) + shape[4] * std::sin(3 * t));
      const double y =
          size * (shape[5] * std::cos(t) + shape[6] * std::sin(2 * t) + shape[7] * std::cos(3 * t));
      return Vec3(gap * normal + x * u + y * v);
    };
    const auto excess =
        [&](int steps) {  // J: dissipated or left in the contact, minus what was put in
          typename Law::History history{};
          double work = 0.0;
          double dissipated = 0.0;
          Vec3 last = place(0.0);
          Vec3 last_force = Law::elastic_normal_force(p, last.dot(normal)) * normal;
          const double first_energy = Law::elastic_normal_energy(p, last.dot(normal));
          for (int step = 1; step <= 3 * steps; ++step) {
            const Vec3 now = place(2.0 * std::numbers::pi * step / steps);
            const auto result =
                Law::force(p, this->motion(p, normal, now.dot(normal), now - last), history, 1.0);
            work -= 0.5 * (last_force + result.force).dot(now - last);
            dissipated += result.dissipated;
            last = now;
            last_force = result.force;
          }
          const double stored =
              Law::elastic_normal_energy(p, last.dot(normal)) + Law::history_energy(p, history);
          EXPECT_GE(dissipated, 0.0);
          return stored - first_energy + dissipated - work;
        };
    const double scale = Law::normal_stiffness(p, -size) * size * size;

    EXPECT_NEAR(excess(300), 0.0, 0.02 * scale);
    EXPECT_NEAR(excess(3000), 0.0, 0.0002 * scale);
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
    EXPECT_NEAR(stiffness, Law::normal_stiffness(p, gap), 1e-6 * stiffness);
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
    Law::add_share(inside, history, 0.5);
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

TYPED_TEST(LawProperties, TheHistoryIsNotCarriedToANormalOfTheOtherSide) {
  using Law = TypeParam;
  const auto p = this->random_parameters();
  const Vec3 normal = this->random_.direction();
  const ContactMemory<Law> memory{this->random_history(p, normal), normal};

  EXPECT_EQ(Law::history_energy(p, carried_history<Law>(memory, -normal, 0.1)), 0.0);
  EXPECT_EQ(Law::history_energy(p, carried_history<Law>(ContactMemory<Law>{}, normal, 0.1)), 0.0);
}

TYPED_TEST(LawProperties, SharesOfAHistoryAddUpToIt) {
  using Law = TypeParam;
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = this->random_parameters();
    const Vec3 normal = this->random_.direction();
    const auto whole = this->random_history(p, normal);
    typename Law::History sum{};
    Law::add_share(sum, whole, 0.3);
    Law::add_share(sum, whole, 0.7);

    const Vec3 expected = this->tangential_force(p, normal, whole);
    EXPECT_NEAR((this->tangential_force(p, normal, sum) - expected).norm(), 0.0,
                1e-14 * expected.norm());
  }
}

TEST(LinearFrictional, HasTheStiffnessOfTwoSpringsInSeries) {
  const Material a{1e6, 0.5, 0.4};
  const Material b{3e6, 0.2, 0.3};

  const auto p = LinearFrictional::combine(a, 0.1, b, 0.2);

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
}  // namespace plekton::contact

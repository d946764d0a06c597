// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_table.hpp"

#include "tests/support/contact_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>

namespace plekton::contact::law_table_test {
namespace {

using test::Random;

/// Every law beside its table, on the same random pairs of bodies.
template <class Law>
class LawTableOf : public ::testing::Test {
 protected:
  using Table = LawTable<Law>;
  using Numbers = AnyLaw::Parameters;

  Body random_body() {
    return {{random_.uniform(1e5, 1e8), random_.uniform(0.1, 1.0), random_.uniform(0.2, 1.0),
             random_.uniform(0.0, 0.45)},
            random_.uniform(0.01, 0.1),
            random_.uniform(0.1, 1.0)};
  }
  RelativeMotion random_motion(const typename Law::Parameters& p, double gap) {
    const Vec3 normal = random_.direction();
    return relative_motion(normal, gap, Law::elastic_normal_force(p, gap), random_.in_cube(1.0),
                           random_.in_cube(10.0));
  }

  Random random_{1};
};
/// Those that come with the library, alone, and two with all parts.
using Laws = ::testing::Types<LinearFrictional, HertzMindlin, DmtAdhesion, CohesiveFrictional,
                              WithBoth<HertzMindlin>, WithBoth<CohesiveFrictional>>;
TYPED_TEST_SUITE(LawTableOf, Laws);

/// What the law itself says of parameters, and what their numbers say.
template <class Law>
void expect_the_same(const typename Law::Parameters& p, const AnyLaw::Parameters& numbers,
                     double gap) {
  EXPECT_EQ(AnyLaw::elastic_normal_force(numbers, gap), Law::elastic_normal_force(p, gap));
  EXPECT_EQ(AnyLaw::elastic_normal_energy(numbers, gap), Law::elastic_normal_energy(p, gap));
  EXPECT_EQ(AnyLaw::normal_stiffness(numbers, gap), Law::normal_stiffness(p, gap));
  EXPECT_EQ(AnyLaw::tangential_stiffness(numbers, gap), Law::tangential_stiffness(p, gap));
  EXPECT_EQ(AnyLaw::normal_damping(numbers, gap), Law::normal_damping(p, gap));
  EXPECT_EQ(AnyLaw::interaction_range(numbers), interaction_range_of<Law>(p));
  EXPECT_EQ(AnyLaw::attraction(numbers), Law::attraction(p));
  EXPECT_EQ(AnyLaw::cements(numbers), Law::cements(p));
}

TYPED_TEST(LawTableOf, AnswersAsTheLawDoesForAllThatIsMadeOfItsParameters) {
  using Law = TypeParam;
  for (int trial = 0; trial < 50; ++trial) {
    const Body a = this->random_body(), b = this->random_body();
    const auto properties = test::random_properties<Law>(this->random_);
    const AnyLaw::Properties kept = AnyLaw::of<Law>(properties);
    const auto p = combine<Law>(properties, a, b);
    const AnyLaw::Parameters numbers = AnyLaw::combine(kept, a, b);

    for (const double gap : {-1e-3, -1e-5, 1e-5}) {
      expect_the_same<Law>(p, numbers, gap);
      expect_the_same<Law>(Law::scaled(p, 2.5), AnyLaw::scaled(numbers, 2.5), gap);
      expect_the_same<Law>(Law::without_attraction(p), AnyLaw::without_attraction(numbers), gap);
      expect_the_same<Law>(Law::of_bond(p), AnyLaw::of_bond(numbers), gap);
      expect_the_same<Law>(Law::unbonded_part(p, 0.3), AnyLaw::unbonded_part(numbers, 0.3), gap);
    }
    std::ostringstream problems, expected;
    kept.law->list_problems(kept, problems);
    Law::list_problems(properties, expected);
    EXPECT_EQ(problems.str(), expected.str());
  }
}

TYPED_TEST(LawTableOf, CarriesAHistoryAsTheLawDoes) {
  using Law = TypeParam;
  for (int trial = 0; trial < 50; ++trial) {
    const Body a = this->random_body(), b = this->random_body();
    const auto properties = test::random_properties<Law>(this->random_);
    const auto p = combine<Law>(properties, a, b);
    const AnyLaw::Parameters numbers = AnyLaw::combine(AnyLaw::of<Law>(properties), a, b);
    typename Law::History history{}, other{};
    AnyLaw::History kept{}, kept_other{};
    if (trial % 2 == 0) {
      Law::cement(p, history);
      AnyLaw::cement(numbers, kept);
    }
    for (int step = 0; step < 8; ++step) {
      const double gap = this->random_.uniform(-2e-4, 1e-5);
      const RelativeMotion motion = this->random_motion(p, gap);
      const ContactForce expected = Law::force(p, motion, history, 1e-5);
      const ContactForce found = AnyLaw::force(numbers, motion, kept, 1e-5);
      ASSERT_EQ(found.force, expected.force) << step;
      ASSERT_EQ(found.dissipated, expected.dissipated) << step;
      if (step % 3 == 0) {
        Law::force(p, motion, other, 2e-5);
        AnyLaw::force(numbers, motion, kept_other, 2e-5);
        Law::accumulate_history(history, other, -0.4);
        AnyLaw::accumulate_history(kept, kept_other, -0.4);
      } else if (step % 3 == 1) {
        Law::scale_history(history, 0.7);
        AnyLaw::scale_history(kept, 0.7);
      } else {
        const FrameRotation turn{motion.normal, this->random_.direction(), 0.2};
        Law::rotate(history, turn);
        AnyLaw::rotate(kept, turn);
      }
      ASSERT_EQ(AnyLaw::history_energy(numbers, kept), Law::history_energy(p, history)) << step;
      ASSERT_EQ(AnyLaw::moment(kept, motion.normal), moment_of<Law>(history, motion.normal));
      ASSERT_EQ(AnyLaw::other_force(numbers, motion.normal, kept),
                other_force<Law>(p, motion.normal, history));
      ASSERT_EQ(AnyLaw::holds(kept), holds<Law>(history));
      ASSERT_EQ(AnyLaw::tangential_limit(numbers, 3.0, kept),
                Law::tangential_limit(p, 3.0, history));
    }
  }
}

TYPED_TEST(LawTableOf, TakesTheHistoryOfAnotherLawForANewOne) {
  using Law = TypeParam;
  using Other =
      std::conditional_t<std::is_same_v<Law, HertzMindlin>, LinearFrictional, HertzMindlin>;
  const Body a = this->random_body(), b = this->random_body();
  const auto properties = test::random_properties<Law>(this->random_);
  const auto p = combine<Law>(properties, a, b);
  const AnyLaw::Parameters numbers = AnyLaw::combine(AnyLaw::of<Law>(properties), a, b);
  const AnyLaw::Parameters of_other = AnyLaw::combine(AnyLaw::of<Other>(), a, b);
  const RelativeMotion motion = this->random_motion(p, -1e-4);
  AnyLaw::History foreign{};
  AnyLaw::force(of_other, motion, foreign, 1e-4);
  ASSERT_GT(AnyLaw::history_energy(of_other, foreign), 0.0);

  EXPECT_EQ(AnyLaw::history_energy(numbers, foreign), 0.0);
  AnyLaw::History fresh{}, taken = foreign;
  EXPECT_EQ(AnyLaw::force(numbers, motion, taken, 1e-5).force,
            AnyLaw::force(numbers, motion, fresh, 1e-5).force);
  EXPECT_EQ(taken.law, &LawTable<Law>::functions);
  const double energy = AnyLaw::history_energy(numbers, fresh);
  AnyLaw::accumulate_history(foreign, fresh, 1.0);
  EXPECT_EQ(AnyLaw::history_energy(numbers, foreign), energy) << "nothing of the other is added to";
}

TEST(LawTable, CountsTheNumbersOfATypeUpToTheLastOneInPart) {
  struct Short {
    char a;
  };
  struct Long {
    double a, b;
    char c;
  };

  EXPECT_EQ(LawTable<LinearFrictional>::number_count<Short>(), 1u);
  EXPECT_EQ(LawTable<LinearFrictional>::number_count<double>(), 1u);
  EXPECT_EQ(LawTable<LinearFrictional>::number_count<Long>(), 3u);
  EXPECT_EQ(LawTable<LinearFrictional>::functions.parameter_numbers, 3u);
  EXPECT_EQ(LawTable<LinearFrictional>::functions.history_numbers, 3u);
}

TEST(LawTable, OfAnyLawWithoutAChoiceIsThatOfLinearSprings) {
  const AnyLaw::Properties standard;

  EXPECT_EQ(standard.law, &LawTable<LinearFrictional>::functions);
  EXPECT_EQ(standard.as<LinearFrictional::Properties>(), LinearFrictional::Properties{});
}

}  // namespace
}  // namespace plekton::contact::law_table_test

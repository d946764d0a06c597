// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dashpot.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/rolling_twisting.hpp"
#include "contact/law/sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::contact::list_problems_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Law>
std::string problems_of(const PropertiesOf<Law>& properties) {
  std::ostringstream out;
  Law::list_problems(properties, out);
  return out.str();
}

/// A number among the properties of a law, and what it may be.
template <class Properties>
struct Number {
  const char* name;
  double& (*in)(Properties&);
  bool may_be_infinite;
  const char* advice;
};

constexpr const char* kFinite = "; it must be finite and not negative\n";
constexpr const char* kLimit = "; it must not be negative\n";
constexpr const char* kStiffness =
    " N/m; it must be finite and positive, or 0 for that of the materials\n";

/// Each number alone is what it may be and what it may not; the others are at rest.
template <class Law>
void expect_problems(const std::vector<Number<typename Law::Properties>>& numbers) {
  using Properties = typename Law::Properties;
  std::string all;
  Properties bad;
  for (const auto& number : numbers) {
    const auto problems_with = [&](double value) {
      Properties properties;
      number.in(properties) = value;
      return problems_of<Law>(properties);
    };
    const auto problem = [&](const std::string& value) {
      return std::string(number.name) + " is " + value + number.advice;
    };
    for (const double good : {0.0, 1e-300, 1.0, 1e300}) EXPECT_EQ(problems_with(good), "") << good;
    EXPECT_EQ(problems_with(kInfinity), number.may_be_infinite ? "" : problem("inf"));
    EXPECT_EQ(problems_with(-1e-300), problem("-1e-300"));
    EXPECT_EQ(problems_with(-kInfinity), problem("-inf"));
    EXPECT_EQ(problems_with(std::numeric_limits<double>::quiet_NaN()), problem("nan"));
    number.in(bad) = -2.0;
    all += problem("-2");
  }
  EXPECT_EQ(problems_of<Law>({}), "");
  EXPECT_EQ(problems_of<Law>(bad), all) << "one line for each";
}

TEST(ListProblems, NamesTheStiffnessesOfLinearSprings) {
  using Properties = LinearFrictional::Properties;
  expect_problems<LinearFrictional>(
      {{"normal_stiffness", [](Properties& p) -> double& { return p.normal_stiffness; }, false,
        kStiffness},
       {"tangential_stiffness", [](Properties& p) -> double& { return p.tangential_stiffness; },
        false, kStiffness}});
}

TEST(ListProblems, NamesWhatIsWrongWithBondsAndWithTheirSprings) {
  using Properties = CohesiveFrictional::Properties;
  expect_problems<CohesiveFrictional>(
      {{"normal_stiffness", [](Properties& p) -> double& { return p.elastic.normal_stiffness; },
        false, kStiffness},
       {"tangential_stiffness",
        [](Properties& p) -> double& { return p.elastic.tangential_stiffness; }, false, kStiffness},
       {"tensile_strength", [](Properties& p) -> double& { return p.tensile_strength; }, false,
        kFinite},
       {"shear_strength", [](Properties& p) -> double& { return p.shear_strength; }, true, kLimit},
       {"rupture_distance", [](Properties& p) -> double& { return p.rupture_distance; }, false,
        kFinite}});
}

TEST(ListProblems, NamesTheStiffnessesAndLimitsOfRollingAndTwisting) {
  using Properties = RollingTwisting::Properties;
  expect_problems<RollingTwisting>(
      {{"rolling_stiffness", [](Properties& p) -> double& { return p.rolling_stiffness; }, false,
        kFinite},
       {"twisting_stiffness", [](Properties& p) -> double& { return p.twisting_stiffness; }, false,
        kFinite},
       {"rolling_limit", [](Properties& p) -> double& { return p.rolling_limit; }, true, kLimit},
       {"twisting_limit", [](Properties& p) -> double& { return p.twisting_limit; }, true,
        kLimit}});
}

TEST(ListProblems, NamesAdhesionAndDamping) {
  expect_problems<DmtAdhesion>(
      {{"work_of_adhesion",
        [](DmtAdhesion::Properties& p) -> double& { return p.work_of_adhesion; }, false, kFinite}});
  expect_problems<Dashpot>(
      {{"damping_ratio", [](Dashpot::Properties& p) -> double& { return p.damping_ratio; }, false,
        kFinite}});
}

TEST(ListProblems, OfASumAreThoseOfItsPartsAndOfALawWithoutPropertiesNone) {
  using Law = Sum<Sum<LinearFrictional, RollingTwisting>, Dashpot>;
  Law::Properties properties;
  properties.part.damping_ratio = -1.0;
  properties.whole.part.twisting_limit = -2.0;
  properties.whole.whole.normal_stiffness = -3.0;

  EXPECT_EQ(problems_of<Law>(properties), std::string("normal_stiffness is -3") + kStiffness +
                                              "twisting_limit is -2" + kLimit +
                                              "damping_ratio is -1" + kFinite);
  EXPECT_EQ(problems_of<HertzMindlin>({}), "");
}

}  // namespace
}  // namespace plekton::contact::list_problems_test

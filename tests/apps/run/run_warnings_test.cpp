// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace plekton::apps::run_warnings_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(RunWarnings, AreNoneForASoundRun) {
  RunReport report;
  report.largest_overlap_ratio = 0.02;
  report.energy_closure = 0.005;
  report.largest_motion_ratio = dynamics::kLargestMotion * (1.0 + 1e-15);  // chosen to be this

  EXPECT_THAT(warnings_about(report), IsEmpty());
}

TEST(RunWarnings, NameAStepThatIsTooLongForTheMotion) {
  RunReport report;
  report.largest_motion_ratio = 0.4;

  EXPECT_THAT(warnings_about(report),
              ElementsAre(AllOf(HasSubstr("by 40 % of the smallest radius in one step, above 10 %"),
                                HasSubstr("0.25 of this"))));
}

// "run with 1 of this simulation.time_step"
TEST(RunWarnings, NeverAdviseTheStepThatThereWas) {
  RunReport report;
  report.largest_motion_ratio = 1.0001 * kFastMotion;
  EXPECT_THAT(warnings_about(report), ElementsAre(HasSubstr("run with 0.99 of this")));

  report.largest_motion_ratio = 30.0;
  EXPECT_THAT(warnings_about(report), ElementsAre(HasSubstr("run with 0.0033 of this")));
}

TEST(RunWarnings, DoNotAdviseToHaveAStepChosenThatWas) {
  RunReport report;
  report.largest_motion_ratio = 0.4;
  report.chose_time_step = true;
  EXPECT_THAT(warnings_about(report),
              ElementsAre(AllOf(HasSubstr("give simulation.time_step, 0.25 of what it was then"),
                                testing::Not(HasSubstr("auto")))));
}

TEST(RunWarnings, NameDeepOverlapsEnergyThatDoesNotAddUpAndLostGrains) {
  RunReport report;
  report.largest_overlap_ratio = 11.3;
  report.energy_closure = 0.91;
  report.lost_grains = 20;
  report.lost_through_membranes = 4;
  report.lost_out_of_bounds = 17;  // one did both

  EXPECT_THAT(warnings_about(report),
              ElementsAre(HasSubstr("1.13e+03 % of a radius"), HasSubstr("off by 91 %"),
                          HasSubstr("20 grains are lost: 4 passed through")));
}

TEST(RunWarnings, CountOneLostGrainInTheSingular) {
  RunReport report;
  report.lost_grains = report.lost_out_of_bounds = 1;

  EXPECT_THAT(warnings_about(report), ElementsAre(HasSubstr("1 grain is lost: 0 passed")));
}

TEST(RunWarnings, NameEnergyThatTrackingMadeOrLost) {
  RunReport report;
  report.tracking_ratio = 0.9e-3;
  EXPECT_TRUE(warnings_about(report).empty());

  report.tracking_ratio = 0.03;
  report.energy.tracking = 2.0;
  EXPECT_THAT(warnings_about(report),
              ElementsAre(AllOf(HasSubstr("3 % of the energy"), HasSubstr("was lost"))));

  report.energy.tracking = -2.0;
  EXPECT_THAT(warnings_about(report), ElementsAre(HasSubstr("was made")));
}

TEST(RunWarnings, NameEnergyThatDoesNotAddUpWhereNegativePartsOutweighTheRest) {
  RunReport report;
  report.energy.kinetic = 1.0;
  report.energy.friction = -3.0;
  report.energy_closure = report.energy.closure();

  EXPECT_THAT(warnings_about(report), ElementsAre(HasSubstr("off by 50 %")));
}

TEST(RunWarnings, NameMomentumThatWasMadeFromNothing) {
  RunReport report;
  report.momentum = {1e-16, 0.9e-10};
  EXPECT_TRUE(warnings_about(report).empty());

  report.momentum.angular = 3e-7;
  EXPECT_THAT(warnings_about(report),
              ElementsAre(AllOf(HasSubstr("made momentum from nothing"), HasSubstr("3e-07"))));
}

TEST(RunWarnings, NameDegeneratePlacesByTheStepsOfThisPartOfTheRun) {
  RunReport report;
  report.nodes = 10;
  report.steps = 1000;
  report.resumed_step = 900;
  report.exact_decisions = {.double_double = 99999, .interval = 5000, .exact = 1000};
  EXPECT_TRUE(warnings_about(report).empty());  // 1 for each node and step

  report.exact_decisions.exact = 2000;
  EXPECT_THAT(warnings_about(report),
              ElementsAre(AllOf(HasSubstr("2000 times, 2 for each"), HasSubstr("shift or turn"))));
}

TEST(Certificate, IsGreenForASoundRunAndSaysSo) {
  const std::vector<Check> certificate = certificate_of(RunReport());

  EXPECT_FALSE(has_red(certificate));
  EXPECT_EQ(summary_of(certificate), "certificate: 12 of 12 green");
}

TEST(Certificate, NamesWhatIsRedWithValueAndLimit) {
  RunReport report;
  report.largest_overlap_ratio = 0.0623;
  report.lost_grains = 3;
  const std::vector<Check> certificate = certificate_of(report);

  EXPECT_TRUE(has_red(certificate));
  EXPECT_EQ(summary_of(certificate),
            "certificate: 10 of 12 green; red: largest_overlap_ratio 6.23 % (at most 5 %), "
            "lost_grains 3 (at most 0)");
  EXPECT_EQ(warnings_about(report).size(), 2U);
}

// It said to leave out what had not been given.
TEST(Certificate, AsksForAGivenStepWhereTheChosenOneWasTooLong) {
  RunReport report;
  report.dt_over_critical = 1.3;
  const auto advice = [&] {
    for (const Check& check : certificate_of(report))
      if (check.name == "dt_over_critical") return check.advice;
    return std::string();
  };

  EXPECT_THAT(advice(), HasSubstr("run with a smaller one, or with none"));
  report.chose_time_step = true;
  EXPECT_THAT(advice(), HasSubstr("give simulation.time_step, 0.5 of what it was"));  // 0.65 / 1.3
}

TEST(Certificate, IsRedWhereAValueIsNoNumber) {
  RunReport report;
  report.energy_closure = std::numeric_limits<double>::quiet_NaN();

  EXPECT_TRUE(has_red(certificate_of(report)));
}

}  // namespace
}  // namespace plekton::apps::run_warnings_test

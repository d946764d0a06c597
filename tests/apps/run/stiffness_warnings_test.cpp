// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stiffness_warnings.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::stiffness_warnings_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Grains of the first material and a plane of the second.
Scenario scenario_of(double first, double second) {
  Scenario scenario;
  scenario.materials = {{"rock", 2650.0, first}, {"floor", std::nullopt, second}};
  scenario.grains.emplace_back();
  scenario.planes.emplace_back();
  scenario.planes.front().material = 1;
  return scenario;
}

TEST(StiffnessWarnings, AreNoneForSteelOnRubber) {
  EXPECT_THAT(warnings_about_stiffness(scenario_of(2e11, 2e6), {}), IsEmpty());
}

TEST(StiffnessWarnings, NameTheStiffestAndTheSoftest) {
  EXPECT_THAT(warnings_about_stiffness(scenario_of(2e5, 2e11), {}),
              ElementsAre(AllOf(HasSubstr("materials.floor with E = 2e+11 Pa is 1e+06 times"),
                                HasSubstr("materials.rock with 2e+05 Pa"))));
}

TEST(StiffnessWarnings, CountMembranesAndNoMaterialThatNothingHas) {
  Scenario scenario = scenario_of(1e7, 1e7);
  scenario.materials.push_back({"unused", std::nullopt, 1.0});
  EXPECT_THAT(warnings_about_stiffness(scenario, {}), IsEmpty());

  BuiltScene built;
  built.membranes.emplace_back();
  built.membranes.front().name = "net";
  built.membranes.front().young_modulus = 1e13;
  EXPECT_THAT(warnings_about_stiffness(scenario, built),
              ElementsAre(HasSubstr("membranes.net with E = 1e+13 Pa")));
}

TEST(StiffnessWarnings, LeaveTheSurfacesOfRigidBodiesOut) {
  BuiltScene built;
  built.membranes.emplace_back();
  built.membranes.front().is_rigid = true;  // has no modulus

  EXPECT_THAT(warnings_about_stiffness(scenario_of(1e7, 1e7), built), IsEmpty());
}

TEST(StiffnessWarnings, NameTangentialStiffnessesFarAboveTheNormalOnes) {
  Scenario scenario = scenario_of(1e7, 1e7);
  scenario.materials[1].stiffness_ratio = 1.0;
  EXPECT_THAT(warnings_about_stiffness(scenario, {}), IsEmpty());

  scenario.materials[1].stiffness_ratio = 1e6;
  scenario.contacts.emplace_back();
  scenario.contacts.front().contact.springs = {1e4, 1e7};
  EXPECT_THAT(warnings_about_stiffness(scenario, {}),
              ElementsAre(HasSubstr("materials.floor.stiffness_ratio: the tangential stiffness is "
                                    "1e+06 times"),
                          HasSubstr("contacts[0].tangential_stiffness: the tangential stiffness is "
                                    "1e+03 times")));
}

}  // namespace
}  // namespace plekton::apps::stiffness_warnings_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/unit_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::unit_warnings_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scenario with_density(double density) {
  Scenario scenario;
  MaterialSettings material;
  material.name = "soil";
  material.density = density;
  scenario.materials.push_back(material);
  return scenario;
}

TEST(UnitWarnings, TakeDensitiesOfGramsForASlip) {
  EXPECT_THAT(warnings_about_units(with_density(2.65)),
              ElementsAre(AllOf(HasSubstr("materials.soil.density: 2.65 kg/m3 is lighter"),
                                HasSubstr("check its unit"))));
  EXPECT_THAT(warnings_about_units(with_density(2.65e6)), ElementsAre(HasSubstr("heavier")));
}

TEST(UnitWarnings, TakeAGravityInMillimetresForASlip) {
  Scenario scenario;
  scenario.simulation.gravity = Vec3(0.0, 0.0, -9810.0);

  EXPECT_THAT(warnings_about_units(scenario),
              ElementsAre(HasSubstr("simulation.gravity: 9810 m/s2 is 1e+03 times")));
}

TEST(UnitWarnings, AreNoneOfFoamAndOsmiumInACentrifuge) {
  for (const double density : {15.0, 22590.0}) {
    Scenario scenario = with_density(density);
    scenario.simulation.gravity = Vec3(0.0, 0.0, -4900.0);

    EXPECT_THAT(warnings_about_units(scenario), IsEmpty()) << density;
  }
}

}  // namespace
}  // namespace plekton::apps::unit_warnings_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/refused_self_contact.hpp"

#include <gtest/gtest.h>

#include <string>

namespace plekton::apps::refused_self_contact_test {
namespace {

TEST(RefusedSelfContact, PointsToTheMembraneWhoseEdgesAreShortestAgainstItsThickness) {
  Scenario scenario;
  scenario.membranes.resize(2);
  scenario.membranes[0].name = "net";
  scenario.membranes[0].thickness = 0.01;
  scenario.membranes[0].source_place = {"case.toml", 3, 1};
  scenario.membranes[1].name = "sheet";
  scenario.membranes[1].thickness = 0.002;
  scenario.membranes[1].source_place = {"case.toml", 9, 8};
  std::vector<BuiltMembrane> built(2);
  built[0].mean_edge = 0.1;     // ten thicknesses
  built[1].mean_edge = 0.0002;  // a tenth of one

  const InputError error = refused_self_contact(scenario, built, "too many pairs");

  EXPECT_EQ(std::string(error.what()), "case.toml:9:8: membranes.sheet: too many pairs");
}

}  // namespace
}  // namespace plekton::apps::refused_self_contact_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/laws/law_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace plekton::contact {
namespace {

TEST(LawList, NamesEveryLawAndParameterOnceAndSaysWhatItIs) {
  std::set<std::string_view> names;
  const auto take = [&](const LawParameter& parameter) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.what.empty()) << parameter.name;
  };
  for (const LawRow& law : contact_laws()) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_FALSE(law.what.empty()) << law.name;
    for (const LawParameter& parameter : law.parameters) take(parameter);
  }
  for (const LawParameter& parameter : common_law_parameters()) take(parameter);
}

TEST(LawList, HasTheDefaultsThatSettingsHave) {
  ContactSettings settings;
  for (const LawRow& law : contact_laws()) {
    for (const LawParameter& parameter : law.parameters)
      EXPECT_EQ(parameter.in(settings), parameter.standard) << parameter.name;
  }
  for (const LawParameter& parameter : common_law_parameters())
    EXPECT_EQ(parameter.in(settings), parameter.standard) << parameter.name;
}

TEST(LawList, GivesEachNameItsLaw) {
  const Body body{{1e7, 0.3, 0.5, 0.25}, 0.01, 1.0};
  const auto force_of = [&](std::string_view name) {
    ContactSettings settings;
    while (contact_laws()[settings.law].name != name) ++settings.law;
    const auto p = AnyLaw::combine(properties_of(settings), body, body);
    return AnyLaw::elastic_normal_force(p, -1e-4);
  };
  const double linear =
      LinearFrictional::elastic_normal_force(LinearFrictional::combine(body, body), -1e-4);
  const double hertz = HertzMindlin::elastic_normal_force(HertzMindlin::combine(body, body), -1e-4);

  EXPECT_EQ(force_of("linear_frictional"), linear);
  EXPECT_EQ(force_of("cohesive_frictional"), linear);
  EXPECT_EQ(force_of("hertz_mindlin"), hertz);
  EXPECT_EQ(force_of("dmt_adhesion"), hertz);
}

}  // namespace
}  // namespace plekton::contact

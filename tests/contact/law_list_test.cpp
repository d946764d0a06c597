// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_list.hpp"

#include "contact/law_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace plekton::contact::law_list_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A parameter of several laws, as those of linear springs, is one and the same.
TEST(LawList, NamesEveryLawAndParameterOnceAndSaysWhatItIs) {
  ContactSettings settings;
  std::set<std::string_view> laws;
  std::map<std::string_view, const double*> places;
  const auto take = [&](const LawParameter& parameter, std::set<std::string_view>& names) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.what.empty()) << parameter.name;
    const double* const place = &parameter.in(settings);
    EXPECT_EQ(places.try_emplace(parameter.name, place).first->second, place) << parameter.name;
  };
  for (const LawEntry& law : contact_laws()) {
    EXPECT_TRUE(laws.insert(law.name).second) << law.name;
    EXPECT_FALSE(law.what.empty()) << law.name;
    std::set<std::string_view> names;
    for (const LawParameter& parameter : law.parameters) take(parameter, names);
    for (const LawParameter& parameter : common_law_parameters()) take(parameter, names);
  }
}

TEST(LawList, HasTheDefaultsThatSettingsHave) {
  ContactSettings settings;
  for (const LawEntry& law : contact_laws()) {
    for (const LawParameter& parameter : law.parameters)
      EXPECT_EQ(parameter.in(settings), parameter.standard) << parameter.name;
  }
  for (const LawParameter& parameter : common_law_parameters())
    EXPECT_EQ(parameter.in(settings), parameter.standard) << parameter.name;
}

TEST(LawList, GivesLinearSpringsTheStiffnessOfThePair) {
  const Body body{{1e7, 0.3, 0.5, 0.25}, 0.01, 1.0};
  for (const std::string_view name : {"linear_frictional", "cohesive_frictional"}) {
    ContactSettings settings;
    while (contact_laws()[settings.law].name != name) ++settings.law;
    for (const LawParameter& parameter : contact_laws()[settings.law].parameters)
      if (parameter.name == "normal_stiffness") parameter.in(settings) = 3e4;

    const auto p = AnyLaw::combine(properties_of(settings), body, body);

    EXPECT_DOUBLE_EQ(AnyLaw::normal_stiffness(p, -1e-5), 3e4) << name;
    EXPECT_DOUBLE_EQ(AnyLaw::tangential_stiffness(p, -1e-5), 0.9e4) << name;
  }
}

TEST(LawList, KnowsWhichPairsHaveLinearSpringsAlone) {
  ContactSettings settings;
  settings.springs.normal_stiffness = 3e4;
  const auto linear_alone = [](const ContactSettings& of) {
    return properties_of(of).law == &LawTable<LinearFrictional>::functions;
  };
  ASSERT_TRUE(linear_alone(settings));
  EXPECT_EQ(properties_of(settings).as<LinearFrictional::Properties>().normal_stiffness, 3e4);

  ContactSettings damped = settings;
  damped.restitution = 0.9;
  ContactSettings rolling = settings;
  rolling.rolling.rolling_stiffness = 0.1;
  ContactSettings twisting = settings;
  twisting.rolling.twisting_stiffness = 0.1;
  ContactSettings other = settings;
  other.law = 1;
  for (const ContactSettings& more : {damped, rolling, twisting, other})
    EXPECT_FALSE(linear_alone(more));
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

TEST(LawList, RefusesALawOrARestitutionThatThereIsNot) {
  ContactSettings settings;
  settings.law = 99;
  EXPECT_THAT([&] { properties_of(settings); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("there is no law 99, only 4 laws")));
  EXPECT_THAT([&] { bonds_of(settings); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("there is no law 99, only 4 laws")));

  settings.law = 0;
  for (const double restitution : {0.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
    settings.restitution = restitution;
    EXPECT_THAT([&] { properties_of(settings); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("it must be above 0 and at most 1")))
        << restitution;
  }
}

}  // namespace
}  // namespace plekton::contact::law_list_test

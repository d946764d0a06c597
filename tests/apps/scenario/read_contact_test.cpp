// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/scenario_reader.hpp"

#include <gtest/gtest.h>

#include <string>

namespace plekton::apps::read_contact_test {
namespace {

std::string scenario_with(const std::string& contacts) {
  return R"([simulation]
duration = "1 s"
[materials.soil]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
poisson_ratio = 0.2
[materials.steel]
young_modulus = "1 GPa"
friction_angle = "20 deg"
[[grains]]
material = "soil"
count = 1
radius = "1 cm"
box = { min = [0, 0, 0], max = [1, 1, 1] }
)" + contacts;
}

std::vector<PairSettings> read(const std::string& contacts) {
  return parse_scenario(scenario_with(contacts), "test.toml", {}).contacts;
}

/// The message, or nothing.
std::string complaint(const std::string& contacts) {
  try {
    read(contacts);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ReadContact, HasTheLawAndTheParametersOfAPair) {
  const auto pairs = read(R"([[contacts]]
between = "steel"
and = "soil"
law = "cohesive_frictional"
tensile_strength = "20 kPa"
rupture_distance = "0.1 mm"
bonds = "start"
rolling_stiffness = 0.3
restitution = 0.5
)");

  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 0u);
  EXPECT_EQ(pairs[0].second, 1u);
  const contact::ContactSettings& settings = pairs[0].contact;
  EXPECT_EQ(contact::contact_laws()[settings.law].name, "cohesive_frictional");
  EXPECT_EQ(settings.cohesion.tensile_strength, 2e4);
  EXPECT_DOUBLE_EQ(settings.cohesion.rupture_distance, 1e-4);
  EXPECT_EQ(settings.cohesion.shear_strength, 0.0);
  EXPECT_EQ(settings.cohesion.bonds, contact::Bonds::at_start);
  EXPECT_EQ(settings.rolling.rolling_stiffness, 0.3);
  EXPECT_EQ(settings.restitution, 0.5);
}

TEST(ReadContact, HasTheStiffnessThatAPairIsGiven) {
  const auto pairs = read(R"([[contacts]]
between = "steel"
and = "soil"
normal_stiffness = "20 kN/m"
tangential_stiffness = "5 N/mm"
[[contacts]]
between = "soil"
and = "soil"
law = "cohesive_frictional"
stiffness_radius = "curvature"
)");

  ASSERT_EQ(pairs.size(), 2u);
  using Radius = contact::LinearFrictional::StiffnessRadius;
  EXPECT_DOUBLE_EQ(pairs[0].contact.springs.normal_stiffness, 2e4);
  EXPECT_DOUBLE_EQ(pairs[0].contact.springs.tangential_stiffness, 5e3);
  EXPECT_EQ(pairs[0].contact.springs.radius, Radius::half_thickness);
  EXPECT_EQ(pairs[1].contact.springs.normal_stiffness, 0.0);
  EXPECT_EQ(pairs[1].contact.springs.radius, Radius::curvature);
}

TEST(ReadContact, RefusesAStiffnessThatIsNoneOrGoesWithAnotherLaw) {
  const std::string pair = "[[contacts]]\nbetween = \"soil\"\nand = \"soil\"\n";

  EXPECT_NE(complaint(pair + "normal_stiffness = 0\n")
                .find("above 0, or no such key for that of the materials"),
            std::string::npos);
  const std::string other =
      complaint(pair + "law = \"hertz_mindlin\"\nnormal_stiffness = \"1 kN/m\"\n");
  EXPECT_NE(other.find("goes with law = \"linear_frictional\" or \"cohesive_frictional\", but"),
            std::string::npos)
      << other;
  EXPECT_EQ(other.find('\n'), std::string::npos) << other;
  const std::string twice =
      complaint(pair + "normal_stiffness = \"1 kN/m\"\nstiffness_radius = \"curvature\"\n");
  EXPECT_NE(twice.find("leave one of them out"), std::string::npos) << twice;
}

TEST(ReadContact, SaysWhatIsWrongAndWhere) {
  const std::string pair = "[[contacts]]\nbetween = \"soil\"\nand = \"soil\"\n";

  EXPECT_NE(complaint(pair + "law = \"hertz\"\n").find("hertz_mindlin"), std::string::npos);
  EXPECT_NE(complaint(pair + "rolling_limit = -0.1\n").find("of at least 0"), std::string::npos);
  EXPECT_NE(complaint(pair + "restitution = 0\n").find("above 0 and at most 1"), std::string::npos);
  EXPECT_NE(complaint(pair + "work_of_adhesion = \"1 J/m2\"\n").find("work_of_adhesion"),
            std::string::npos);  // of another law
  EXPECT_NE(complaint(pair + "bonds = \"new\"\n").find("goes with law = \"cohesive_frictional\""),
            std::string::npos);
  EXPECT_NE(complaint(pair + "law = \"cohesive_frictional\"\nbonds = \"later\"\n").find("start"),
            std::string::npos);
  EXPECT_NE(complaint("[[contacts]]\nbetween = \"soil\"\nand = \"stel\"\n")
                .find("did you mean \"steel\"?"),
            std::string::npos);
  const std::string unknown =
      complaint(pair + "law = \"jkr\"\nwork_of_adhesion = \"1 J/m2\"\ntensile_strength = 1\n");
  EXPECT_NE(unknown.find("got \"jkr\"; expected one of"), std::string::npos) << unknown;
  EXPECT_EQ(unknown.find('\n'), std::string::npos) << unknown;
  const std::string twice = complaint(pair + pair);
  EXPECT_NE(twice.find("already"), std::string::npos);
  EXPECT_NE(twice.find("test.toml:21"), std::string::npos) << twice;
}

}  // namespace
}  // namespace plekton::apps::read_contact_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/with_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::contact::models_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr MaterialId kStone{0};

/// What is said of a model with some materials, or nothing.
std::string problems_of(const ContactModel& model,
                        const std::vector<Material>& materials = {Material{1e6, 0.5, 0.4}}) {
  const geometry::Surface surface;
  try {
    model({.spheres = {},
           .surface = surface,
           .materials = materials,
           .of_spheres = {},
           .of_structures = {},
           .masses = {},
           .skin = 0.05,
           .meets_planes = {},
           .rest = {}});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Models, FindNothingWrongWithWhatIsNot) {
  EXPECT_EQ(problems_of(linear_frictional()), "");
  EXPECT_EQ(problems_of(linear_frictional({{{kStone, kStone}, {.normal_stiffness = 1e4}}})), "");
  EXPECT_EQ(problems_of(model_of<HertzMindlin>()), "");
  EXPECT_EQ(problems_of(any_law({}, with_parts<CohesiveFrictional>({}, {}, {0.1}))), "");
}

TEST(Models, RefuseNumbersOutOfTheirRangesWithTheLawAndThePair) {
  for (const double stiffness : {-5.0, kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(
        problems_of(linear_frictional({{{kStone, kStone}, {.normal_stiffness = stiffness}}})),
        HasSubstr("materials 0 and 0 as a pair, law linear_frictional: normal_stiffness is"));
    EXPECT_THAT(
        problems_of(linear_frictional({{{kStone, kStone}, {.tangential_stiffness = stiffness}}})),
        HasSubstr("tangential_stiffness is"));
  }
  EXPECT_THAT(
      problems_of(any_law(
          {}, with_parts<CohesiveFrictional>(
                  {.tensile_strength = -1.0, .shear_strength = kNan, .rupture_distance = -2.0},
                  {.rolling_stiffness = kNan, .twisting_limit = -3.0}, {-0.5}))),
      AllOf(HasSubstr("pairs of materials, law cohesive_frictional"),
            HasSubstr("tensile_strength is -1; it must be finite and not negative"),
            HasSubstr("shear_strength is nan"), HasSubstr("rupture_distance is -2"),
            HasSubstr("rolling_stiffness is nan"), HasSubstr("twisting_limit is -3"),
            HasSubstr("damping_ratio is -0.5; it must be finite and not negative")));
  EXPECT_THAT(problems_of(any_law({}, with_parts<DmtAdhesion>({kNan}, {}, {}))),
              HasSubstr("work_of_adhesion is nan"));
}

TEST(Models, RefusePairsOfMaterialsThatAreNone) {
  EXPECT_THAT(problems_of(linear_frictional({{{kStone, MaterialId{7}}, {}}})),
              HasSubstr("materials 0 and 7 as a pair: there is no material 7, only 1 materials"));
  EXPECT_THAT(problems_of(linear_frictional({{{kStone, MaterialId{-1}}, {}}})),
              HasSubstr("there is no material -1"));
}

TEST(Models, RefuseAPairThatIsGivenInBothOrders) {
  const auto given = [](MaterialId a, MaterialId b) {
    return linear_frictional({{{a, b}, {}}, {{b, a}, {.normal_stiffness = 1e4}}});
  };
  EXPECT_THAT(problems_of(given(MaterialId{0}, MaterialId{1})),
              HasSubstr("materials 1 and 0 as a pair: given in both orders"));
}

TEST(Models, RefuseALawThatIsNone) {
  AnyLaw::Properties none;
  none.law = nullptr;

  EXPECT_THAT(problems_of(any_law({}, none)), HasSubstr("pairs of materials: there is no law"));
  EXPECT_THAT(problems_of(any_law({{{kStone, kStone}, none}})),
              HasSubstr("materials 0 and 0 as a pair: there is no law"));
}

struct WithoutStiffness : HertzMindlin {
  static constexpr std::string_view name = "without_stiffness";
  static double normal_stiffness(const Parameters&, double) { return kNan; }
};

struct CountingStiffness : HertzMindlin {
  static constexpr std::string_view name = "counting_stiffness";
  static inline std::size_t count = 0;
  static double normal_stiffness(const Parameters& p, double gap) {
    ++count;
    return HertzMindlin::normal_stiffness(p, gap);
  }
};

// 100 000 materials would take minutes if all pairs were asked.
TEST(Models, AskForEachOfManyMaterialsAFewTimes) {
  std::vector<Material> materials(1000, Material{1e6, 0.5, 0.4});
  for (std::size_t i = 0; i < materials.size(); ++i) materials[i].young_modulus += double(i);

  EXPECT_EQ(problems_of(model_of<CountingStiffness>(), materials), "");

  EXPECT_GE(CountingStiffness::count, materials.size());
  EXPECT_LE(CountingStiffness::count, 10 * materials.size());
}

TEST(Models, NameALawWhoseStiffnessIsNotFinite) {
  EXPECT_THAT(problems_of(model_of<WithoutStiffness>()),
              AllOf(HasSubstr("materials 0 and 0, law without_stiffness:"),
                    HasSubstr("the normal stiffness nan N/m")));
}

}  // namespace
}  // namespace plekton::contact::models_test

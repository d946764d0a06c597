// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/linear_frictional.hpp"

#include "contact/law/cohesive_frictional.hpp"

#include <gtest/gtest.h>

namespace plekton::contact::linear_frictional_test {
namespace {

using Parameters = LinearFrictional::Parameters;
using Properties = LinearFrictional::Properties;
using StiffnessRadius = LinearFrictional::StiffnessRadius;

constexpr double kModulus = 1e7;  // Pa
const Material kMaterial{kModulus, 0.3, 0.5};
const Body kGrain{kMaterial, 0.01};
const Body kPlane{.material = kMaterial, .radius = 0.01, .shape = Shape::flat};
const Body kSheet{.material = kMaterial, .radius = 0.001, .shape = Shape::flat};
const Body kBar{.material = kMaterial, .radius = 0.001, .shape = Shape::cylinder};

void expect_stiffness(const Parameters& p, double normal, double tangential) {
  EXPECT_NEAR(p.normal_stiffness, normal, 1e-14 * normal);
  EXPECT_NEAR(p.tangential_stiffness, tangential, 1e-14 * normal);
}

/// S9: E R of both sides in series, 2 E R h / (R + h).
TEST(LinearFrictional, TakesAThinSheetAsSoftAsAGrainOfHalfItsThickness) {
  const double in_series = 2.0 * kModulus * 0.01 * 0.001 / 0.011;  // 1.8e4 N/m

  expect_stiffness(LinearFrictional::combine(kGrain, kPlane), 1e5, 0.3e5);
  expect_stiffness(LinearFrictional::combine(kGrain, kSheet), in_series, 0.3 * in_series);
  expect_stiffness(LinearFrictional::combine(kGrain, kBar), in_series, 0.3 * in_series);
}

TEST(LinearFrictional, TakesASheetAsAPlaneIfItsCurvatureIsToCount) {
  const Properties curvature{.radius = StiffnessRadius::curvature};
  const double in_series = 2.0 * kModulus * 0.01 * 0.001 / 0.011;

  expect_stiffness(LinearFrictional::combine(curvature, kGrain, kPlane), 1e5, 0.3e5);
  expect_stiffness(LinearFrictional::combine(curvature, kGrain, kSheet), 1e5, 0.3e5);
  expect_stiffness(LinearFrictional::combine(curvature, kSheet, kGrain), 1e5, 0.3e5);
  expect_stiffness(LinearFrictional::combine(curvature, kGrain, kBar), in_series, 0.3 * in_series);
  expect_stiffness(LinearFrictional::combine(curvature, kSheet, kSheet), 1e4, 0.3e4);
  expect_stiffness(LinearFrictional::combine(curvature, kSheet, kBar), 1e4, 0.3e4);
}

TEST(LinearFrictional, TakesTheStiffnessThatAPairIsGiven) {
  const Properties both{.normal_stiffness = 5e4, .tangential_stiffness = 2e4};
  for (const Body& other : {kGrain, kPlane, kSheet, kBar}) {
    const Parameters p = LinearFrictional::combine(both, kGrain, other);
    EXPECT_EQ(p.normal_stiffness, 5e4);
    EXPECT_EQ(p.tangential_stiffness, 2e4);
    EXPECT_EQ(p.friction, 0.5);
  }

  expect_stiffness(LinearFrictional::combine({.normal_stiffness = 5e4}, kGrain, kSheet), 5e4,
                   1.5e4);
  expect_stiffness(LinearFrictional::combine({.tangential_stiffness = 7e3}, kGrain, kPlane), 1e5,
                   7e3);
}

TEST(LinearFrictional, GivesBondsTheStiffnessOfThePairToo) {
  CohesiveFrictional::Properties properties{2e4, 3e4, 0.0};
  properties.elastic = {.normal_stiffness = 5e4, .tangential_stiffness = 2e4};

  const auto p = CohesiveFrictional::combine(properties, kGrain, kSheet);

  EXPECT_EQ(p.elastic.normal_stiffness, 5e4);
  EXPECT_EQ(p.elastic.tangential_stiffness, 2e4);
  EXPECT_DOUBLE_EQ(CohesiveFrictional::interaction_range(p), 2e4 * 0.001 * 0.001 / 5e4);
}

}  // namespace
}  // namespace plekton::contact::linear_frictional_test

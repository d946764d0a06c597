// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/material_pairs.hpp"

#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law_table.hpp"

#include <gtest/gtest.h>

namespace plekton::contact::material_pairs_test {
namespace {

MaterialPairs pairs(const AnyLaw::Properties& properties) {
  return MaterialPairs({{1e7, 0.5, 0.5}}, {{{MaterialId{0}, MaterialId{0}}, properties}});
}

// It was asked for of two spheres in the first step alone, which say nothing of these.
TEST(MaterialPairs, HaveAnotherHashWhereTheLawIsAnotherOnFlatBodiesOrAfterTheFirstStep) {
  LinearFrictional::Properties flat;
  flat.radius = LinearFrictional::StiffnessRadius::curvature;
  EXPECT_NE(pairs(AnyLaw::of<LinearFrictional>(flat)).hash(),
            pairs(AnyLaw::of<LinearFrictional>()).hash());

  CohesiveFrictional::Properties glue;
  glue.tensile_strength = 1e5;
  CohesiveFrictional::Properties at_start = glue;
  at_start.bonds = Bonds::at_start;
  EXPECT_NE(pairs(AnyLaw::of<CohesiveFrictional>(at_start)).hash(),
            pairs(AnyLaw::of<CohesiveFrictional>(glue)).hash());
  EXPECT_EQ(pairs(AnyLaw::of<CohesiveFrictional>(glue)).hash(),
            pairs(AnyLaw::of<CohesiveFrictional>(glue)).hash());
}

}  // namespace
}  // namespace plekton::contact::material_pairs_test

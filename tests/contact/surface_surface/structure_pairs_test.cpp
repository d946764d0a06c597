// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_pairs.hpp"

#include "contact/law/cohesive_frictional.hpp"
#include "contact/law_table.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace plekton::contact::structure::structure_pairs_test {
namespace {

using geometry::NodeId;

/// Bars side by side, each a structure, thicker one after the other.
struct Bars {
  explicit Bars(int count) : materials{MaterialPairs({{1e7, 0.5, 0.5}}), {}, {}} {
    for (int i = 0; i < count; ++i)
      cylinders.push_back({{NodeId{2 * i}, NodeId{2 * i + 1}}, 1e-3 * (i + 1)});
    surface = geometry::Surface(cylinders, {}, 2 * cylinders.size());
    materials.of_structures.assign(cylinders.size(), MaterialId{0});
  }

  std::vector<geometry::Cylinder> cylinders;
  geometry::Surface surface{{}, {}, 0};
  ContactMaterials materials;
};

TEST(StructurePairs, AreMadeWhenTheyAreAskedForAndStayWhereTheyAre) {
  const Bars bars(20000);  // of which all pairs would be 200 million
  StructurePairs pairs;
  pairs.know_structures(bars.surface, bars.materials);
  EXPECT_EQ(pairs.size(), 0U);

  const std::uint32_t place = pairs.place_of(1, 3, bars.materials.pairs);
  const StructurePair* const pair = &pairs[place];
  for (int i = 1; i < 1000; ++i) pairs.place_of(i - 1, i, bars.materials.pairs);

  EXPECT_EQ(pairs.place_of(1, 3, bars.materials.pairs), place);
  EXPECT_EQ(pairs.place_of(1, 3), place);
  EXPECT_EQ(&pairs[place], pair);
  EXPECT_EQ(pair->radius_first, 2e-3);
  EXPECT_EQ(pair->radius_second, 4e-3);
  EXPECT_EQ(pairs.springs()[place].range(), 2e-3 + 4e-3);
  EXPECT_EQ(pairs.size(), 1000U);
  EXPECT_THROW(pairs.place_of(0, 5), std::out_of_range);
}

TEST(StructurePairs, TakeOtherParameters) {
  Bars bars(2);
  StructurePairs pairs;
  pairs.know_structures(bars.surface, bars.materials);
  const std::uint32_t place = pairs.place_of(0, 1, bars.materials.pairs);
  const double before = pairs.springs()[place].force(2e-3);

  bars.materials.pairs = MaterialPairs({{3e7, 0.5, 0.5}});
  pairs.take_parameters(bars.surface, bars.materials);

  EXPECT_NEAR(pairs.springs()[place].force(2e-3), 3.0 * before, 1e-12 * before);
}

TEST(StructurePairs, GlueWhereOneThatIsThereDoes) {
  Bars bars(3);
  bars.materials.of_structures[2] = MaterialId{1};
  CohesiveFrictional::Properties glue;
  glue.tensile_strength = 1e5;
  bars.materials.pairs =
      MaterialPairs({{1e7, 0.5, 0.5}, {1e7, 0.5, 0.5}},
                    {{{MaterialId{0}, MaterialId{1}}, AnyLaw::of<CohesiveFrictional>(glue)}});
  StructurePairs pairs;
  pairs.know_structures(bars.surface, bars.materials);

  pairs.place_of(0, 1, bars.materials.pairs);
  EXPECT_FALSE(pairs.glues());
  pairs.place_of(0, 2, bars.materials.pairs);
  EXPECT_TRUE(pairs.glues());
}

}  // namespace
}  // namespace plekton::contact::structure::structure_pairs_test

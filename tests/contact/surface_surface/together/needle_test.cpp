// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/simplex.hpp"
#include "tests/support/bodies_of_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// A floor in which two facets meet one along its longest side, with a sliver between them: its
/// third corner is the rounded middle of that side. Its exact area is not 0, the rounded one is.
/// k = 1 N/m.
namespace plekton::test::needle_test {
namespace {

constexpr double kRange = 0.01;  // m

enum class Joint { closed_by_a_needle, of_two_facets };

Body floor(Joint joint) {
  Body body;
  body.x = {{-0.2377548373370249, -0.006145636465344469, 0.0},
            {0.2123945590812077, -0.01792435145155749, 0.0},
            {0.0, -0.5, 0.0},
            {0.0, 0.5, 0.0}};
  body.facets = {{0, 2, 1}};
  if (joint == Joint::of_two_facets) {
    body.facets.push_back({0, 1, 3});
  } else {
    body.x.emplace_back(-0.012680139127908607, -0.012034993958450979, 0.0);
    body.facets.insert(body.facets.end(), {{0, 4, 3}, {4, 1, 3}, {0, 1, 4}});
  }
  return body;
}

/// What lies on both floors is pushed alike.
void expect_same(const Body& above) {
  StructurePair with(floor(Joint::closed_by_a_needle), above, kRange);
  StructurePair without(floor(Joint::of_two_facets), above, kRange);
  with.place(above);
  without.place(above);

  EXPECT_GT(without.energy(), 0.0);
  EXPECT_NEAR(with.energy(), without.energy(), 1e-6 * without.energy());
  const double force = without.force_on_b().norm();
  EXPECT_LE((with.force_on_b() - without.force_on_b()).norm(), 1e-6 * force);
  EXPECT_LE((with.moment_on_b(Vec3::Zero()) - without.moment_on_b(Vec3::Zero())).norm(),
            1e-6 * force);
}

TEST(Needles, BesideASheetChangeNothing) {
  for (const double overlap : {1e-8, 1e-4, 1e-3})
    expect_same(moved(sheet(2, 2, 0.1, 0.1), {0.0, 0.0, 0.0}, {0.07, 0.06, kRange - overlap}));
}

// A sheet and a facet that lie flat are the area they have over each other and no point contact. A
// needle has neither area nor tilt: of the points of its corners a third stays at most.
TEST(Needles, UnderAFlatSheetAreAThirdOfAContactAtMost) {
  const Body above = sheet(2, 2, 0.1, 0.1);
  for (const double overlap : {1e-8, 1e-4, 1e-3}) {
    const Body b = moved(above, {0.0, 0.0, 0.3}, {0.02, -0.01, kRange - overlap});
    StructurePair with(floor(Joint::closed_by_a_needle), b, kRange);
    StructurePair without(floor(Joint::of_two_facets), b, kRange);
    with.place(b);
    without.place(b);
    const double third = 1.000001 / 3.0;

    EXPECT_NEAR(with.energy(), without.energy(), third * 0.5 * overlap * overlap);
    EXPECT_LE((with.force_on_b() - without.force_on_b()).norm(), third * overlap);
  }
}

TEST(Needles, UnderBarsChangeNothing) {
  for (const double overlap : {1e-8, 1e-4, 1e-3}) {
    for (const double turn : {0.1, 1.3, -0.4})
      expect_same(moved(chain(2, 0.2), {0.0, 0.0, turn}, {0.01, -0.012, kRange - overlap}));
  }
}

TEST(Needles, HaveNoNormal) {
  contact::structure::Simplex needle, facet;
  needle.count = facet.count = 3;
  const Body body = floor(Joint::closed_by_a_needle);
  needle.x = {body.x[0], body.x[1], body.x[4]};
  facet.x = {body.x[0], body.x[2], body.x[1]};

  EXPECT_TRUE(contact::structure::is_needle(needle));
  EXPECT_FALSE(contact::structure::is_needle(facet));
  EXPECT_EQ(contact::structure::longest_side_of(needle), 0U);
}

}  // namespace
}  // namespace plekton::test::needle_test

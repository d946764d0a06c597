// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ray_search.hpp"

#include "geometry/query/surface_query.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::geometry::ray_search_test {
namespace {

using test::Complex;

TEST(AllHits, AreThoseOfAllCellsInTheOrderOfTheRay) {
  test::Random random(1);
  for (Complex complex : {test::sheet(5), test::net(4), test::ball(3), test::bow_tie()}) {
    for (const double radius : {0.1, 0.0}) {
      for (Facet& facet : complex.facets) facet.radius = radius;
      for (Cylinder& cylinder : complex.cylinders) cylinder.radius = radius;
      const Surface surface = complex.surface();
      const SurfaceQuery query(surface, complex.x);
      for (int trial = 0; trial < 200; ++trial) {
        const Vec3 origin = random.in_cube(trial % 2 == 0 ? 4.0 : 1e6);
        const Vec3 target = complex.x[random.index(complex.x.size())] + random.in_cube(0.5);
        const Ray ray{origin, target - origin};
        std::vector<RayHit> expected;
        for (std::size_t c = 0; c < surface.cell_count(); ++c) {
          if (const auto one = hit(ray, {surface, complex.x}, id_at<CellId>(c)))
            expected.push_back(*one);
        }
        std::stable_sort(expected.begin(), expected.end(),
                         [](const RayHit& p, const RayHit& q) { return p.t < q.t; });

        const auto found = query.all_hits(ray);

        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].t, expected[i].t);
          EXPECT_EQ(found[i].cell, expected[i].cell);
        }
        const auto first = query.first_hit(ray);
        ASSERT_EQ(first.has_value(), !found.empty());
        if (first) {
          EXPECT_EQ(first->cell, found.front().cell);
        }
      }
    }
  }
}

TEST(AllHits, OfASurfaceWithoutThicknessComeInPairsThroughASphere) {
  test::Random random(2);
  Complex ball = test::ball(3);
  for (Facet& facet : ball.facets) facet.radius = 0.0;
  const Surface surface = ball.surface();
  const SurfaceQuery query(surface, ball.x);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 origin = 3.0 * random.direction();
    const Vec3 target = 0.5 * random.in_cube(1.0);

    const auto hits = query.all_hits({origin, target - origin});

    // One facet in, one facet out: a random ray meets no edge.
    ASSERT_EQ(hits.size(), 2U);
    for (const RayHit& one : hits) EXPECT_LE(one.normal.dot(target - origin), 0.0);
  }
}

TEST(AllHits, ListBothFacetsOfAnEdgeThatTheRayGoesThrough) {
  Complex sheet = test::sheet(1);
  for (Facet& facet : sheet.facets) facet.radius = 0.0;
  const Surface surface = sheet.surface();
  const SurfaceQuery query(surface, sheet.x);

  const auto hits = query.all_hits({Vec3(0.5, 0.5, 1), Vec3(0, 0, -1)});

  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].t, 1.0);
  EXPECT_EQ(hits[1].t, 1.0);
  EXPECT_EQ(hits[0].core.feature, hits[1].core.feature);
  EXPECT_EQ(hits[0].cell, CellId{0});
}

}  // namespace
}  // namespace plekton::geometry::ray_search_test

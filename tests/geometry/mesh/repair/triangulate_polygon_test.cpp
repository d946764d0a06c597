// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/exact_signs.hpp"
#include "geometry/mesh/repair/triangulate_polygon.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::geometry::triangulate_polygon_test {
namespace {

using Polygon = std::vector<Vec3>;

Vec3 triangle_area(const Polygon& x, const std::array<std::size_t, 3>& t) {
  return 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
}

Vec3 polygon_area(const Polygon& x) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < x.size(); ++i) sum += 0.5 * (x[i] - x[0]).cross(x[i + 1] - x[0]);
  return sum;
}

/// A flat polygon is tiled by n - 2 triangles that all have an area and face as the polygon does.
void expect_tiled(const Polygon& x) {
  const auto triangles = triangulate_polygon(x);

  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), x.size() - 2);
  const Vec3 area = polygon_area(x);
  double sum = 0.0;
  for (const auto& t : *triangles) {
    EXPECT_FALSE(are_collinear(x[t[0]], x[t[1]], x[t[2]]));
    EXPECT_GT(triangle_area(x, t).dot(area), 0.0);
    sum += triangle_area(x, t).norm();
  }
  // Each area has an error of a few ulp of the square of the size, which is at most 10 here.
  EXPECT_NEAR(sum, area.norm(), 1e-13 * static_cast<double>(x.size()));
}

TEST(TriangulatePolygon, CutsAConvexQuadrilateralAlongItsShorterDiagonal) {
  const Polygon kite = {{0, 0, 0}, {2, -1, 0}, {6, 0, 0}, {2, 1, 0}};

  const auto triangles = triangulate_polygon(kite);

  EXPECT_EQ(triangles, (PolygonTriangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(TriangulatePolygon, CutsASquareTheSameWayFromAnyFirstCorner) {
  const Polygon square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

  for (std::size_t first = 0; first < 4; ++first) {
    Polygon turned = square;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
    const auto triangles = triangulate_polygon(turned);
    ASSERT_TRUE(triangles);
    for (const auto& t : *triangles) {
      const auto has = [&](const Vec3& p) {
        return std::any_of(t.begin(), t.end(), [&](std::size_t k) { return turned[k] == p; });
      };
      EXPECT_TRUE(has({0, 0, 0}) && has({1, 1, 0})) << "first corner " << first;
    }
  }
}

TEST(TriangulatePolygon, TilesConcaveAndStraightCornersInAnyPlane) {
  const Polygon dart = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  const Polygon comb = {{0, 0, 0}, {7, 0, 0}, {7, 2, 0}, {6, 2, 0}, {6, 1, 0}, {4, 1, 0},
                        {4, 2, 0}, {3, 2, 0}, {3, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Polygon straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                            {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const Polygon triangle_with_a_straight_corner = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};

  for (Polygon x : {dart, comb, straight, triangle_with_a_straight_corner}) {
    expect_tiled(x);
    std::reverse(x.begin(), x.end());
    expect_tiled(x);
    for (Vec3& p : x)
      p = Vec3(p[1], p[1] + p[0], p[0] - 2.0 * p[1]);  // A linear map of small integers: exact.
    expect_tiled(x);
  }
}

TEST(TriangulatePolygon, TilesRandomStars) {
  test::Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 5 + trial % 40;
    Polygon x;
    for (int k = 0; k < n; ++k) {
      const double r = random.uniform(0.1, 1.0), angle = 2.0 * std::numbers::pi * k / n;
      x.push_back({r * std::cos(angle), r * std::sin(angle), 0.0});
    }
    expect_tiled(x);
  }
}

TEST(TriangulatePolygon, RefusesPolygonsThatCrossOrTouchThemselves) {
  const Polygon bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Polygon spike = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const Polygon corner_on_side = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}};
  // Looks like a square with a corner on one of its sides from above, and worse from everywhere
  // else.
  const Polygon folded_up = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0, 1, -1}};

  for (const Polygon& x : {bow, spike, corner_on_side, folded_up})
    EXPECT_FALSE(triangulate_polygon(x));
}

TEST(TriangulatePolygon, CutsAWarpedPolygon) {
  const Polygon saddle = {{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0}, {0, 1, 0.3}};

  EXPECT_TRUE(triangulate_polygon(saddle));
  EXPECT_NEAR(warp(saddle), 0.15, 4e-16);
}

TEST(TriangulatePolygon, StaysQuickForTheLargestPolygon) {
  Polygon circle;
  for (std::size_t k = 0; k < kLargestPolygon; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kLargestPolygon;
    circle.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  expect_tiled(circle);

  circle.push_back({0.0, -1.5, 0.0});
  EXPECT_FALSE(triangulate_polygon(circle)) << "one corner more is refused, not waited for";
}

TEST(ExactSigns, DecideCollinearityWithoutRounding) {
  // 0.1, 0.2, 0.3 as doubles are not on one line: 2 * 0.1 + 0.1 is not the double 0.3.
  EXPECT_FALSE(are_collinear({0.1, 1, 0}, {0.2, 2, 0}, {0.3, 3, 0}));
  EXPECT_TRUE(are_collinear({0.125, 1, 0}, {0.25, 2, 0}, {0.375, 3, 0}));
  EXPECT_TRUE(are_collinear({1e6, 1, 1e-9}, {1e6, 1, 1e-9}, {0.3, 3, 0}));
  EXPECT_FALSE(are_collinear({0, 0, 0}, {1, 1e-300, 0}, {2, 0, 0}));
}

}  // namespace
}  // namespace plekton::geometry::triangulate_polygon_test

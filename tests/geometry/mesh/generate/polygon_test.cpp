// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/polygon.hpp"

#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/repair.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace plekton::geometry::polygon_test {
namespace {

using ::testing::HasSubstr;

constexpr double kRounding = 4e-16;

/// m², vector of the area that a mesh has, along where its facets face.
Vec3 area_of(const Mesh& mesh) {
  Vec3 area = Vec3::Zero();
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x = mesh.points[index_of(a)];
    area += 0.5 * (mesh.points[index_of(b)] - x).cross(mesh.points[index_of(c)] - x);
  }
  return area;
}

/// Expects that no facet lies on another, that all face alike, and that all points are used.
void expect_sound(const Mesh& mesh, const Vec3& area) {
  const Vec3 normal = area.normalized();
  MeshReport report;
  EXPECT_EQ(repair(to_soup(mesh), {}, report).facets, mesh.facets);
  EXPECT_EQ(report.verdict, MeshVerdict::ok) << to_text(report);
  EXPECT_EQ(mesh.facets.size(), mesh.points.size() - 2);
  EXPECT_EQ(report.after.border_edges, mesh.points.size());
  EXPECT_NEAR(report.after.area, area.norm(), kRounding * 100 * area.norm());
  EXPECT_LE((area_of(mesh) - area).norm(), kRounding * 100 * area.norm());
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x = mesh.points[index_of(a)];
    EXPECT_GT((mesh.points[index_of(b)] - x).cross(mesh.points[index_of(c)] - x).dot(normal), 0.0);
  }
}

std::string refusal_of(const std::vector<Vec3>& points) {
  try {
    polygon({points});
  } catch (const MeshError& error) {
    return error.what();
  }
  return "none";
}

TEST(PolygonMesh, OfARectangleHasItsAreaAndFacesWhereItGoesAroundCounterclockwise) {
  const std::vector<Vec3> there = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> back(there.rbegin(), there.rend());

  expect_sound(polygon({there}), {0, 0, 2});
  expect_sound(polygon({back}), {0, 0, -2});
}

TEST(PolygonMesh, OfAConcaveOneCoversItsAreaOnce) {
  // A comb of three teeth, 0.5 x 2 each, on a back of 3 x 1; the space between lies outside.
  const std::vector<Vec3> comb = {{0, 0, 0},   {3, 0, 0},   {3, 3, 0},   {2.5, 3, 0},
                                  {2.5, 1, 0}, {1.5, 1, 0}, {1.5, 3, 0}, {1, 3, 0},
                                  {1, 1, 0},   {0.5, 1, 0}, {0.5, 3, 0}, {0, 3, 0}};

  expect_sound(polygon({comb}), {0, 0, 6});
}

TEST(PolygonMesh, MayHaveCornersOnTheLineOfTheirNeighbours) {
  // The cut from (0, 0) to (2, 2) would leave facets without area between points of one line.
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const std::vector<Vec3> triangle = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}};

  expect_sound(polygon({square}), {0, 0, 4});
  expect_sound(polygon({triangle}), {0, 0, 4.5});
}

TEST(PolygonMesh, StandsAnywhereInSpaceAlsoAsASpiral) {
  // Two arms of a spiral around an axis that is along no coordinate: inside out, outside back.
  std::vector<Vec3> flat;
  const auto at = [](double radius, double angle) {
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  constexpr int kSteps = 200;
  constexpr double kTurns = 6.0 * std::numbers::pi;
  for (int i = 0; i <= kSteps; ++i)
    flat.push_back(at(1.2 + 1.0 * i / kSteps * 3, kTurns * i / kSteps));
  for (int i = kSteps; i >= 0; --i)
    flat.push_back(at(0.8 + 1.0 * i / kSteps * 3, kTurns * i / kSteps));
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  // Points i and j on the outer and inner arm: the shoelace formula of the flat outline.
  double twice = 0.0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Vec3 &x = flat[i], &y = flat[(i + 1) % flat.size()];
    twice += x[0] * y[1] - x[1] * y[0];
  }
  std::vector<Vec3> points;
  for (const Vec3& x : flat) points.push_back(turn * x + Vec3(10, -20, 5));

  const Mesh mesh = polygon({points});

  const Vec3 area = turn * Vec3(0, 0, 0.5 * twice);
  EXPECT_EQ(mesh.facets.size(), flat.size() - 2);
  // Coordinates of 20 m are rounded by 4e-15 m, over an outline of 100 m.
  EXPECT_LE((area_of(mesh) - area).norm(), 100 * 4e-15);
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x = points[index_of(a)];
    EXPECT_GT((points[index_of(b)] - x).cross(points[index_of(c)] - x).dot(area), 0.0);
  }
}

TEST(PolygonMesh, RefusesPointsThatAreNoPolygon) {
  const double nan = std::numeric_limits<double>::quiet_NaN();

  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 0, 0}}), HasSubstr("of 2 points; expected from 3"));
  EXPECT_THAT(refusal_of(std::vector<Vec3>(1025, Vec3::Zero())), HasSubstr("of 1025 points"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}), HasSubstr("with point 2 at"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
              HasSubstr("points 1 and 2 are both at (1, 0, 0) m; leave one out"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}),
              HasSubstr("last point is the first one again; leave it out"));
}

TEST(PolygonMesh, RefusesOneWithoutAreaOrOutOfItsPlane) {
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}), HasSubstr("it has no area"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.01}}),
              HasSubstr("m out of the plane of points 0, "));
  // A ten thousandth of the size, and a hundredth less: of points that were written with 4 digits.
  EXPECT_EQ(refusal_of({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0.99e-4 * 5}}), "none");
}

TEST(PolygonMesh, RefusesSidesThatTouchOrCross) {
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}),
              HasSubstr("sides touch or cross"));
  // A corner on a side, and two corners at one place.
  EXPECT_THAT(refusal_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}),
              HasSubstr("touch or cross"));
  EXPECT_THAT(refusal_of({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}}),
              HasSubstr("touch or cross"));
  // A spike without width.
  EXPECT_THAT(refusal_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 1, 0}, {0, 2, 0}}),
              HasSubstr("touch or cross"));
}

}  // namespace
}  // namespace plekton::geometry::polygon_test

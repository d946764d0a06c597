// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/fill_holes.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "tests/support/meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace plekton::geometry::fill_holes_test {
namespace {

using test::inside_out;

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Sheet of 8 x 8 cells of 1 m in z = 0, centred, without those whose middles are chosen.
Mesh sheet_without(const std::function<bool(double, double)>& is_hole) {
  Mesh mesh = plane_sheet({.width = 8.0, .length = 8.0, .cells_x = 8, .cells_y = 8});
  std::erase_if(mesh.facets, [&](const auto& facet) {
    Vec3 middle = Vec3::Zero();
    for (const NodeId node : facet) middle += mesh.points[index_of(node)] / 3.0;
    return is_hole(std::floor(middle[0]), std::floor(middle[1]));  // lower corner of the cell
  });
  return mesh;
}

double area_of(const Mesh& mesh) {
  return measure(mesh, false).area;
}

/// z components of the normals, by facet: 1 for a sheet in z = 0 that faces up.
std::vector<double> normals_up(const Mesh& mesh) {
  std::vector<double> up;
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x = mesh.points[index_of(a)];
    up.push_back(
        (mesh.points[index_of(b)] - x).cross(mesh.points[index_of(c)] - x).normalized()[2]);
  }
  return up;
}

TEST(FillHoles, CoversAFlatHoleOfAnyShapeOnceAndFacesAsItsNeighboursDo) {
  // The corners of an L, of cells of 1 m: area 5, and a rim of 12 nodes.
  Mesh mesh = sheet_without([](double i, double j) {
    return (i >= -2 && i < 1 && j == -2) || (i == -2 && j >= -2 && j < 1);
  });
  ASSERT_EQ(area_of(mesh), 64.0 - 5.0);
  const double up = normals_up(mesh).front();

  const FilledHoles holes = fill_holes(mesh, 12.0);

  EXPECT_EQ(holes.filled, 1u);
  EXPECT_EQ(holes.left, 0u);
  EXPECT_EQ(holes.facets, 10u) << "two less than nodes";
  EXPECT_NEAR(area_of(mesh), 64.0, 64.0 * 1e-15);
  for (const double other : normals_up(mesh)) EXPECT_EQ(other, up);
  EXPECT_EQ(measure(mesh, true).self_intersections, 0u);
}

TEST(FillHoles, FacesInwardWhereTheSurfaceDoes) {
  for (const bool is_inside_out : {false, true}) {
    Mesh sphere = icosphere(1.0, 2);
    if (is_inside_out) sphere = inside_out(sphere);
    sphere.facets.resize(sphere.facets.size() - 4);

    EXPECT_EQ(fill_holes(sphere, kAny).filled, 1u);

    const MeshMeasures measures = measure(sphere, false);
    EXPECT_TRUE(measures.closed);
    EXPECT_EQ(measures.inconsistent_edges, 0u);
    EXPECT_EQ(measures.volume.value() < 0.0, is_inside_out);
  }
}

TEST(FillHoles, FillsEachHoleUpToTheLength) {
  // One cell and two of them: 4 m and 6 m around.
  const Mesh mesh = sheet_without(
      [](double i, double j) { return (i == -3 && j == -3) || (j == 2 && (i == 1 || i == 2)); });
  const auto filled_up_to = [&](double longest) {
    Mesh copy = mesh;
    const FilledHoles holes = fill_holes(copy, longest);
    EXPECT_EQ(holes.left, 0u) << "longer ones do not count";
    EXPECT_NEAR(area_of(copy), area_of(mesh) + (longest >= 4.0) + 2.0 * (longest >= 6.0), 1e-13);
    return holes.filled;
  };

  EXPECT_EQ(filled_up_to(std::nextafter(4.0, 0.0)), 0u);
  EXPECT_EQ(filled_up_to(4.0), 1u) << "a length that is asked for is included";
  EXPECT_EQ(filled_up_to(std::nextafter(6.0, 0.0)), 1u);
  EXPECT_EQ(filled_up_to(6.0), 2u);
}

TEST(FillHoles, LeavesARimOpenWhoseFacetsDisagree) {
  Mesh box = box_shell({1.0, 1.0, 1.0}, {3, 3, 3});
  box.facets.resize(box.facets.size() - 18);  // one side
  const MeshMeasures before = measure(box, false);
  ASSERT_EQ(before.border_edges, 12u);
  const EdgeTable table(box);
  for (std::size_t e = 0; e < table.size(); ++e) {
    if (table.uses(e).size() != 1) continue;
    auto& facet = box.facets[table.uses(e).front().facet];
    std::swap(facet[0], facet[1]);
    break;
  }

  const FilledHoles holes = fill_holes(box, kAny);

  EXPECT_EQ(holes.filled, 0u);
  EXPECT_GT(holes.left, 0u);
  EXPECT_EQ(box.facets.size(), before.facets);
}

TEST(FillHoles, LeavesHolesOfMoreNodesThanTheLimitOpen) {
  const auto around = static_cast<int>(kLargestHole) + 1;
  Mesh pipe = tube({.radius = 1.0, .length = 1.0, .around = around, .along = 1});
  const std::size_t facets = pipe.facets.size();

  const FilledHoles holes = fill_holes(pipe, kAny);

  EXPECT_EQ(holes.filled, 0u);
  EXPECT_EQ(holes.left, 2u);
  EXPECT_EQ(pipe.facets.size(), facets);
}

}  // namespace
}  // namespace plekton::geometry::fill_holes_test

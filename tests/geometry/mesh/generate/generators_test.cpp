// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/repair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::geometry::generators_test {
namespace {

/// A generated mesh needs no repair; equal after it.
MeshMeasures measures_of_clean(const Mesh& mesh) {
  MeshReport report;
  const Mesh same = repair(to_soup(mesh), {}, report);
  EXPECT_EQ(same.facets, mesh.facets);
  EXPECT_EQ(report.verdict, MeshVerdict::ok) << to_text(report);
  return report.after;
}

TEST(PlaneSheet, IsAFlatDiscOfTheGivenSizeInEveryPattern) {
  for (const SheetPattern pattern :
       {SheetPattern::diagonal, SheetPattern::alternating, SheetPattern::cross}) {
    const Mesh mesh =
        plane_sheet({.width = 3.0, .length = 2.0, .cells_x = 6, .cells_y = 5, .pattern = pattern});

    const MeshMeasures m = measures_of_clean(mesh);

    const bool cross = pattern == SheetPattern::cross;
    EXPECT_EQ(m.points, cross ? 72u : 42u);
    EXPECT_EQ(m.facets, cross ? 120u : 60u);
    EXPECT_EQ(m.border_edges, 22u);
    EXPECT_EQ(m.euler_characteristic, 1);
    EXPECT_NEAR(m.area, 6.0, 120 * 4e-16);
    EXPECT_EQ(m.bounds.lower, Vec3(-1.5, -1.0, 0.0));
    EXPECT_EQ(m.bounds.upper, Vec3(1.5, 1.0, 0.0));
    for (const auto& [a, b, c] : mesh.facets) {
      const Vec3& p = mesh.points[index_of(a)];
      EXPECT_GT((mesh.points[index_of(b)] - p).cross(mesh.points[index_of(c)] - p).z(), 0.0);
    }
  }
}

TEST(TubeMesh, HasTwoRimsAndFacesOutward) {
  const Mesh mesh = tube({.radius = 0.5, .length = 2.0, .around = 12, .along = 7});

  const MeshMeasures m = measures_of_clean(mesh);

  EXPECT_EQ(m.points, 96u);
  EXPECT_EQ(m.facets, 168u);
  EXPECT_EQ(m.border_edges, 24u);
  EXPECT_EQ(m.euler_characteristic, 0);
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3 p = mesh.points[index_of(a)], q = mesh.points[index_of(b)],
               r = mesh.points[index_of(c)];
    Vec3 outward = p + q + r;
    outward.z() = 0.0;
    EXPECT_GT((q - p).cross(r - p).dot(outward), 0.0);
  }
}

TEST(Icosphere, IsClosedWithAllNodesOnTheSphere) {
  for (const int subdivisions : {0, 1, 3}) {
    const Mesh mesh = icosphere(0.2, subdivisions);

    const MeshMeasures m = measures_of_clean(mesh);

    EXPECT_EQ(m.facets, 20u << (2 * subdivisions));
    EXPECT_EQ(m.euler_characteristic, 2);
    EXPECT_EQ(m.bounds_volume, true);
    for (const Vec3& p : mesh.points) EXPECT_NEAR(p.norm(), 0.2, 1e-16);
    EXPECT_LT(m.area, 4.0 * std::numbers::pi * 0.04);
  }
}

TEST(BoxShell, EnclosesItsVolume) {
  const MeshMeasures m = measures_of_clean(box_shell({1.0, 2.0, 3.0}, {2, 3, 4}));

  EXPECT_EQ(m.facets, 4u * (2 * 3 + 3 * 4 + 4 * 2));
  EXPECT_EQ(m.euler_characteristic, 2);
  EXPECT_EQ(m.bounds_volume, true);
  EXPECT_NEAR(m.volume.value(), 6.0, 104 * 4e-16 * 6.0);
  EXPECT_NEAR(m.area, 22.0, 104 * 4e-16 * 22.0);
}

TEST(Generators, RefuseLengthsAndDivisionsThatMakeNoMesh) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plane_sheet({.width = 0.0, .length = 1.0, .cells_x = 1, .cells_y = 1}), MeshError);
  EXPECT_THROW(plane_sheet({.width = 1.0, .length = nan, .cells_x = 1, .cells_y = 1}), MeshError);
  EXPECT_THROW(plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 0, .cells_y = 1}), MeshError);
  EXPECT_THROW(tube({.radius = 1.0, .length = 1.0, .around = 2, .along = 1}), MeshError);
  EXPECT_THROW(icosphere(-1.0, 1), MeshError);
  EXPECT_THROW(icosphere(1.0, 13), MeshError);
  EXPECT_THROW(box_shell({1.0, 1.0, 0.0}), MeshError);
}

TEST(Generators, RefuseMoreNodesThanNumbersBeforeTheyMakeAny) {
  constexpr int kMost = std::numeric_limits<int>::max();
  const PlaneSheet sheet{.width = 1.0, .length = 1.0, .cells_x = 40'000, .cells_y = 40'000};
  PlaneSheet crossed = sheet;
  crossed.pattern = SheetPattern::cross;

  EXPECT_THROW(plane_sheet(crossed), MeshError);  // 3.2e9; without a node in each cell 1.6e9
  EXPECT_THROW(plane_sheet({.width = 1.0, .length = 1.0, .cells_x = kMost, .cells_y = 1}),
               MeshError);
  EXPECT_THROW(tube({.radius = 1.0, .length = 1.0, .around = kMost, .along = kMost}), MeshError);
  EXPECT_THROW(box_shell({1.0, 1.0, 1.0}, {kMost, 1, 1}), MeshError);
}

}  // namespace
}  // namespace plekton::geometry::generators_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/repair/fill_holes.hpp"
#include "geometry/mesh/repair/remesh.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "geometry/mesh/repair/surface_distance.hpp"
#include "geometry/mesh/repair/wrap.hpp"
#include "tests/support/meshes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry::reshape_test {
namespace {

using test::inside_out;
using test::repaired;
using test::together;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kAny = std::numeric_limits<double>::infinity();

Mesh without_facets(Mesh mesh, std::size_t from, std::size_t count) {
  const auto first = mesh.facets.begin() + static_cast<std::ptrdiff_t>(from);
  mesh.facets.erase(first, first + static_cast<std::ptrdiff_t>(count));
  return mesh;
}

TEST(Repair, TellsEachStepThatBegins) {
  std::vector<std::string> steps;
  RepairOptions options;
  options.fill_holes = true;
  options.target_edge = 0.2;
  options.hear = [&](std::string_view step) { steps.emplace_back(step); };

  repaired(to_soup(without_facets(box_shell({1.0, 1.0, 1.0}), 0, 2)), options);

  EXPECT_THAT(steps,
              ElementsAre("joining points", "cutting polygons into facets", "orienting facets",
                          "filling holes", "remeshing", "measuring how far the surface has moved",
                          "measuring, and looking for facets that intersect"));
}

TEST(FillHoles, ClosesABoxAgainOverItsOwnNodes) {
  const Mesh box = box_shell({1.0, 2.0, 3.0}, {2, 2, 2});
  Mesh open = without_facets(box, 8, 8);  // one side

  const FilledHoles holes = fill_holes(open, kAny);

  EXPECT_EQ(holes.filled, 1u);
  EXPECT_EQ(holes.left, 0u);
  EXPECT_EQ(holes.facets, 6u) << "a rim of eight nodes";
  EXPECT_EQ(open.points, box.points);
  const MeshMeasures m = measure(open, true);
  EXPECT_TRUE(m.closed);
  EXPECT_EQ(m.inconsistent_edges, 0u);
  EXPECT_NEAR(m.volume.value(), 6.0, 24 * 6.0 * 2e-16);
}

TEST(FillHoles, LeavesHolesOpenThatAreLongerThanAsked) {
  Mesh mesh = without_facets(
      plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 10, .cells_y = 10}), 90, 2);
  const std::size_t facets = mesh.facets.size();

  EXPECT_EQ(fill_holes(mesh, 0.3).filled, 0u);
  const FilledHoles holes = fill_holes(mesh, 0.5);

  EXPECT_EQ(holes.filled, 1u) << "the missing cell, not the rim of the sheet";
  EXPECT_EQ(mesh.facets.size(), facets + 2);
  EXPECT_EQ(measure(mesh, false).border_edges, 40u);
}

TEST(FillHoles, DoesNotCoverAFacetByItself) {
  Mesh lone{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{NodeId{0}, NodeId{1}, NodeId{2}}}};
  Mesh pair = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 1, .cells_y = 1});

  EXPECT_EQ(fill_holes(lone, kAny).left, 1u);
  EXPECT_EQ(lone.facets.size(), 1u);
  fill_holes(pair, kAny);
  EXPECT_EQ(measure(pair, false).many_facet_edges, 0u);
}

TEST(FillHoles, KeepsJoinedNodesJoinedAndLeavesABranchedBorderOpen) {
  // Two triangles that touch in one node: the border runs through it twice.
  Mesh bow{{{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}},
           {{NodeId{0}, NodeId{2}, NodeId{1}}, {NodeId{0}, NodeId{3}, NodeId{4}}}};

  const FilledHoles holes = fill_holes(bow, kAny);

  EXPECT_EQ(holes.filled, 0u);
  EXPECT_EQ(holes.left, 1u);
  EXPECT_EQ(bow.facets.size(), 2u);
}

TEST(SurfaceDistance, EnclosesTheDistanceOfConcentricSpheres) {
  // Radii differ by 0.1; facets of the larger one lie at most 1 - cos(half an edge) inside it.
  const SurfaceDistance distance = surface_distance(icosphere(1.0, 4), icosphere(1.1, 4));

  EXPECT_NEAR(distance.sampled, 0.1, 0.002);
  EXPECT_GE(distance.bound, 0.1);
  EXPECT_LT(distance.bound, 0.12);
}

TEST(SurfaceDistance, IsZeroOfASurfaceFromItselfAndSeesWhatOneSideLacks) {
  const Mesh sphere = icosphere(1.0, 3);
  const Mesh far_part = together({sphere, inside_out(icosphere(0.1, 1))});

  EXPECT_LT(surface_distance(sphere, sphere).sampled, 1e-7) << "the root of a rounded square";
  EXPECT_GT(surface_distance(sphere, far_part).sampled, 0.85);
}

TEST(Remesh, CollapsesShortEdgesAlongStraightRimsAndFoldsButKeepsTheirCorners) {
  const double target = 0.25;
  const Mesh sheet =
      remesh(plane_sheet({.width = 1.0, .length = 2.0, .cells_x = 40, .cells_y = 80}), target);
  const Mesh box = remesh(box_shell({1.0, 2.0, 3.0}, {20, 40, 60}), target);

  const MeshMeasures flat = measure(sheet, true);
  EXPECT_NEAR(flat.area, 2.0, 1e-12);
  // Edges of less than 4/5 of the target go while their neighbours allow it: half of it on average.
  EXPECT_LE(flat.border_edges, 6.0 / (0.5 * target));
  EXPECT_EQ(flat.self_intersections, 0u);
  const MeshMeasures closed = measure(box, true);
  EXPECT_NEAR(closed.volume.value(), 6.0, 1e-11);
  EXPECT_NEAR(closed.area, 22.0, 1e-11);
  EXPECT_GT(closed.mean_edge, 0.8 * target);
  EXPECT_EQ(closed.self_intersections, 0u);
}

TEST(Remesh, KeepsLinesThatTurnWithinAFewEdges) {
  // The rims of a tube of 0.1 m radius, of 64 pieces; a target of the same length would cut them
  // down to a few chords.
  const Mesh ring = tube({.radius = 0.1, .length = 1.0, .around = 64, .along = 40});
  const Mesh mesh = remesh(ring, 0.1);

  EXPECT_EQ(measure(mesh, false).border_edges, 128u);
  EXPECT_EQ(measure(mesh, true).self_intersections, 0u);
}

TEST(Remesh, MakesEdgesOfTheTargetLengthOnASphere) {
  const Mesh sphere = icosphere(1.0, 4);

  const Mesh mesh = remesh(sphere, 0.2);

  const MeshMeasures m = measure(mesh, true);
  // Longer edges than 4/3 of the target are cut, shorter ones than 4/5 collapsed.
  EXPECT_GT(m.mean_edge, 0.2 * 4.0 / 5.0);
  EXPECT_LT(m.mean_edge, 0.2 * 4.0 / 3.0);
  EXPECT_LT(m.longest_edge, 0.2 * 4.0 / 3.0 * 1.1);
  EXPECT_GT(m.smallest_angle, 25.0);
  EXPECT_EQ(m.self_intersections, 0u);
  EXPECT_EQ(m.bounds_volume, true);
  const double sagitta = m.longest_edge * m.longest_edge / 8.0;
  EXPECT_LT(surface_distance(sphere, mesh).sampled, 2.0 * sagitta);
}

TEST(Remesh, KeepsTheCreasesOfABoxAndTheRimOfASheet) {
  const Mesh box = remesh(box_shell({1.0, 2.0, 3.0}), 0.25);
  const Mesh sheet =
      remesh(plane_sheet({.width = 1.0, .length = 2.0, .cells_x = 1, .cells_y = 1}), 0.1);

  EXPECT_NEAR(measure(box, false).volume.value(), 6.0, 1e-12);
  EXPECT_NEAR(measure(box, false).mean_edge, 0.25, 0.05);
  EXPECT_NEAR(measure(sheet, false).area, 2.0, 1e-12);
  EXPECT_NEAR(measure(sheet, false).mean_edge, 0.1, 0.02);
}

template <class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Remesh, RefusesWhatItWouldTearApartAndLengthsThatMakeNoMesh) {
  Mesh fin = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 1, .cells_y = 1});
  fin.points.push_back({0.0, 0.0, 1.0});
  fin.facets.push_back({fin.facets[0][0], fin.facets[0][2], NodeId{4}});

  EXPECT_THAT(message_of([&] { remesh(fin, 0.1); }),
              HasSubstr("1 edges have more than two facets"));
  const Mesh sphere = icosphere(1.0, 1);
  EXPECT_THAT(message_of([&] { remesh(sphere, -0.1); }), HasSubstr("positive length"));
  EXPECT_THAT(message_of([&] { remesh(sphere, std::nan("")); }), HasSubstr("positive length"));
  EXPECT_THAT(message_of([&] { remesh(sphere, 1e-6); }), HasSubstr("use a longer edge"));
  Mesh folded = sphere;
  folded.facets[3][1] = folded.facets[3][0];
  EXPECT_THAT(message_of([&] { remesh(folded, 0.1); }), HasSubstr("facet 3 names a point twice"));
}

TEST(Wrap, MakesOneClosedShellOfAnything) {
  const Mesh parts =
      together({box_shell({1.0, 1.0, 1.0}), without_facets(icosphere(0.7, 2), 0, 5)});

  const Mesh shell = wrap(parts, 0.1);

  const MeshMeasures m = measure(shell, true);
  EXPECT_EQ(m.components, 1u);
  EXPECT_EQ(m.non_manifold_nodes, 0u);
  EXPECT_EQ(m.self_intersections, 0u);
  EXPECT_EQ(m.bounds_volume, true);
}

TEST(Wrap, RefusesADetailThatNoMemoryHolds) {
  EXPECT_THAT(message_of([] { wrap(icosphere(1.0, 1), 1e-6); }), HasSubstr("at least"));
  EXPECT_THAT(message_of([] { wrap(icosphere(1.0, 1), std::nan("")); }), HasSubstr("at least"));
}

Mesh moved(Mesh mesh, double scale, const Vec3& by) {
  for (Vec3& p : mesh.points) p = scale * p + by;
  return mesh;
}

// Far away a wrap divided by zero, or had no end, and remeshing took all memory.
TEST(Reshape, RefusesDetailsThatTheCoordinatesDoNotResolve) {
  for (const double far : {1e12, 1e15}) {
    const Mesh mesh = moved(icosphere(1.0, 1), 1.0, Vec3(far, 0.0, 0.0));
    EXPECT_THAT(message_of([&] { wrap(mesh, 0.1); }), HasSubstr("nearer to the origin"));
  }
  const Mesh mesh = moved(icosphere(1.0, 1), 1.0, Vec3(0.0, 1e15, 0.0));
  EXPECT_THAT(message_of([&] { remesh(mesh, 0.2); }), HasSubstr("nearer to the origin"));
}

TEST(Reshape, RefusesSizesWhoseProductsAreNoNumbers) {
  for (const double scale : {1e-200, 1e-100, 1e100}) {
    const Mesh mesh = moved(icosphere(1.0, 1), scale, Vec3::Zero());
    EXPECT_THAT(message_of([&] { wrap(mesh, 0.1 * scale); }), HasSubstr("scale it"));
    EXPECT_THAT(message_of([&] { remesh(mesh, 0.2 * scale); }), HasSubstr("scale it"));
  }
}

TEST(Repair, ReshapesOnlyWhenAskedAndReportsAreaVolumeAndDistance) {
  const Mesh open = without_facets(icosphere(1.0, 3), 0, 4);

  EXPECT_FALSE(repaired(to_soup(open)).report.reshaped);
  const auto [mesh, report] = repaired(to_soup(open), {.fill_holes = true, .target_edge = 0.15});

  ASSERT_TRUE(report.reshaped);
  EXPECT_EQ(report.reshaped->holes_filled, 1u);
  EXPECT_LT(report.reshaped->area_before, 4.0 * std::numbers::pi);
  EXPECT_FALSE(report.reshaped->volume_before);
  EXPECT_NEAR(report.after.volume.value(), 4.0 / 3.0 * std::numbers::pi, 0.1);
  EXPECT_GT(report.reshaped->distance_bound, report.reshaped->distance);
  EXPECT_LT(report.reshaped->distance, 0.2) << "the middle of the filling from the rim";
  EXPECT_EQ(report.after.bounds_volume, true);
  EXPECT_EQ(report.verdict, MeshVerdict::repaired);
  EXPECT_THAT(to_text(report), HasSubstr("reshaped\n  holes filled"));
  EXPECT_THAT(to_json(report), HasSubstr("\"distance_bound\": "));
}

TEST(Repair, TurnsAPartOutwardThatIsClosedByFilling) {
  const Mesh open = inside_out(without_facets(icosphere(1.0, 2), 0, 4));

  const auto [mesh, report] = repaired(to_soup(open), {.fill_holes = true});

  EXPECT_GT(report.after.volume.value(), 0.0);
  EXPECT_EQ(report.after.bounds_volume, true);
}

/// The promise that the refusal of fine wraps relies on, on a thick body and on a sheet.
TEST(Wrap, HasFacetsInProportionToTheSquareOfItsDetail) {
  const Mesh sheet = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 2, .cells_y = 2});
  for (const Mesh& mesh : {icosphere(1.0, 3), sheet}) {
    const auto coarse = static_cast<double>(wrap(mesh, 0.1).facets.size());
    const auto fine = static_cast<double>(wrap(mesh, 0.05).facets.size());

    EXPECT_NEAR(fine / coarse, 4.0, 1.0);
  }
}

TEST(Wrap, RefusesDetailsThatTakeTooManyFacetsAndSaysWhichDoNot) {
  const std::string message = message_of([] { wrap(icosphere(1.0, 3), 0.003); });

  // About 2 facets to the square of the detail on 4 pi m².
  EXPECT_THAT(message, HasSubstr("a wrap of 0.003 m would make about "));
  EXPECT_THAT(message, HasSubstr(" facets; expected at most 1e+06; use a length of at least "));
  const double least = std::stod(message.substr(message.find("at least ") + 9));
  EXPECT_NEAR(least, std::sqrt(2.0 * 4.0 * std::numbers::pi / 1e6), 0.001);
}

TEST(Repair, WrapsWithAWarning) {
  const Mesh crossing = together({box_shell({1.0, 1.0, 1.0}), icosphere(0.7, 2)});

  const auto refused = repaired(to_soup(crossing), {.refuse_intersections = true}).report;
  const auto wrapped =
      repaired(to_soup(crossing), {.refuse_intersections = true, .wrap = true, .wrap_detail = 0.1})
          .report;

  EXPECT_EQ(refused.verdict, MeshVerdict::refused);
  EXPECT_THAT(refused.reasons, Contains(HasSubstr("pairs of facets intersect; correct the mesh")));
  EXPECT_EQ(wrapped.verdict, MeshVerdict::usable_with_warnings);
  EXPECT_THAT(wrapped.reasons, Contains(HasSubstr("closed shell")));
}

TEST(Repair, RefusesLengthsThatAreNone) {
  const PolygonSoup soup = to_soup(icosphere(1.0, 1));

  EXPECT_THAT(message_of([&] { repaired(soup, {.longest_hole = -1.0}); }),
              HasSubstr("longest hole"));
  EXPECT_THAT(message_of([&] { repaired(soup, {.wrap_detail = -1.0}); }), HasSubstr("wrap detail"));
  EXPECT_EQ(repaired(soup, {.target_edge = -1.0}).report.verdict, MeshVerdict::refused);
}

TEST(Repair, RefusesToRemeshWhatIsNotManifold) {
  Mesh fin = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 1, .cells_y = 1});
  fin.points.push_back({0.0, 0.0, 1.0});
  fin.facets.push_back({fin.facets[0][0], fin.facets[0][2], NodeId{4}});
  fin.facets.push_back({fin.facets[0][0], fin.facets[0][1], NodeId{4}});

  const auto report = repaired(to_soup(fin), {.target_edge = 0.1}).report;

  EXPECT_EQ(report.verdict, MeshVerdict::refused);
  EXPECT_THAT(report.reasons, Contains(HasSubstr("cannot be remeshed")));
}

}  // namespace
}  // namespace plekton::geometry::reshape_test

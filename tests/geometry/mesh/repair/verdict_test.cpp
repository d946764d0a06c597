// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/verdict.hpp"

#include "geometry/mesh/repair/triangulate_polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace plekton::geometry::verdict_test {
namespace {

using Reshaped = MeshReport::Reshaped;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// Of a mesh with nothing wrong, but for what is changed.
MeshReport judged(const std::function<void(MeshReport&)>& change,
                  const std::vector<std::size_t>& uncut = {},
                  const std::vector<std::string>& refusals = {}) {
  MeshReport report;
  report.found.polygons = 12;
  report.after.facets = 12;
  report.after.smallest_angle = 45.0;
  report.verdict = MeshVerdict::refused;
  report.reasons = {"of another mesh"};
  change(report);
  judge(report, uncut, refusals);
  return report;
}

/// A reshaping of which one number is not 0.
template <class Number>
Reshaped with(Number Reshaped::*member, std::type_identity_t<Number> value) {
  Reshaped reshaped;
  reshaped.*member = value;
  return reshaped;
}

using Change = std::pair<const char*, std::function<void(MeshReport&)>>;

TEST(Judge, CallsAMeshRepairedForEveryChangeOfItsFacetsOrPoints) {
  const std::vector<Change> repairs{
      {"welded", [](MeshReport& r) { r.changed.points_welded = 1; }},
      {"repeated", [](MeshReport& r) { r.changed.repeated_node_facets = 1; }},
      {"area", [](MeshReport& r) { r.changed.zero_area_facets = 1; }},
      {"duplicate", [](MeshReport& r) { r.changed.duplicate_facets = 1; }},
      {"flipped", [](MeshReport& r) { r.changed.flipped_facets = 1; }},
      {"unused", [](MeshReport& r) { r.changed.unused_points = 1; }},
      {"filled", [](MeshReport& r) { r.reshaped = with(&Reshaped::holes_filled, 1); }},
      {"remeshed", [](MeshReport& r) { r.reshaped = with(&Reshaped::target_edge, 0.1); }}};
  for (const auto& [what, change] : repairs) {
    const MeshReport report = judged(change);
    EXPECT_EQ(report.verdict, MeshVerdict::repaired) << what;
    EXPECT_THAT(report.reasons, IsEmpty()) << what;
  }
  const std::vector<Change> none{{"nothing", [](MeshReport&) {}},
                                 {"merged", [](MeshReport& r) { r.changed.points_merged = 8; }},
                                 {"cut", [](MeshReport& r) { r.changed.polygons_cut = 6; }},
                                 {"asked", [](MeshReport& r) { r.reshaped = Reshaped{}; }},
                                 {"skipped", [](MeshReport& r) { r.found.skipped_elements = 3; }}};
  for (const auto& [what, change] : none) {
    const MeshReport report = judged(change);
    EXPECT_EQ(report.verdict, MeshVerdict::ok) << what;
    EXPECT_THAT(report.reasons, IsEmpty()) << what;
  }
}

TEST(Judge, WarnsOfEverythingThatRemainsAndCountsInTheRightNumber) {
  const std::vector<Change> warnings{
      {"1 edge has more than two", [](MeshReport& r) { r.after.many_facet_edges = 1; }},
      {"2 edges have more than two", [](MeshReport& r) { r.after.many_facet_edges = 2; }},
      {"1 node joins ", [](MeshReport& r) { r.after.non_manifold_nodes = 1; }},
      {"3 nodes join ", [](MeshReport& r) { r.after.non_manifold_nodes = 3; }},
      {"1 part has only one side", [](MeshReport& r) { r.after.non_orientable_patches = 1; }},
      {"4 edges have facets that face", [](MeshReport& r) { r.after.inconsistent_edges = 4; }},
      {"1 pair of facets intersects", [](MeshReport& r) { r.after.self_intersections = 1; }},
      {"9 pairs of facets intersect", [](MeshReport& r) { r.after.self_intersections = 9; }},
      {"the mesh is closed but bounds no", [](MeshReport& r) { r.after.bounds_volume = false; }},
      {"the smallest angle of a facet is 0.5 deg",
       [](MeshReport& r) { r.after.smallest_angle = 0.5; }},
      {"1 edge is open where", [](MeshReport& r) { r.changed.slits = 1; }},
      {"5 edges are open where", [](MeshReport& r) { r.changed.slits = 5; }},
      {"1 polygon is not flat", [](MeshReport& r) { r.found.warped_polygons = 1; }},
      {"1 hole could not be filled",
       [](MeshReport& r) { r.reshaped = with(&Reshaped::holes_left, 1); }},
      {"the surface was wrapped: it is a closed shell now, up to 0.25 m away", [](MeshReport& r) {
         r.reshaped = with(&Reshaped::wrap_detail, 0.1);
         r.reshaped->distance_bound = 0.25;
       }}};
  for (const auto& [beginning, change] : warnings) {
    const MeshReport report = judged([&, &change = change](MeshReport& r) {
      r.changed.flipped_facets = 1;  // a warning weighs more than a repair
      change(r);
    });
    EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings) << beginning;
    EXPECT_THAT(report.reasons, ElementsAre(StartsWith(beginning)));
  }
}

TEST(Judge, DoesNotWarnOfWhatIsAsItShould) {
  const std::vector<Change> fine{
      {"angle", [](MeshReport& r) { r.after.smallest_angle = kSmallAngle; }},
      {"no intersections", [](MeshReport& r) { r.after.self_intersections = 0; }},
      {"volume", [](MeshReport& r) { r.after.bounds_volume = true; }}};
  for (const auto& [what, change] : fine)
    EXPECT_EQ(judged(change).verdict, MeshVerdict::ok) << what;
}

TEST(Judge, WarnsOfNearPointsThatAreLeftAfterTheWeld) {
  const auto with_welded = [](std::size_t welded) {
    return judged([&](MeshReport& r) {
      r.found.near_duplicate_points = 3;
      r.found.near_distance = 0.125;
      r.changed.points_welded = welded;
    });
  };

  EXPECT_THAT(with_welded(0).reasons, ElementsAre(StartsWith("3 points lie within 0.125 m of")));
  EXPECT_THAT(with_welded(2).reasons, ElementsAre(StartsWith("1 point lies within 0.125 m of")));
  EXPECT_EQ(with_welded(3).verdict, MeshVerdict::repaired);
}

TEST(Judge, SaysOfAPartWithOneSideNotThatItsFacetsDisagree) {
  const MeshReport report = judged([](MeshReport& r) {
    r.after.non_orientable_patches = 2;
    r.after.inconsistent_edges = 7;
  });

  EXPECT_THAT(report.reasons, ElementsAre(StartsWith("2 parts have only one side")));
}

TEST(Judge, RefusesForEachReasonAndThenSaysNothingElse) {
  const auto warned = [](MeshReport& r) { r.after.many_facet_edges = 1; };
  const std::vector<std::size_t> five{0, 3, 7, 8, 40}, seven{0, 3, 7, 8, 40, 41, 50};

  const MeshReport report = judged(warned, seven, {"facets intersect"});

  EXPECT_EQ(report.verdict, MeshVerdict::refused);
  const std::string limit = "has more than " + std::to_string(kLargestPolygon) + " corners";
  EXPECT_THAT(report.reasons,
              ElementsAre("facets intersect", HasSubstr(limit), StartsWith("polygon 3 cannot"),
                          StartsWith("polygon 7 cannot"), StartsWith("polygon 8 cannot"),
                          StartsWith("polygon 40 cannot"), "and 2 polygons more"));
  EXPECT_THAT(judged(warned, five).reasons, SizeIs(5));
}

TEST(Judge, TellsAMeshThatCameWithoutFacetsFromOneThatLostThem) {
  const auto without = [](std::size_t polygons) {
    return judged([&](MeshReport& r) {
      r.found.polygons = polygons;
      r.after.facets = 0;
    });
  };

  EXPECT_EQ(without(0).verdict, MeshVerdict::refused);
  EXPECT_THAT(without(0).reasons, ElementsAre(StartsWith("no facets; expected at least one")));
  EXPECT_THAT(without(6).reasons,
              ElementsAre(HasSubstr("none of the 6 polygons has an area; check the unit")));
}

TEST(ScaleLengths, TellsEverythingInTheUnitsAfterIt) {
  MeshReport report = judged([](MeshReport& r) {
    r.found.near_distance = 2.0;
    r.found.near_duplicate_points = 3;
    r.changed.weld_distance = 0.5;
    r.after.area = 4.0;
    r.after.volume = 8.0;
    r.after.longest_edge = 7.0;
    r.after.bounds = {Vec3(-1.0, 0.0, 2.0), Vec3(3.0, 4.0, 5.0)};
    r.reshaped = with(&Reshaped::wrap_detail, 0.25);
    r.reshaped->distance_bound = 0.125;
  });

  scale_lengths(report, 1e-3);

  EXPECT_DOUBLE_EQ(report.changed.weld_distance, 5e-4);
  EXPECT_DOUBLE_EQ(report.after.area, 4e-6);
  EXPECT_DOUBLE_EQ(*report.after.volume, 8e-9);
  EXPECT_DOUBLE_EQ(report.after.longest_edge, 7e-3);
  EXPECT_DOUBLE_EQ(report.after.bounds.upper[1], 4e-3);
  EXPECT_DOUBLE_EQ(report.reshaped->wrap_detail, 2.5e-4);
  EXPECT_EQ(report.verdict, MeshVerdict::usable_with_warnings);
  EXPECT_THAT(report.reasons, ElementsAre(HasSubstr("3 points lie within 0.002 m of another one"),
                                          HasSubstr("up to 0.000125 m away from what it was")));
}

}  // namespace
}  // namespace plekton::geometry::verdict_test

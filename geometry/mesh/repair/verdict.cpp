// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/verdict.hpp"

#include "geometry/mesh/repair/triangulate_polygon.hpp"

#include <sstream>
#include <string>

namespace plekton::geometry {
namespace {

/// "1 edge has ..." or "3 edges have ...".
std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

void add_refusals(MeshReport& report, std::span<const std::size_t> uncut) {
  constexpr std::size_t kListed = 5;
  for (std::size_t k = 0; k < uncut.size() && k < kListed; ++k)
    report.reasons.push_back(
        "polygon " + std::to_string(uncut[k]) +
        " cannot be cut into triangles: it crosses or touches itself, or has more than " +
        std::to_string(kLargestPolygon) + " corners; split it in the program that wrote the file");
  if (uncut.size() > kListed)
    report.reasons.push_back("and " + std::to_string(uncut.size() - kListed) + " polygons more");
  if (report.after.facets == 0 && report.reasons.empty())
    report.reasons.push_back(
        report.found.polygons == 0
            ? "no facets; expected at least one; export the surface as a mesh"
            : "no facets are left: none of the " + std::to_string(report.found.polygons) +
                  " polygons has an area; check the unit and the weld distance");
}

void warn_about_shape(MeshReport& report) {
  const MeshMeasures& after = report.after;
  auto& reasons = report.reasons;
  if (after.many_facet_edges > 0)
    reasons.push_back(counted(after.many_facet_edges, "edge has", "edges have") +
                      " more than two facets; they stay joined");
  if (after.non_manifold_nodes > 0)
    reasons.push_back(counted(after.non_manifold_nodes, "node joins", "nodes join") +
                      " more than one fan of facets; they stay joined");
  if (after.non_orientable_patches > 0)
    reasons.push_back(
        counted(after.non_orientable_patches, "part has", "parts have") +
        " only one side (like a Moebius band); its facets keep the sides they came with");
  else if (after.inconsistent_edges > 0)
    reasons.push_back(counted(after.inconsistent_edges, "edge has", "edges have") +
                      " facets that face opposite sides");
  if (after.self_intersections.value_or(0) > 0)
    reasons.push_back(counted(*after.self_intersections, "pair of facets intersects",
                              "pairs of facets intersect"));
  if (after.bounds_volume && !*after.bounds_volume)
    reasons.push_back(
        "the mesh is closed but bounds no volume: one closed part lies in another and faces the "
        "same way; turn the inner one over if it is a hole, or take it away");
  if (after.smallest_angle < kSmallAngle) {
    std::ostringstream text;
    text << "the smallest angle of a facet is " << after.smallest_angle
         << " deg; needles make small time steps";
    reasons.push_back(text.str());
  }
}

void warn_about_changes(MeshReport& report) {
  if (report.changed.slits > 0)
    report.reasons.push_back(
        counted(report.changed.slits, "edge is", "edges are") +
        " open where a facet without area was dropped; the nodes on both sides differ");
  if (report.found.near_duplicate_points > report.changed.points_welded) {
    std::ostringstream text;
    text << counted(report.found.near_duplicate_points - report.changed.points_welded, "point lies",
                    "points lie")
         << " within " << report.found.near_distance
         << " m of another one and stay apart; a weld distance would join them";
    report.reasons.push_back(text.str());
  }
  if (report.found.warped_polygons > 0)
    report.reasons.push_back(counted(report.found.warped_polygons, "polygon is", "polygons are") +
                             " not flat; the surface depends on how they were cut");
}

void warn_about_reshaping(MeshReport& report) {
  if (!report.reshaped) return;
  if (report.reshaped->holes_left > 0)
    report.reasons.push_back(
        counted(report.reshaped->holes_left, "hole", "holes") +
        " could not be filled: the border branches there, or its filling would "
        "repeat facets or edges that exist");
  if (report.reshaped->wrap_detail > 0.0) {
    std::ostringstream text;
    text << "the surface was wrapped: it is a closed shell now, up to "
         << report.reshaped->distance_bound << " m away from what it was";
    report.reasons.push_back(text.str());
  }
}

bool was_repaired(const MeshReport& report) {
  const MeshReport::Changed& changed = report.changed;
  const bool reshaped =
      report.reshaped && (report.reshaped->holes_filled > 0 || report.reshaped->target_edge > 0.0);
  return reshaped || changed.points_welded + changed.repeated_node_facets +
                             changed.zero_area_facets + changed.duplicate_facets +
                             changed.flipped_facets + changed.unused_points >
                         0;
}

}  // namespace

void judge(MeshReport& report, std::span<const std::size_t> uncut_polygons,
           std::span<const std::string> refusals) {
  report.reasons.assign(refusals.begin(), refusals.end());
  add_refusals(report, uncut_polygons);
  if (!report.reasons.empty()) {
    report.verdict = MeshVerdict::refused;
    return;
  }
  warn_about_shape(report);
  warn_about_changes(report);
  warn_about_reshaping(report);
  if (!report.reasons.empty())
    report.verdict = MeshVerdict::usable_with_warnings;
  else
    report.verdict = was_repaired(report) ? MeshVerdict::repaired : MeshVerdict::ok;
}

void scale_lengths(MeshReport& report, double factor) {
  for (double* const length : {&report.found.near_distance, &report.changed.weld_distance,
                               &report.changed.largest_weld_move, &report.after.shortest_edge,
                               &report.after.mean_edge, &report.after.longest_edge})
    *length *= factor;
  report.after.area *= factor * factor;
  if (report.after.volume) *report.after.volume *= factor * factor * factor;
  report.after.bounds.lower *= factor;
  report.after.bounds.upper *= factor;
  if (report.reshaped) {
    MeshReport::Reshaped& reshaped = *report.reshaped;
    for (double* const length : {&reshaped.wrap_detail, &reshaped.target_edge, &reshaped.distance,
                                 &reshaped.distance_bound})
      *length *= factor;
    reshaped.area_before *= factor * factor;
    if (reshaped.volume_before) *reshaped.volume_before *= factor * factor * factor;
  }
  if (report.verdict != MeshVerdict::refused) judge(report, {}, {});
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/report.hpp"

#include <nlohmann/json.hpp>

#include <optional>

namespace plekton::geometry {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json components(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Json found_object(const MeshReport::Found& found) {
  return {{"points", found.points},
          {"polygons", found.polygons},
          {"skipped_elements", found.skipped_elements},
          {"non_triangles", found.non_triangles},
          {"warped_polygons", found.warped_polygons},
          {"duplicate_points", found.duplicate_points},
          {"near_duplicate_points", found.near_duplicate_points},
          {"near_distance", found.near_distance},
          {"inconsistent_edges", found.inconsistent_edges}};
}

Json changed_object(const MeshReport::Changed& changed) {
  return {{"points_merged", changed.points_merged},
          {"points_welded", changed.points_welded},
          {"weld_distance", changed.weld_distance},
          {"largest_weld_move", changed.largest_weld_move},
          {"polygons_cut", changed.polygons_cut},
          {"repeated_node_facets", changed.repeated_node_facets},
          {"zero_area_facets", changed.zero_area_facets},
          {"duplicate_facets", changed.duplicate_facets},
          {"slits", changed.slits},
          {"flipped_facets", changed.flipped_facets},
          {"unused_points", changed.unused_points}};
}

Json reshaped_object(const MeshReport::Reshaped& reshaped) {
  return {{"holes_filled", reshaped.holes_filled},
          {"hole_facets", reshaped.hole_facets},
          {"holes_left", reshaped.holes_left},
          {"wrap_detail", reshaped.wrap_detail},
          {"target_edge", reshaped.target_edge},
          {"area_before", reshaped.area_before},
          {"volume_before", or_null(reshaped.volume_before)},
          {"distance", reshaped.distance},
          {"distance_bound", reshaped.distance_bound}};
}

Json after_object(const MeshMeasures& after) {
  return {{"points", after.points},
          {"facets", after.facets},
          {"edges", after.edges},
          {"border_edges", after.border_edges},
          {"many_facet_edges", after.many_facet_edges},
          {"inconsistent_edges", after.inconsistent_edges},
          {"non_manifold_nodes", after.non_manifold_nodes},
          {"components", after.components},
          {"non_orientable_patches", after.non_orientable_patches},
          {"euler_characteristic", after.euler_characteristic},
          {"closed", after.closed},
          {"bounds_volume", or_null(after.bounds_volume)},
          {"self_intersections", or_null(after.self_intersections)},
          {"area", after.area},
          {"volume", or_null(after.volume)},
          {"smallest_angle", after.smallest_angle},
          {"shortest_edge", after.shortest_edge},
          {"mean_edge", after.mean_edge},
          {"longest_edge", after.longest_edge},
          {"lower", components(after.bounds.lower)},
          {"upper", components(after.bounds.upper)}};
}

}  // namespace

std::string to_json(const MeshReport& report) {
  const Json json = {{"source", report.source},
                     {"verdict", name_of(report.verdict)},
                     {"reasons", report.reasons},
                     {"found", found_object(report.found)},
                     {"changed", changed_object(report.changed)},
                     {"reshaped", report.reshaped ? reshaped_object(*report.reshaped) : Json()},
                     {"after", after_object(report.after)}};
  // The name of a file need not be UTF-8; what is not becomes a replacement character.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace plekton::geometry

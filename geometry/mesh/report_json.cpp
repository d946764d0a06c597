// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/report.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>

namespace plekton::geometry {
namespace {

std::string json(bool value) {
  return value ? "true" : "false";
}

std::string json(std::integral auto value) {
  return std::to_string(value);
}

std::string json(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

std::string json(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      (quoted += '\\') += c;
    } else if (byte < 0x20) {
      ((quoted += "\\u00") += kHex[byte >> 4]) += kHex[byte & 15];
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string json(const Vec3& v) {
  return "[" + json(v[0]) + ", " + json(v[1]) + ", " + json(v[2]) + "]";
}

template <class Value>
std::string json(const std::optional<Value>& value) {
  return value ? json(*value) : "null";
}

/// The members of an object, one a line.
class Object {
 public:
  explicit Object(int depth) : indent_(2 * static_cast<std::size_t>(depth), ' ') {}
  template <class Value>
  Object& add(std::string_view key, const Value& value) {
    return add_raw(key, json(value));
  }
  Object& add_raw(std::string_view key, const std::string& value) {
    members_ += (members_.empty() ? "\n" : ",\n") + indent_ + "  " + json(key) + ": " + value;
    return *this;
  }
  std::string text() const { return "{" + members_ + "\n" + indent_ + "}"; }

 private:
  std::string indent_;
  std::string members_;
};

std::string found_object(const MeshReport::Found& found) {
  return Object(1)
      .add("points", found.points)
      .add("polygons", found.polygons)
      .add("skipped_elements", found.skipped_elements)
      .add("non_triangles", found.non_triangles)
      .add("warped_polygons", found.warped_polygons)
      .add("duplicate_points", found.duplicate_points)
      .add("near_duplicate_points", found.near_duplicate_points)
      .add("near_distance", found.near_distance)
      .add("inconsistent_edges", found.inconsistent_edges)
      .text();
}

std::string changed_object(const MeshReport::Changed& changed) {
  return Object(1)
      .add("points_merged", changed.points_merged)
      .add("points_welded", changed.points_welded)
      .add("weld_distance", changed.weld_distance)
      .add("largest_weld_move", changed.largest_weld_move)
      .add("polygons_cut", changed.polygons_cut)
      .add("repeated_node_facets", changed.repeated_node_facets)
      .add("zero_area_facets", changed.zero_area_facets)
      .add("duplicate_facets", changed.duplicate_facets)
      .add("slits", changed.slits)
      .add("flipped_facets", changed.flipped_facets)
      .add("unused_points", changed.unused_points)
      .text();
}

std::string reshaped_object(const MeshReport::Reshaped& reshaped) {
  return Object(1)
      .add("holes_filled", reshaped.holes_filled)
      .add("hole_facets", reshaped.hole_facets)
      .add("holes_left", reshaped.holes_left)
      .add("wrap_detail", reshaped.wrap_detail)
      .add("target_edge", reshaped.target_edge)
      .add("area_before", reshaped.area_before)
      .add("volume_before", reshaped.volume_before)
      .add("distance", reshaped.distance)
      .add("distance_bound", reshaped.distance_bound)
      .text();
}

std::string after_object(const MeshMeasures& after) {
  return Object(1)
      .add("points", after.points)
      .add("facets", after.facets)
      .add("edges", after.edges)
      .add("border_edges", after.border_edges)
      .add("many_facet_edges", after.many_facet_edges)
      .add("inconsistent_edges", after.inconsistent_edges)
      .add("non_manifold_nodes", after.non_manifold_nodes)
      .add("components", after.components)
      .add("non_orientable_patches", after.non_orientable_patches)
      .add("euler_characteristic", after.euler_characteristic)
      .add("closed", after.closed)
      .add("bounds_volume", after.bounds_volume)
      .add("self_intersections", after.self_intersections)
      .add("area", after.area)
      .add("volume", after.volume)
      .add("smallest_angle", after.smallest_angle)
      .add("shortest_edge", after.shortest_edge)
      .add("mean_edge", after.mean_edge)
      .add("longest_edge", after.longest_edge)
      .add("lower", after.bounds.lower)
      .add("upper", after.bounds.upper)
      .text();
}

}  // namespace

std::string to_json(const MeshReport& report) {
  std::string reasons;
  for (const std::string& reason : report.reasons)
    reasons += (reasons.empty() ? "" : ", ") + json(std::string_view(reason));
  return Object(0)
             .add("source", std::string_view(report.source))
             .add("verdict", name_of(report.verdict))
             .add_raw("reasons", "[" + reasons + "]")
             .add_raw("found", found_object(report.found))
             .add_raw("changed", changed_object(report.changed))
             .add_raw("reshaped", report.reshaped ? reshaped_object(*report.reshaped) : "null")
             .add_raw("after", after_object(report.after))
             .text() +
         "\n";
}

}  // namespace plekton::geometry

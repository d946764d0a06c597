// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/report.hpp"

#include <array>
#include <iomanip>
#include <optional>
#include <sstream>

namespace plekton::geometry {
namespace {

constexpr int kLabelWidth = 40;

class Table {
 public:
  Table() { out_ << std::setprecision(6); }
  void heading(std::string_view text) { out_ << text << '\n'; }
  template <class Value>
  void row(std::string_view label, const Value& value, std::string_view unit = "") {
    out_ << "  " << std::left << std::setw(kLabelWidth) << label << value;
    if (!unit.empty()) out_ << ' ' << unit;
    out_ << '\n';
  }
  /// A row for something that is only worth a line when there is any of it.
  void row_if(std::string_view label, std::size_t count) {
    if (count > 0) row(label, count);
  }
  template <class Value>
  void row_if(std::string_view label, const std::optional<Value>& value,
              std::string_view unit = "") {
    if (value) row(label, *value, unit);
  }
  std::string text() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

std::string yes_or_no(bool value) {
  return value ? "yes" : "no";
}

void add_found(Table& table, const MeshReport::Found& found) {
  table.heading("found");
  table.row("points", found.points);
  table.row("polygons", found.polygons);
  table.row_if("points, lines and solids left out", found.skipped_elements);
  table.row_if("polygons that are no triangles", found.non_triangles);
  table.row_if("polygons that are not flat", found.warped_polygons);
  table.row_if("points equal to another", found.duplicate_points);
  if (found.near_duplicate_points > 0) {
    table.row("points close to another", found.near_duplicate_points);
    table.row("  within", found.near_distance, "m");
  }
  table.row_if("edges whose facets disagree", found.inconsistent_edges);
}

void add_changed(Table& table, const MeshReport::Changed& changed) {
  table.heading("changed");
  table.row_if("equal points merged", changed.points_merged);
  if (changed.points_welded > 0) {
    table.row("points welded", changed.points_welded);
    table.row("  within", changed.weld_distance, "m");
    table.row("  largest move", changed.largest_weld_move, "m");
  }
  table.row_if("polygons cut into triangles", changed.polygons_cut);
  table.row_if("facets dropped, nodes repeated", changed.repeated_node_facets);
  table.row_if("facets dropped, no area", changed.zero_area_facets);
  table.row_if("facets dropped, duplicate", changed.duplicate_facets);
  table.row_if("edges opened by dropped facets", changed.slits);
  table.row_if("facets turned over", changed.flipped_facets);
  table.row_if("unused points removed", changed.unused_points);
}

void add_reshaped(Table& table, const MeshReport::Reshaped& reshaped) {
  table.heading("reshaped");
  table.row_if("holes filled", reshaped.holes_filled);
  table.row_if("  with facets", reshaped.hole_facets);
  table.row_if("holes that stay open", reshaped.holes_left);
  if (reshaped.wrap_detail > 0.0) table.row("wrapped, detail", reshaped.wrap_detail, "m");
  if (reshaped.target_edge > 0.0) table.row("remeshed, target edge", reshaped.target_edge, "m");
  table.row("area before", reshaped.area_before, "m2");
  table.row_if("volume before", reshaped.volume_before, "m3");
  table.row("distance of old and new surface", reshaped.distance, "m");
  table.row("  at most", reshaped.distance_bound, "m");
}

void add_after(Table& table, const MeshMeasures& after) {
  table.heading("after");
  table.row("points", after.points);
  table.row("facets", after.facets);
  table.row("edges", after.edges);
  table.row("border edges", after.border_edges);
  table.row_if("edges with more than two facets", after.many_facet_edges);
  table.row_if("edges whose facets disagree", after.inconsistent_edges);
  table.row_if("nodes that are not manifold", after.non_manifold_nodes);
  table.row("parts", after.components);
  table.row("Euler characteristic", after.euler_characteristic);
  table.row("orientable", yes_or_no(after.non_orientable_patches == 0));
  table.row("closed", yes_or_no(after.closed));
  if (after.bounds_volume) table.row("bounds a volume", yes_or_no(*after.bounds_volume));
  table.row_if("pairs of facets that intersect", after.self_intersections);
  table.row("area", after.area, "m2");
  table.row_if("volume", after.volume, "m3");
  table.row("smallest angle", after.smallest_angle, "deg");
  table.row("shortest edge", after.shortest_edge, "m");
  table.row("mean edge", after.mean_edge, "m");
  table.row("longest edge", after.longest_edge, "m");
  const Vec3 size = after.bounds.upper - after.bounds.lower;
  std::ostringstream text;
  text << size[0] << " x " << size[1] << " x " << size[2];
  table.row("size", text.str(), "m");
}

}  // namespace

std::string_view name_of(MeshVerdict verdict) noexcept {
  constexpr std::array<std::string_view, 4> kNames = {"ok", "repaired", "usable with warnings",
                                                      "refused"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string to_text(const MeshReport& report) {
  Table table;
  table.heading(report.source);
  add_found(table, report.found);
  add_changed(table, report.changed);
  if (report.reshaped) add_reshaped(table, *report.reshaped);
  if (report.after.facets > 0) add_after(table, report.after);
  table.heading("verdict: " + std::string(name_of(report.verdict)));
  for (const std::string& reason : report.reasons) table.heading("  - " + reason);
  return table.text();
}

}  // namespace plekton::geometry

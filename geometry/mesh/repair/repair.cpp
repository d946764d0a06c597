// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/repair.hpp"

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/repair/close_slits.hpp"
#include "geometry/mesh/repair/exact_signs.hpp"
#include "geometry/mesh/repair/orientation.hpp"
#include "geometry/mesh/repair/reshape.hpp"
#include "geometry/mesh/repair/triangulate_polygon.hpp"
#include "geometry/mesh/repair/verdict.hpp"
#include "geometry/mesh/repair/weld.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

constexpr double kWarpLimit = 0.05;           // of the size of a polygon
constexpr double kNearDuplicateLimit = 1e-6;  // of the diagonal of the bounds

double diagonal(std::span<const Vec3> points) {
  if (points.empty()) return 0.0;
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return (upper - lower).norm();
}

void replace_points(PolygonSoup& soup, const Weld& weld) {
  soup.points = weld.position;
  for (auto& polygon : soup.polygons)
    for (std::size_t& corner : polygon) corner = weld.representative[corner];
}

/// Points that no polygon names cost nothing later, so merged ones stay in place until the end.
void weld_points(PolygonSoup& soup, const RepairOptions& options, MeshReport& report) {
  const Weld equal = weld_equal_points(soup.points);
  report.found.duplicate_points = report.changed.points_merged = equal.merged;
  replace_points(soup, equal);

  report.found.near_distance = kNearDuplicateLimit * diagonal(soup.points);
  if (report.found.near_distance > 0.0)
    report.found.near_duplicate_points =
        weld_near_points(soup.points, report.found.near_distance).merged - equal.merged;

  report.changed.weld_distance = options.weld_distance;
  if (options.weld_distance == 0.0) return;
  const Weld near = weld_near_points(soup.points, options.weld_distance);
  report.changed.points_welded = near.merged - equal.merged;
  report.changed.largest_weld_move = near.largest_move;
  replace_points(soup, near);
}

/// A polygon without corners that repeat their predecessor.
std::vector<std::size_t> distinct_corners(const std::vector<std::size_t>& polygon) {
  std::vector<std::size_t> corners;
  std::unique_copy(polygon.begin(), polygon.end(), std::back_inserter(corners));
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

bool all_collinear(std::span<const Vec3> x) {
  for (std::size_t i = 2; i < x.size(); ++i)
    if (!are_collinear(x[0], x[1], x[i])) return false;
  return true;
}

NodeId node_at(std::size_t point) {
  return id_at<NodeId>(point);
}

/// Cuts polygons into facets and drops the degenerate ones, which are kept aside for the count of
/// slits.
class FacetCutter {
 public:
  FacetCutter(const PolygonSoup& soup, MeshReport& report) : soup_(soup), report_(report) {}

  void add(std::size_t polygon) {
    const auto corners = distinct_corners(soup_.polygons[polygon]);
    if (corners.size() < 3) {
      ++report_.changed.repeated_node_facets;
      return;
    }
    x_.clear();
    for (const std::size_t corner : corners) x_.push_back(soup_.points[corner]);
    if (all_collinear(x_)) {
      ++report_.changed.zero_area_facets;
      dropped_.push_back(corners);
      return;
    }
    if (corners.size() > 3) note_polygon();
    const auto triangles = triangulate_polygon(x_);
    if (!triangles) {
      refused_.push_back(polygon);
      return;
    }
    for (const auto& [a, b, c] : *triangles)
      facets_.push_back({node_at(corners[a]), node_at(corners[b]), node_at(corners[c])});
  }

  std::vector<std::array<NodeId, 3>> take_facets() { return std::move(facets_); }
  const std::vector<std::vector<std::size_t>>& dropped() const { return dropped_; }
  const std::vector<std::size_t>& refused() const { return refused_; }

 private:
  void note_polygon() {
    ++report_.changed.polygons_cut;
    if (warp(x_) > kWarpLimit * diagonal(x_)) ++report_.found.warped_polygons;
  }

  const PolygonSoup& soup_;
  MeshReport& report_;
  std::vector<Vec3> x_;
  std::vector<std::array<NodeId, 3>> facets_;
  std::vector<std::vector<std::size_t>> dropped_;
  std::vector<std::size_t> refused_;
};

/// Keeps the first of the facets over the same three nodes.
void drop_duplicates(Mesh& mesh, MeshReport& report) {
  std::vector<std::pair<std::array<NodeId, 3>, std::size_t>> keys;
  keys.reserve(mesh.facets.size());
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    auto nodes = mesh.facets[f];
    std::sort(nodes.begin(), nodes.end());
    keys.emplace_back(nodes, f);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> duplicate(mesh.facets.size(), false);
  for (std::size_t k = 1; k < keys.size(); ++k)
    duplicate[keys[k].second] = keys[k - 1].first == keys[k].first;

  std::vector<std::array<NodeId, 3>> kept;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (!duplicate[f]) kept.push_back(mesh.facets[f]);
  report.changed.duplicate_facets = mesh.facets.size() - kept.size();
  mesh.facets = std::move(kept);
}

/// Of dropped facets those that can be flipped.
std::vector<std::array<NodeId, 3>> triangles_of(
    const std::vector<std::vector<std::size_t>>& dropped) {
  std::vector<std::array<NodeId, 3>> triangles;
  for (const auto& corners : dropped) {
    if (corners.size() == 3)
      triangles.push_back({node_at(corners[0]), node_at(corners[1]), node_at(corners[2])});
  }
  return triangles;
}

/// Sides of dropped facets that are a border now.
std::size_t count_slits(const EdgeTable& edges,
                        const std::vector<std::vector<std::size_t>>& dropped) {
  std::vector<std::array<NodeId, 2>> sides;
  for (const auto& corners : dropped) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const NodeId a = node_at(corners[k]), b = node_at(corners[(k + 1) % corners.size()]);
      sides.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return static_cast<std::size_t>(std::count_if(sides.begin(), sides.end(), [&](const auto& side) {
    const auto found = std::lower_bound(edges.edges().begin(), edges.edges().end(), side);
    if (found == edges.edges().end() || *found != side) return false;
    return edges.uses(static_cast<std::size_t>(found - edges.edges().begin())).size() == 1;
  }));
}

void orient(Mesh& mesh, const EdgeTable& edges, bool wanted, MeshReport& report) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() == 2 && uses[0].forward == uses[1].forward) ++report.found.inconsistent_edges;
  }
  if (!wanted) return;
  const Orientation orientation = find_orientation(mesh, edges);
  report.changed.flipped_facets = orientation.flipped;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (orientation.flip[f]) std::swap(mesh.facets[f][1], mesh.facets[f][2]);
}

/// Closes the gaps in the numbers of the nodes. Merged points were counted as such already.
void remove_unused_points(Mesh& mesh, MeshReport& report) {
  std::vector<std::size_t> number(mesh.points.size(), 0);
  for (const auto& facet : mesh.facets)
    for (const NodeId node : facet) number[index_of(node)] = 1;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) continue;
    number[i] = points.size();
    points.push_back(mesh.points[i]);
  }
  for (auto& facet : mesh.facets)
    for (NodeId& node : facet) node = node_at(number[index_of(node)]);
  report.changed.unused_points = mesh.points.size() - points.size() - report.changed.points_merged -
                                 report.changed.points_welded;
  mesh.points = std::move(points);
}

void require_usable_options(const PolygonSoup& soup, const RepairOptions& options,
                            const std::string& name) {
  if (!(options.weld_distance >= 0.0) || !std::isfinite(options.weld_distance))
    throw MeshError(name + ": a weld distance of " + std::to_string(options.weld_distance) +
                    " m; expected a length of 0 (only equal points) or more");
  if (!(options.longest_hole >= 0.0))
    throw MeshError(name + ": a longest hole of " + std::to_string(options.longest_hole) +
                    " m; expected a length of 0 or more, infinite for all");
  if (!(options.wrap_detail >= 0.0) || !std::isfinite(options.wrap_detail))
    throw MeshError(name + ": a wrap detail of " + std::to_string(options.wrap_detail) +
                    " m; expected a positive length, or 0 for 1/30 of the size of the mesh");
  constexpr auto kMostNodes = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (soup.points.size() > kMostNodes || soup.polygons.size() > kMostNodes)
    throw MeshError(name + ": more than 2147483647 points or polygons; split the mesh");
}

MeshReport start_report(const PolygonSoup& soup, const std::string& source) {
  MeshReport report;
  report.source = source.empty() ? "mesh" : source;
  report.found.points = soup.points.size();
  report.found.polygons = soup.polygons.size();
  report.found.skipped_elements = soup.skipped_elements;
  report.found.non_triangles = static_cast<std::size_t>(
      std::count_if(soup.polygons.begin(), soup.polygons.end(),
                    [](const auto& polygon) { return polygon.size() != 3; }));
  return report;
}

}  // namespace

Mesh repair(const PolygonSoup& input, const RepairOptions& options, MeshReport& report) {
  report = start_report(input, report.source);
  require_usable_options(input, options, report.source);
  check_soup(input, report.source);

  PolygonSoup soup = input;
  options.tell("joining points");
  weld_points(soup, options, report);
  options.tell("cutting polygons into facets");
  FacetCutter cutter(soup, report);
  for (std::size_t polygon = 0; polygon < soup.polygons.size(); ++polygon) cutter.add(polygon);

  Mesh mesh{std::move(soup.points), cutter.take_facets()};
  drop_duplicates(mesh, report);
  close_slits(mesh, triangles_of(cutter.dropped()));
  {
    options.tell("orienting facets");
    const EdgeTable edges(mesh);
    report.changed.slits = count_slits(edges, cutter.dropped());
    orient(mesh, edges, options.orient, report);
  }
  remove_unused_points(mesh, report);
  std::vector<std::string> refusals;
  if (!mesh.facets.empty() && cutter.refused().empty()) refusals = reshape(mesh, options, report);
  options.tell("measuring, and looking for facets that intersect");
  report.after = measure(mesh, options.find_intersections || options.refuse_intersections);
  if (options.refuse_intersections && report.after.self_intersections.value_or(0) > 0)
    refusals.push_back(std::to_string(*report.after.self_intersections) +
                       " pairs of facets intersect; correct the mesh or wrap it");
  judge(report, cutter.refused(), refusals);
  return mesh;
}

}  // namespace plekton::geometry

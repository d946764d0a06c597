// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/descent.hpp"

#include "geometry/base/predicates.hpp"
#include "geometry/closest/foot_point.hpp"

#include <algorithm>
#include <array>

namespace plekton::geometry {
namespace {

NodeId opposite_corner(const Surface& surface, FaceId face,
                       const std::array<NodeId, 2>& side) noexcept {
  const auto& n = surface.nodes_of(face);
  return *std::find_if(n.begin(), n.end(),
                       [&](NodeId node) { return node != side[0] && node != side[1]; });
}

Feature closest_on_edge(const Surface& surface, EdgeId edge, const Vec3& point,
                        Positions x) noexcept {
  const auto& [a, b] = surface.nodes_of(edge);
  if (sign_past_vertex(x[index_of(a)], x[index_of(b)], point) <= 0) return Feature(a);
  if (sign_past_vertex(x[index_of(b)], x[index_of(a)], point) <= 0) return Feature(b);
  return Feature(edge);
}

Feature closest_on_face(const Surface& surface, FaceId face, const Vec3& point,
                        Positions x) noexcept {
  const auto& n = surface.nodes_of(face);
  const auto& sides = surface.edges_of(face);
  std::array<bool, 3> outside{};
  for (std::size_t k = 0; k < 3; ++k) {
    outside[k] = sign_inside_edge(x[index_of(n[k])], x[index_of(n[(k + 1) % 3])],
                                  x[index_of(n[(k + 2) % 3])], point) <= 0;
  }
  if (!outside[0] && !outside[1] && !outside[2]) return Feature(face);

  // Corners before sides, and the lowest of several: only a facet without area has a choice.
  Feature lowest(face);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& corner = x[index_of(n[k])];
    if (sign_past_vertex(corner, x[index_of(n[(k + 1) % 3])], point) <= 0 &&
        sign_past_vertex(corner, x[index_of(n[(k + 2) % 3])], point) <= 0) {
      lowest = std::min(lowest, Feature(n[k]));
    }
  }
  if (lowest.kind == FeatureKind::node) return lowest;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!outside[k]) continue;
    const Feature foot = closest_on_edge(surface, sides[k], point, x);
    if (foot.kind == FeatureKind::edge) lowest = std::min(lowest, foot);
  }
  return lowest;
}

}  // namespace

Feature closest_feature(const Surface& surface, Feature cell, const Vec3& point,
                        Positions x) noexcept {
  switch (cell.kind) {
    case FeatureKind::face:
      return closest_on_face(surface, FaceId{cell.id}, point, x);
    case FeatureKind::edge:
      return closest_on_edge(surface, EdgeId{cell.id}, point, x);
    case FeatureKind::node:
      break;
  }
  return cell;
}

SurfaceFoot foot_on(const Surface& surface, Feature feature, const Vec3& point,
                    Positions x) noexcept {
  const auto at = [&](const CorePoint& core, const FootPoint& foot) {
    return SurfaceFoot{{core.nodes, foot.weights, core.feature}, foot.direction, foot.distance};
  };
  const auto corner = [&](const auto& nodes, std::size_t i) { return x[index_of(nodes[i])]; };
  if (feature.kind == FeatureKind::node) {
    const NodeId node{feature.id};
    return at(core_point(node), foot_on_node(point, x[index_of(node)]));
  }
  if (feature.kind == FeatureKind::edge) {
    const auto& n = surface.nodes_of(EdgeId{feature.id});
    return at({{n[0], n[1], n[0]}, {}, feature}, foot_on_edge(point, {corner(n, 0), corner(n, 1)}));
  }
  const auto& n = surface.nodes_of(FaceId{feature.id});
  return at({n, {}, feature}, foot_on_face(point, {corner(n, 0), corner(n, 1), corner(n, 2)}));
}

Feature nearer_cell(const Surface& surface, Feature first, Feature second, const Vec3& point,
                    Positions x) noexcept {
  const auto distance_to = [&](Feature cell) {
    return foot_on(surface, closest_feature(surface, cell, point, x), point, x).distance;
  };
  return distance_to(second) < distance_to(first) ? second : first;
}

Feature downhill_from(const Surface& surface, Feature feature, const Vec3& point,
                      Positions x) noexcept {
  Feature next = feature;
  const auto offer = [&](Feature cell) {
    next = next == feature ? cell : nearer_cell(surface, next, cell, point, x);
  };
  if (feature.kind == FeatureKind::edge) {
    const EdgeId edge{feature.id};
    const auto& ends = surface.nodes_of(edge);
    for (const FaceId face : surface.faces_of(edge)) {
      const Vec3& opposite = x[index_of(opposite_corner(surface, face, ends))];
      if (sign_inside_edge(x[index_of(ends[0])], x[index_of(ends[1])], opposite, point) > 0)
        offer(Feature(face));
    }
  } else if (feature.kind == FeatureKind::node) {
    const NodeId node{feature.id};
    for (const EdgeId edge : surface.edges_of(node)) {
      const auto& ends = surface.nodes_of(edge);
      const NodeId other = ends[0] == node ? ends[1] : ends[0];
      if (sign_past_vertex(x[index_of(node)], x[index_of(other)], point) > 0) offer(Feature(edge));
    }
  }
  return next;
}

Feature descend(const Surface& surface, Feature start, const Vec3& point, Positions x) noexcept {
  Feature foot = closest_feature(surface, start, point, x);
  while (true) {
    const Feature next = downhill_from(surface, foot, point, x);
    if (next == foot) return foot;
    foot = closest_feature(surface, next, point, x);
  }
}

}  // namespace plekton::geometry

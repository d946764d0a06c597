// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/primitive_pairs.hpp"

#include <utility>

namespace plekton::geometry {
namespace {

/// Corners of a primitive's core, by ascending node id.
struct Side {
  Core core;
  std::array<NodeId, 3> nodes;
  double radius;
};

Side side_of(const PlacedSurface& on, CellId cell) {
  Side side{{}, {}, on.surface.radius(on.surface.structure_of(cell))};
  const auto nodes = on.surface.nodes_of(cell);
  for (const NodeId node : nodes) {
    std::size_t k = side.core.count++;
    for (; k > 0 && node < side.nodes[k - 1]; --k) side.nodes[k] = side.nodes[k - 1];
    side.nodes[k] = node;
  }
  for (std::size_t k = 0; k < side.core.count; ++k) side.core.x[k] = on.x[index_of(side.nodes[k])];
  return side;
}

NodeId node_at(const Side& side, unsigned corner) {
  return side.nodes[corner == 1U ? 0U : corner == 2U ? 1U : 2U];
}

/// The side of a facet between two of its nodes.
EdgeId edge_between(const Surface& surface, FaceId face, NodeId first, NodeId last) {
  const auto& edges = surface.edges_of(face);
  for (const EdgeId edge : edges) {
    const auto& ends = surface.nodes_of(edge);
    if (ends[0] == first && ends[1] == last) return edge;
  }
  return edges[0];  // not reached: both are nodes of the face
}

CorePoint core_point_of(const Surface& surface, CellId cell, const Side& side, unsigned corners,
                        const Vec3& weights) {
  const Feature whole = surface.feature_of(cell);
  if (corners == 7U) {
    const FaceId face{whole.id};
    const auto& nodes = surface.nodes_of(face);
    Vec3 in_order;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (nodes[i] == side.nodes[k]) in_order[static_cast<int>(i)] = weights[static_cast<int>(k)];
      }
    }
    return {nodes, in_order, whole};
  }
  if (corners == 1U || corners == 2U || corners == 4U) return core_point(node_at(side, corners));
  const std::size_t first = corners == 6U ? 1 : 0;
  const std::size_t last = corners == 3U ? 1 : 2;
  const std::array ends{side.nodes[first], side.nodes[last]};
  const Feature edge = whole.kind == FeatureKind::edge
                           ? whole
                           : Feature(edge_between(surface, FaceId{whole.id}, ends[0], ends[1]));
  return {{ends[0], ends[1], ends[0]},
          Vec3(weights[static_cast<int>(first)], weights[static_cast<int>(last)], 0.0),
          edge};
}

Proximity between(const CorePoint& a, double radius_a, const CorePoint& b, double radius_b,
                  const CoreProximity& cores) {
  const double gap = cores.signed_distance - radius_a - radius_b;
  return {
      a, b, cores.normal, gap, radius_a + 0.5 * gap, radius_b + 0.5 * gap, cores.points.relation};
}

CorePoint core_point_of(const Core& probe, unsigned corners, const Vec3& weights) {
  const std::array nodes{NodeId{0}, probe.count > 1 ? NodeId{1} : NodeId{0},
                         probe.count > 2 ? NodeId{2} : NodeId{0}};
  switch (corners) {
    case 3U:
      return {nodes, weights, Feature(EdgeId{0})};
    case 6U:
      return {nodes, weights, Feature(EdgeId{1})};
    case 5U:
      return {nodes, weights, Feature(EdgeId{2})};
    case 7U:
      return {nodes, weights, Feature(FaceId{0})};
    default:
      return {nodes, weights, Feature(NodeId{corners == 4U ? 2 : static_cast<int>(corners) - 1})};
  }
}

}  // namespace

Proximity proximity(const Sphere& a, const Sphere& b, Positions x) noexcept {
  const NodeId node_a = a.nodes[0];
  const NodeId node_b = b.nodes[0];
  const CoreProximity cores =
      core_proximity({{x[index_of(node_a)]}, 1}, {{x[index_of(node_b)]}, 1});
  return between(core_point(node_a), a.radius, core_point(node_b), b.radius, cores);
}

Proximity proximity(const Sphere& a, const Surface& surface, CellId cell, Positions x) noexcept {
  const NodeId centre = a.nodes[0];
  Proximity found =
      proximity(Probe::ball(x[index_of(centre)], a.radius), PlacedSurface{surface, x}, cell);
  found.a = core_point(centre);
  return found;
}

Proximity proximity(const Surface& surface, CellId a, CellId b, Positions x) noexcept {
  const PlacedSurface placed{surface, x};
  return proximity(placed, a, placed, b);
}

Proximity proximity(const PlacedSurface& on_a, CellId a, const PlacedSurface& on_b,
                    CellId b) noexcept {
  const Side side_a = side_of(on_a, a);
  const Side side_b = side_of(on_b, b);
  const CoreProximity cores = core_proximity(side_a.core, side_b.core);
  const ClosestPoints& points = cores.points;
  return between(core_point_of(on_a.surface, a, side_a, points.corners_a, points.weights_a),
                 side_a.radius,
                 core_point_of(on_b.surface, b, side_b, points.corners_b, points.weights_b),
                 side_b.radius, cores);
}

Proximity proximity(const Probe& a, const PlacedSurface& on_b, CellId b) noexcept {
  const Side side_b = side_of(on_b, b);
  const CoreProximity cores = core_proximity(a.core, side_b.core);
  const ClosestPoints& points = cores.points;
  return between(core_point_of(a.core, points.corners_a, points.weights_a), a.radius,
                 core_point_of(on_b.surface, b, side_b, points.corners_b, points.weights_b),
                 side_b.radius, cores);
}

Proximity proximity(const Probe& a, const Probe& b) noexcept {
  const CoreProximity cores = core_proximity(a.core, b.core);
  const ClosestPoints& points = cores.points;
  return between(core_point_of(a.core, points.corners_a, points.weights_a), a.radius,
                 core_point_of(b.core, points.corners_b, points.weights_b), b.radius, cores);
}

}  // namespace plekton::geometry

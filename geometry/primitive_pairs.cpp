// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitive_pairs.hpp"

#include "geometry/descent.hpp"
#include "geometry/foot_point.hpp"

namespace plekton::geometry {
namespace {

Proximity between(const CorePoint& a, double radius_a, const CorePoint& b, double radius_b,
                  const FootPoint& foot) noexcept {
  const double gap = foot.distance - radius_a - radius_b;
  return {a, b, foot.direction, gap, radius_a + 0.5 * gap, radius_b + 0.5 * gap};
}

}  // namespace

Proximity proximity(const Sphere& a, const Sphere& b, Positions x) noexcept {
  const NodeId node_a = a.nodes[0];
  const NodeId node_b = b.nodes[0];
  const FootPoint foot = foot_on_node(x[index_of(node_a)], x[index_of(node_b)]);
  return between(core_point(node_a), a.radius, core_point(node_b), b.radius, foot);
}

Proximity proximity(const Sphere& a, const Surface& surface, CellId cell, Positions x) noexcept {
  const Vec3& centre = x[index_of(a.nodes[0])];
  const double radius = surface.radius(surface.structure_of(cell));
  const Feature feature = closest_feature(surface, surface.feature_of(cell), centre, x);
  const auto answer = [&](const std::array<NodeId, 3>& nodes, const FootPoint& foot) {
    return between(core_point(a.nodes[0]), a.radius, {nodes, foot.weights, feature}, radius, foot);
  };
  switch (feature.kind) {
    case FeatureKind::face: {
      const auto& n = surface.nodes_of(FaceId{feature.id});
      return answer(
          n, foot_on_face(centre, {x[index_of(n[0])], x[index_of(n[1])], x[index_of(n[2])]}));
    }
    case FeatureKind::edge: {
      const auto& n = surface.nodes_of(EdgeId{feature.id});
      return answer({n[0], n[1], n[0]},
                    foot_on_edge(centre, {x[index_of(n[0])], x[index_of(n[1])]}));
    }
    case FeatureKind::node:
      break;
  }
  const NodeId node{feature.id};
  return answer({node, node, node}, foot_on_node(centre, x[index_of(node)]));
}

}  // namespace plekton::geometry

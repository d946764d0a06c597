// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/critical_features.hpp"

#include "geometry/base/predicates.hpp"
#include "geometry/closest/foot_point.hpp"
#include "geometry/critical/descent.hpp"
#include "geometry/primitives/cell_clearance.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::geometry {
namespace {

constexpr DescendingLink kFootOutside{0, -1};

/// Room for rounding in the quick range tests below: relative error of a squared length from
/// coordinate differences.
constexpr double kRoom = 1.0 + 1e-12;

std::array<Vec3, 2> corners(const Surface& surface, EdgeId edge, Positions x) {
  const auto& n = surface.nodes_of(edge);
  return {x[index_of(n[0])], x[index_of(n[1])]};
}

std::array<Vec3, 3> corners(const Surface& surface, FaceId face, Positions x) {
  const auto& n = surface.nodes_of(face);
  return {x[index_of(n[0])], x[index_of(n[1])], x[index_of(n[2])]};
}

/// Whether the line through a segment is surely farther than range from a point.
bool line_is_beyond(const Vec3& point, const std::array<Vec3, 2>& x, double range) noexcept {
  const Vec3 u = x[1] - x[0];
  const Vec3 w = point - x[0];
  const double along = w.dot(u);
  const double w_squared = w.squaredNorm();
  // |w|² - along²/|u|² > range², with the rounding of both terms on the safe side.
  return (w_squared - range * range * kRoom) * u.squaredNorm() >
         along * along + 1e-12 * w_squared * u.squaredNorm();
}

}  // namespace

std::span<const CriticalFeature> CriticalFeatureFinder::find(const Vec3& point, double range,
                                                             std::span<const CellId> cells,
                                                             Positions x) {
  found_.clear();
  for (const CellId cell : cells) {
    const Feature feature = surface_->feature_of(cell);
    if (feature.kind == FeatureKind::face) {
      const FaceId face{feature.id};
      const FaceView view(point, corners(*surface_, face, x));
      if (view.is_beyond(range)) continue;
      const FootPlace place = view.place();
      if (place == FootPlace::inside ||
          (place == FootPlace::uncertain && face_link(face, point, x).coefficient != 0)) {
        find_on_face(face, point, range, x);
      }
      for (const EdgeId edge : surface_->edges_of(face)) {
        if (surface_->owner_of(edge) == cell) find_on_edge(edge, point, range, x);
      }
    } else {
      find_on_edge(EdgeId{feature.id}, point, range, x);
    }
    for (const NodeId node : surface_->nodes_of(cell)) {
      if (surface_->owner_of(node) == cell) find_on_node(node, point, range, x);
    }
  }
  return found_;
}

DescendingLink CriticalFeatureFinder::link(Feature feature, const Vec3& point, Positions x) {
  switch (feature.kind) {
    case FeatureKind::face:
      return face_link(FaceId{feature.id}, point, x);
    case FeatureKind::edge:
      return edge_link(EdgeId{feature.id}, point, x);
    case FeatureKind::node:
      break;
  }
  return node_link(NodeId{feature.id}, point, x);
}

DescendingLink CriticalFeatureFinder::face_link(FaceId face, const Vec3& point, Positions x) const {
  const auto c = corners(*surface_, face, x);
  const bool inside = sign_inside_edge(c[0], c[1], c[2], point) > 0 &&
                      sign_inside_edge(c[1], c[2], c[0], point) > 0 &&
                      sign_inside_edge(c[2], c[0], c[1], point) > 0;
  return inside ? DescendingLink{1, 0} : kFootOutside;
}

DescendingLink CriticalFeatureFinder::edge_link(EdgeId edge, const Vec3& point, Positions x) const {
  const auto [a, b] = corners(*surface_, edge, x);
  if (sign_past_vertex(a, b, point) <= 0 || sign_past_vertex(b, a, point) <= 0) return kFootOutside;
  int falling_facets = 0;
  for (const FaceId face : surface_->faces_of(edge))
    falling_facets += falls_into(face, edge, point, x);
  return {1 - falling_facets, falling_facets};
}

bool CriticalFeatureFinder::falls_into(FaceId face, EdgeId edge, const Vec3& point,
                                       Positions x) const {
  const auto& ends = surface_->nodes_of(edge);
  const auto& n = surface_->nodes_of(face);
  const NodeId opposite = *std::find_if(
      n.begin(), n.end(), [&](NodeId node) { return node != ends[0] && node != ends[1]; });
  return sign_inside_edge(x[index_of(ends[0])], x[index_of(ends[1])], x[index_of(opposite)],
                          point) > 0;
}

std::span<const Feature> CriticalFeatureFinder::branches(Feature feature, const Vec3& point,
                                                         Positions x) {
  branches_.clear();
  if (feature.kind == FeatureKind::edge) {
    const EdgeId edge{feature.id};
    for (const FaceId face : surface_->faces_of(edge)) {
      if (falls_into(face, edge, point, x)) branches_.push_back(Feature(face));
    }
  } else if (feature.kind == FeatureKind::node) {
    node_link(NodeId{feature.id}, point, x);
    // The edge that leads nearest stands for its piece; a piece's root is its lowest edge.
    for (std::uint32_t i = 0; i < falling_edges_.size(); ++i) {
      if (piece_root(i) != i) continue;
      Feature best(falling_edges_[i]);
      for (std::uint32_t j = i + 1; j < falling_edges_.size(); ++j) {
        if (piece_root(j) == i)
          best = nearer_cell(*surface_, best, Feature(falling_edges_[j]), point, x);
      }
      branches_.push_back(best);
    }
    std::sort(branches_.begin(), branches_.end());
  }
  return branches_;
}

std::uint32_t CriticalFeatureFinder::piece_root(std::uint32_t i) const noexcept {
  while (piece_[i] != i) i = piece_[i];
  return i;
}

DescendingLink CriticalFeatureFinder::node_link(NodeId node, const Vec3& point, Positions x) {
  const Vec3& centre = x[index_of(node)];
  falling_edges_.clear();
  for (const EdgeId edge : surface_->edges_of(node)) {
    const auto& ends = surface_->nodes_of(edge);
    const NodeId other = ends[0] == node ? ends[1] : ends[0];
    if (sign_past_vertex(centre, x[index_of(other)], point) > 0) falling_edges_.push_back(edge);
  }
  const int edge_count = static_cast<int>(falling_edges_.size());
  piece_.resize(falling_edges_.size());
  std::iota(piece_.begin(), piece_.end(), 0U);
  if (edge_count <= 1) return {1 - edge_count, edge_count};

  // Facets with two falling sides at the node join the pieces of the link; falling_edges_ is
  // sorted.
  int joining_facets = 0;
  int branches = edge_count;
  for (const FaceId face : surface_->faces_of(node)) {
    std::array<std::uint32_t, 3> falling{};
    int count = 0;
    for (const EdgeId side : surface_->edges_of(face)) {
      const auto found = std::lower_bound(falling_edges_.begin(), falling_edges_.end(), side);
      if (found == falling_edges_.end() || *found != side) continue;
      falling[static_cast<std::size_t>(count++)] =
          static_cast<std::uint32_t>(found - falling_edges_.begin());
    }
    if (count < 2) continue;
    ++joining_facets;
    const auto [low, high] = std::minmax({piece_root(falling[0]), piece_root(falling[1])});
    if (low == high) continue;
    piece_[high] = low;
    --branches;
  }
  return {1 - edge_count + joining_facets, branches};
}

/// For a face that holds the foot.
void CriticalFeatureFinder::find_on_face(FaceId face, const Vec3& point, double range,
                                         Positions x) {
  const FootPoint foot = foot_on_face(point, corners(*surface_, face, x));
  if (!(foot.distance < range)) return;
  keep({{surface_->nodes_of(face), foot.weights, Feature(face)},
        foot.direction,
        foot.distance,
        0,
        0},
       {1, 0});
}

void CriticalFeatureFinder::find_on_edge(EdgeId edge, const Vec3& point, double range,
                                         Positions x) {
  const auto c = corners(*surface_, edge, x);
  if (line_is_beyond(point, c, range)) return;
  const DescendingLink link = edge_link(edge, point, x);
  if (link.coefficient == 0) return;
  const FootPoint foot = foot_on_edge(point, c);
  if (!(foot.distance < range)) return;
  const auto& n = surface_->nodes_of(edge);
  keep({{{n[0], n[1], n[0]}, foot.weights, Feature(edge)}, foot.direction, foot.distance, 0, 0},
       link);
}

void CriticalFeatureFinder::find_on_node(NodeId node, const Vec3& point, double range,
                                         Positions x) {
  const Vec3& centre = x[index_of(node)];
  if ((point - centre).squaredNorm() > range * range * kRoom) return;
  const DescendingLink link = node_link(node, point, x);
  if (link.coefficient == 0 && link.branches < 2) return;
  const FootPoint foot = foot_on_node(point, centre);
  if (!(foot.distance < range)) return;
  keep({core_point(node), foot.direction, foot.distance, 0, 0}, link);
}

void CriticalFeatureFinder::keep(const CriticalFeature& foot, DescendingLink link) {
  found_.push_back(foot);
  found_.back().coefficient = link.coefficient;
  found_.back().branches = link.branches;
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/cell_neighbours.hpp"

#include "geometry/closest/core_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace plekton::geometry {
namespace {

constexpr std::int64_t kListsPerTree = 64;

/// In radii. Half a turn takes pi of them; what is nearer than a diameter across a flat sheet is at
/// most 2 sqrt(2) away along the edges of a square grid.
constexpr double kSharpestFold = 4.0;

/// Lists with as many near nodes take 0.4 GB, and the pairs of cells that go with them ten times
/// that. Edges as long as thick make about 20 for each node.
constexpr double kMostNearNodes = 1e8;

/// @throws std::length_error for more near nodes than memory should be spent on
void require_few_near_nodes(double count, double longest_reach) {
  if (count <= kMostNearNodes) return;
  std::ostringstream text;
  text << "self-contact: about " << count << " pairs of nodes are within two thicknesses ("
       << longest_reach << " m) of each other along edges; expected at most " << kMostNearNodes
       << "; edges are far shorter than thick: use longer edges, a thinner membrane, or no "
          "self-contact";
  throw std::length_error(text.str());
}

/// Nodes at most a length away along edges (Dijkstra), the start among them; sorted.
std::vector<NodeId> within_reach(const Surface& surface, NodeId start, double reach, Positions x) {
  std::map<NodeId, double> settled;
  std::multimap<double, NodeId> open{{0.0, start}};
  while (!open.empty()) {
    const auto [length, node] = *open.begin();
    open.erase(open.begin());
    if (!settled.try_emplace(node, length).second) continue;
    for (const EdgeId edge : surface.edges_of(node)) {
      const auto& ends = surface.nodes_of(edge);
      const NodeId next = ends[0] == node ? ends[1] : ends[0];
      const double further = length + (x[index_of(next)] - x[index_of(node)]).norm();
      if (further <= reach) open.emplace(further, next);
    }
  }
  std::vector<NodeId> nodes;
  for (const auto& entry : settled) nodes.push_back(entry.first);
  return nodes;
}

}  // namespace

Box box(const Surface& surface, CellId cell, Positions x, double margin) noexcept {
  std::array<Vec3, 3> corners;
  std::size_t count = 0;
  for (const NodeId node : surface.nodes_of(cell)) corners[count++] = x[index_of(node)];
  const double radius = surface.radius(surface.structure_of(cell));
  return bounding_box({corners.data(), count}, radius + margin);
}

CellNeighbours::CellNeighbours(const Surface& surface, Positions rest, double skin,
                               bool self_contact)
    : surface_(&surface), skin_(skin), self_contact_(self_contact) {
  find_own_nodes();
  if (self_contact) collect_near_nodes(rest);
}

void CellNeighbours::find_own_nodes() {
  own_nodes_.clear();
  for (std::size_t n = 0; n < surface_->node_count(); ++n) {
    const NodeId node = id_at<NodeId>(n);
    if (surface_->structure_of(node) != StructureId{-1}) own_nodes_.push_back(node);
  }
}

void CellNeighbours::follow(const SurfaceChange& change) {
  surface_ = &change.after();
  find_own_nodes();
  pairs_.clear();
  tree_ = BroadPhase();
  skin_.set(2.0 * skin_.margin());
}

void CellNeighbours::choose_skin() {
  constexpr double kInRadii = 1.0;
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface_->structure_count(); ++i)
    thinnest = std::min(thinnest, surface_->radius(id_at<StructureId>(i)));
  if (std::isfinite(thinnest)) skin_.set(kInRadii * thinnest);
}

/// Grains that fly past do not make a list of cells old.
void CellNeighbours::gather_own_nodes(Positions x) {
  own_x_.clear();
  for (const NodeId node : own_nodes_) own_x_.push_back(x[index_of(node)]);
}

std::vector<NodeId> CellNeighbours::nodes_near(NodeId node, Positions rest) const {
  const double reach = kSharpestFold * surface_->radius(surface_->structure_of(node));
  return within_reach(*surface_, node, reach, rest);
}

/// A hundred nodes tell at once what all of them will take.
void CellNeighbours::require_room(Positions rest) const {
  const std::size_t stride = std::max<std::size_t>(1, own_nodes_.size() / 100);
  double sampled = 0.0, near = 0.0, longest_reach = 0.0;
  for (std::size_t i = 0; i < own_nodes_.size(); i += stride) {
    const double radius = surface_->radius(surface_->structure_of(own_nodes_[i]));
    near += static_cast<double>(nodes_near(own_nodes_[i], rest).size());
    longest_reach = std::max(longest_reach, kSharpestFold * radius);
    sampled += 1.0;
  }
  if (sampled > 0.0)
    require_few_near_nodes(near / sampled * static_cast<double>(own_nodes_.size()), longest_reach);
}

void CellNeighbours::collect_near_nodes(Positions rest) {
  require_room(rest);
  if (own_nodes_.empty()) return;
  near_nodes_.resize(surface_->node_count());
  for (const NodeId node : own_nodes_) near_nodes_[index_of(node)] = nodes_near(node, rest);
}

bool CellNeighbours::may_touch(CellId a, CellId b) const {
  if (surface_->structure_of(a) != surface_->structure_of(b)) return true;
  if (!self_contact_) return false;
  const auto nodes_b = surface_->nodes_of(b);
  for (const NodeId node : surface_->nodes_of(a)) {
    const auto& near = near_nodes_[index_of(node)];
    for (const NodeId other : nodes_b) {
      if (std::binary_search(near.begin(), near.end(), other)) return false;
    }
  }
  return true;
}

/// Cells further apart than both radii and the skin cannot touch before the list is made anew: no
/// point of theirs moves by more than half the skin.
bool CellNeighbours::are_distant(CellId a, CellId b, Positions x) const {
  const auto core = [&](CellId cell) {
    Core found;
    for (const NodeId node : surface_->nodes_of(cell)) found.x[found.count++] = x[index_of(node)];
    return found;
  };
  const double radii =
      surface_->radius(surface_->structure_of(a)) + surface_->radius(surface_->structure_of(b));
  const double reach = (1.0 + 1e-12) * (radii + 2.0 * skin_.margin());
  return closest_points(core(a), core(b)).distance > reach;
}

bool CellNeighbours::update(Positions x, ThreadPool& pool, double way) {
  if (surface_->cell_count() < 2) return false;
  if (!self_contact_ && surface_->structure_count() < 2) return false;
  if (!skin_.may_need_rebuild(way)) return false;
  gather_own_nodes(x);
  if (!skin_.needs_rebuild(own_x_, pool)) return false;
  ++rebuild_count_;
  boxes_.clear();
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    boxes_.push_back(box(*surface_, id_at<CellId>(c), x, skin_.margin()));
  }
  // Cells keep their neighbours in the structure: the tree stays a good one for long.
  if (tree_.size() == boxes_.size() && rebuild_count_ % kListsPerTree != 0) {
    tree_.refit(boxes_);
  } else {
    tree_.rebuild(boxes_);
  }
  tree_.self_pairs(overlaps_, pool);
  previous_.swap(pairs_);
  pairs_.clear();
  for (const IndexPair& pair : overlaps_) {
    const CellId a{pair.a};
    const CellId b{pair.b};
    if (!may_touch(a, b) || are_distant(a, b, x)) continue;
    const bool keeps = surface_->structure_of(a) <= surface_->structure_of(b);
    pairs_.push_back(keeps ? CellPair{a, b} : CellPair{b, a});
  }
  std::sort(pairs_.begin(), pairs_.end());
  skin_.mark_built(own_x_);
  return pairs_ != previous_;
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/cell_neighbours.hpp"

#include "geometry/base/state_archive.hpp"
#include "geometry/closest/core_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plekton::geometry {
namespace {

constexpr std::int64_t kListsPerCellTree = 64;

/// m, of two cells: both radii and the skin.
double interaction_range_of(const Surface& surface, CellId a, CellId b, double margin) {
  const double radii =
      surface.radius(surface.structure_of(a)) + surface.radius(surface.structure_of(b));
  return (1.0 + 1e-12) * (radii + 2.0 * margin);
}

/// Whether the cores in two boxes may be within reach. Boxes that overlap at their corners only may
/// hold none.
/// @param a, b  m, grown by a radius and the margin each
bool are_close(const Box& a, const Box& b, double reach) {
  constexpr double kRounding = 1.0 + 1e-11;
  const Vec3 apart = (a.lower - b.upper).cwiseMax(b.lower - a.upper);
  return (apart.array() + reach).max(0.0).matrix().norm() <= kRounding * reach;
}

/// Cells of a group of near nodes.
struct Part {
  std::span<const CellId> cells;
  const Box& box;  ///< m, around all of them
};

/// Calls visit(cell, cell) for cells of two parts whose boxes are close.
template <class Visit>
void for_each_close_pair(const Surface& surface, const Part& a, const Part& b, Positions x,
                         double margin, const Visit& visit) {
  const double reach = interaction_range_of(surface, a.cells.front(), b.cells.front(), margin);
  for (const CellId one : a.cells) {
    const Box box_of_one = box(surface, one, x, margin);
    if (!are_close(box_of_one, b.box, reach)) continue;
    for (const CellId other : b.cells) {
      if (are_close(box_of_one, box(surface, other, x, margin), reach)) visit(one, other);
    }
  }
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
  if (self_contact) near_nodes_ = NearNodes(surface, rest);
  collect_parts();
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
  collect_parts();
  pairs_.clear();
  tree_ = BroadPhase();
  skin_.set(2.0 * skin_.margin());
}

void CellNeighbours::choose_skin() {
  // Of cells far shorter than thick very many are a little further apart than what is near along
  // edges: a quarter keeps those of a flat sheet out of the list.
  const bool has_groups = part_group_.size() < surface_->cell_count();
  const double in_radii = has_groups ? 0.25 : 1.0;
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface_->structure_count(); ++i)
    thinnest = std::min(thinnest, surface_->radius(id_at<StructureId>(i)));
  if (std::isfinite(thinnest)) skin_.set(in_radii * thinnest);
}

/// Grains that fly past do not make a list of cells old.
void CellNeighbours::gather_own_nodes(Positions x) {
  own_x_.clear();
  for (const NodeId node : own_nodes_) own_x_.push_back(x[index_of(node)]);
}

/// In the order of their first cells, so that cells by themselves keep theirs.
void CellNeighbours::collect_parts() {
  std::vector<std::int32_t> sizes(near_nodes_.group_count(), 0);
  for (const NodeId node : own_nodes_) {
    if (self_contact_) ++sizes[static_cast<std::size_t>(near_nodes_.group_of(node))];
  }
  std::vector<std::int32_t> part_of_group(sizes.size(), -1);
  std::vector<std::int32_t> part_of_cell(surface_->cell_count());
  part_group_.clear();
  part_begins_.assign(1, 0);
  for (std::size_t c = 0; c < part_of_cell.size(); ++c) {
    const NodeId first = surface_->nodes_of(id_at<CellId>(c)).front();
    const std::int32_t group = self_contact_ ? near_nodes_.group_of(first) : -1;
    const bool is_single = group < 0 || sizes[static_cast<std::size_t>(group)] == 1;
    std::int32_t part = is_single ? -1 : part_of_group[static_cast<std::size_t>(group)];
    if (part < 0) {
      part = static_cast<std::int32_t>(part_group_.size());
      part_group_.push_back(is_single ? -1 : group);
      part_begins_.push_back(0);
      if (!is_single) part_of_group[static_cast<std::size_t>(group)] = part;
    }
    part_of_cell[c] = part;
    ++part_begins_[static_cast<std::size_t>(part) + 1];
  }
  std::partial_sum(part_begins_.begin(), part_begins_.end(), part_begins_.begin());
  part_cells_.resize(part_of_cell.size());
  std::vector<std::size_t> next(part_begins_.begin(), part_begins_.end());
  for (std::size_t c = 0; c < part_of_cell.size(); ++c)
    part_cells_[next[static_cast<std::size_t>(part_of_cell[c])]++] = id_at<CellId>(c);
}

std::span<const CellId> CellNeighbours::cells_of_part(std::int32_t part) const noexcept {
  const auto p = static_cast<std::size_t>(part);
  return std::span(part_cells_).subspan(part_begins_[p], part_begins_[p + 1] - part_begins_[p]);
}

/// Each cell of a group has a node in it, so cells of near groups hang together.
bool CellNeighbours::may_parts_touch(std::int32_t a, std::int32_t b) const {
  const std::int32_t group_a = part_group_[static_cast<std::size_t>(a)];
  const std::int32_t group_b = part_group_[static_cast<std::size_t>(b)];
  return group_a < 0 || group_b < 0 || !near_nodes_.are_groups_near(group_a, group_b);
}

void CellNeighbours::make_boxes(Positions x) {
  boxes_.clear();
  for (std::size_t part = 0; part < part_group_.size(); ++part) {
    const auto cells = cells_of_part(static_cast<std::int32_t>(part));
    Box all = box(*surface_, cells.front(), x, skin_.margin());
    for (const CellId cell : cells.subspan(1)) {
      const Box more = box(*surface_, cell, x, skin_.margin());
      all = {all.lower.cwiseMin(more.lower), all.upper.cwiseMax(more.upper)};
    }
    boxes_.push_back(all);
  }
}

bool CellNeighbours::may_touch(CellId a, CellId b) const {
  if (groups_.exclude(surface_->nodes_of(a), surface_->nodes_of(b))) return false;
  if (surface_->structure_of(a) != surface_->structure_of(b)) return true;
  if (!self_contact_) return false;
  const auto nodes_b = surface_->nodes_of(b);
  for (const NodeId node : surface_->nodes_of(a)) {
    for (const NodeId other : nodes_b) {
      if (near_nodes_.are_near(node, other)) return false;
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
  return closest_points(core(a), core(b)).distance >
         interaction_range_of(*surface_, a, b, skin_.margin());
}

bool CellNeighbours::update(Positions x, ThreadPool& pool, double way) {
  if (surface_->cell_count() < 2) return false;
  if (!self_contact_ && surface_->structure_count() < 2) return false;
  if (!skin_.may_need_rebuild(way)) return false;
  gather_own_nodes(x);
  if (!skin_.needs_rebuild(own_x_, pool)) return false;
  ++rebuild_count_;
  previous_.swap(pairs_);
  make_list(x, pool);
  skin_.mark_built(own_x_);
  return pairs_ != previous_;
}

void CellNeighbours::exchange(const StateArchive& archive, ThreadPool& pool) {
  skin_.exchange(archive);
  archive("rebuild_count", rebuild_count_);
  const Positions built = skin_.built_positions();
  if (!archive.is_reading() || built.empty()) return;
  if (built.size() != own_nodes_.size())
    throw StateMismatch("the state has another number of nodes of structures than there are here");
  std::vector<Vec3> x(surface_->node_count(), Vec3::Zero());
  for (std::size_t i = 0; i < own_nodes_.size(); ++i) x[index_of(own_nodes_[i])] = built[i];
  make_list(x, pool);
}

void CellNeighbours::make_list(Positions x, ThreadPool& pool) {
  make_boxes(x);
  // Cells keep their neighbours in the structure: the tree stays a good one for long.
  if (tree_.size() == boxes_.size() && rebuild_count_ % kListsPerCellTree != 0) {
    tree_.refit(boxes_);
  } else {
    tree_.rebuild(boxes_);
  }
  tree_.self_pairs(overlaps_, pool);
  pairs_.clear();
  const auto list_if_near = [&](CellId first, CellId second) {
    const auto [a, b] = std::minmax(first, second);
    if (!may_touch(a, b) || are_distant(a, b, x)) return;
    const bool keeps = surface_->structure_of(a) <= surface_->structure_of(b);
    pairs_.push_back(keeps ? CellPair{a, b} : CellPair{b, a});
  };
  for (const IndexPair& parts : overlaps_) {
    const Part a{cells_of_part(parts.a), boxes_[static_cast<std::size_t>(parts.a)]};
    const Part b{cells_of_part(parts.b), boxes_[static_cast<std::size_t>(parts.b)]};
    if (a.cells.size() == 1 && b.cells.size() == 1)
      list_if_near(a.cells.front(), b.cells.front());
    else if (may_parts_touch(parts.a, parts.b))
      for_each_close_pair(*surface_, a, b, x, skin_.margin(), list_if_near);
  }
  std::sort(pairs_.begin(), pairs_.end());
}

}  // namespace plekton::geometry

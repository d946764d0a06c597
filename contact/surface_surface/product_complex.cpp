// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/product_complex.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::contact::structure {
namespace {

using geometry::FeatureNodes;

constexpr NodeId kNoNode{-1};

std::size_t count_of(const std::array<NodeId, 3>& nodes) noexcept {
  return nodes[1] == kNoNode ? 1 : nodes[2] == kNoNode ? 2 : 3;
}

/// Those of some nodes, ascending.
std::array<NodeId, 3> sorted(std::span<const NodeId> nodes) noexcept {
  std::array<NodeId, 3> result{kNoNode, kNoNode, kNoNode};
  std::copy(nodes.begin(), nodes.end(), result.begin());
  const auto order = [&](std::size_t i, std::size_t k) {
    if (k < nodes.size() && result[k] < result[i]) std::swap(result[i], result[k]);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return result;
}

bool has_all(const std::array<NodeId, 3>& nodes, const std::array<NodeId, 3>& some) noexcept {
  return std::all_of(some.begin(), some.end(), [&](NodeId node) {
    return node == kNoNode || std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  });
}

FeatureNodes nodes_in(const std::array<NodeId, 3>& nodes) noexcept {
  return {nodes, count_of(nodes)};
}

geometry::Core core_at(const FeatureNodes& nodes, geometry::Positions x) {
  geometry::Core core;
  for (const NodeId node : nodes) core.x[core.count++] = x[geometry::index_of(node)];
  return core;
}

}  // namespace

ProductComplex::Key ProductComplex::key_of(std::span<const NodeId> a,
                                           std::span<const NodeId> b) noexcept {
  const auto of_a = sorted(a);
  const auto of_b = sorted(b);
  return of_a < of_b ? Key{of_a, of_b} : Key{of_b, of_a};
}

/// Whether the features of one are sides or corners of those of another, or the same.
bool ProductComplex::holds(const Key& key, const Key& lower) noexcept {
  return (has_all(key[0], lower[0]) && has_all(key[1], lower[1])) ||
         (has_all(key[0], lower[1]) && has_all(key[1], lower[0]));
}

void ProductComplex::build(std::span<const CellPair> pairs, double range, geometry::Positions x) {
  cells_.clear();
  places_.clear();
  by_side_.clear();
  for (auto& list : candidates_) list.clear();
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const FeatureNodes& a = *pairs[i].a;
    const FeatureNodes& b = *pairs[i].b;
    candidates_[a.count + b.count - 2].push_back(
        {key_of({a.ids.data(), a.count}, {b.ids.data(), b.count}), kNone, i});
  }
  for (std::size_t d = candidates_.size(); d-- > 0;) {
    first_[d + 1] = static_cast<std::uint32_t>(cells_.size());
    auto& list = candidates_[d];
    std::sort(list.begin(), list.end());
    for (std::size_t i = 0, end = 0; i < list.size(); i = end) {
      while (end < list.size() && list[end].key == list[i].key) ++end;
      take(std::span(list).subspan(i, end - i), pairs, range, x);
    }
    if (d == 0) continue;
    for (std::uint32_t i = first_[d + 1]; i < cells_.size(); ++i) add_sides(i, candidates_[d - 1]);
  }
  first_[0] = static_cast<std::uint32_t>(cells_.size());
  number_vertices();
  list_links();
  list_fillings();
}

/// Takes a cell that may be in range. Where the nearest points of a cell that it is a side of lie
/// in it, these are its own.
void ProductComplex::take(std::span<const Candidate> same, std::span<const CellPair> pairs,
                          double range, geometry::Positions x) {
  Cell cell{same.front().key, {}, kNone, same.front().pair, 0.0};
  for (const Candidate& of : same) {
    if (of.cell == kNone || cell.place != kNone) continue;
    const Cell& above = cells_[of.cell];
    if (!holds(cell.key, above.foot)) continue;
    cell.place = above.place;
    cell.foot = above.foot;
  }
  if (cell.place == kNone) {
    Place place{nodes_in(cell.key[0]), nodes_in(cell.key[1]), {}};
    if (cell.pair != kNone) {
      const CellPair& pair = pairs[cell.pair];
      place = {*pair.a, *pair.b, *pair.cores};
    } else {
      const geometry::Core a = core_at(place.a, x), b = core_at(place.b, x);
      place.cores = geometry::at_last_touch(a, b, geometry::core_proximity(a, b));
      if (!(place.cores.signed_distance < range)) return;
    }
    cell.place = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
    set_foot(cell);
  }
  cell.level = places_[cell.place].cores.signed_distance;
  const auto own = static_cast<std::uint32_t>(cells_.size());
  for (const Candidate& of : same) {
    if (of.cell == kNone) continue;
    by_side_.push_back({own, of.cell});
    cell.level = std::max(cell.level, cells_[of.cell].level);
  }
  cells_.push_back(cell);
}

/// Of cores that meet: the features themselves.
void ProductComplex::set_foot(Cell& cell) const noexcept {
  const Place& place = places_[cell.place];
  const geometry::ClosestPoints& points = place.cores.points;
  cell.foot = cell.key;
  if (points.relation != geometry::Relation::apart) return;
  const auto held = [](const FeatureNodes& nodes, unsigned corners, std::array<NodeId, 3>& room) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < nodes.count; ++k)
      if ((corners >> k & 1U) != 0) room[count++] = nodes.ids[k];
    return std::span<const NodeId>(room.data(), count);
  };
  std::array<NodeId, 3> of_a, of_b;
  cell.foot = key_of(held(place.a, points.corners_a, of_a), held(place.b, points.corners_b, of_b));
}

void ProductComplex::add_sides(std::uint32_t cell, std::vector<Candidate>& to) const {
  const Key key = cells_[cell].key;
  for (std::size_t body = 0; body < 2; ++body) {
    const FeatureNodes nodes = nodes_in(key[body]);
    const FeatureNodes others = nodes_in(key[1 - body]);
    if (nodes.count == 1) continue;
    for (std::size_t left_out = 0; left_out < nodes.count; ++left_out) {
      std::array<NodeId, 3> side;
      std::size_t count = 0;
      for (std::size_t k = 0; k < nodes.count; ++k)
        if (k != left_out) side[count++] = nodes.ids[k];
      to.push_back({key_of({side.data(), count}, {others.ids.data(), others.count}), cell, kNone});
    }
  }
}

std::uint32_t ProductComplex::find(const Key& key) const noexcept {
  const std::size_t dimension = count_of(key[0]) + count_of(key[1]) - 2;
  const auto first = cells_.begin() + first_[dimension + 1];
  const auto last = cells_.begin() + first_[dimension];
  const auto found = std::lower_bound(
      first, last, key, [](const Cell& cell, const Key& of) { return cell.key < of; });
  return found != last && found->key == key ? static_cast<std::uint32_t>(found - cells_.begin())
                                            : kNone;
}

/// Nearest first.
void ProductComplex::number_vertices() {
  vertices_.assign(cells_.size(), 0);
  apexes_.clear();
  // Lowest dimension first: a foot is known before it is asked for.
  for (auto i = static_cast<std::uint32_t>(cells_.size()); i-- > 0;) {
    const std::uint32_t foot = cells_[i].foot == cells_[i].key ? i : find(cells_[i].foot);
    const bool is_own = foot == i || foot == kNone;
    vertices_[i] = is_own ? static_cast<std::uint32_t>(apexes_.size()) : vertices_[foot];
    if (is_own) apexes_.push_back(i);
  }
  const auto distance = [this](std::uint32_t cell) { return cells_[cell].level; };
  above_.resize(apexes_.size());
  std::iota(above_.begin(), above_.end(), 0U);
  std::sort(above_.begin(), above_.end(), [&](std::uint32_t i, std::uint32_t k) {
    const double p = distance(apexes_[i]);
    const double q = distance(apexes_[k]);
    return p != q ? p < q : apexes_[i] < apexes_[k];  // sides come after cells
  });
  holders_.resize(above_.size());
  for (std::uint32_t place = 0; place < above_.size(); ++place) holders_[above_[place]] = place;
  for (std::uint32_t& vertex : vertices_) vertex = holders_[vertex];
  for (std::uint32_t& vertex : above_) vertex = apexes_[vertex];
  apexes_.swap(above_);
  distances_.clear();
  for (const std::uint32_t apex : apexes_) distances_.push_back(distance(apex));
  levels_.start(distances_, vertices_);
}

void ProductComplex::list_links() {
  for (const Face& face : by_side_) levels_.add_link(face.side, face.cell);
  levels_.sort_links();
}

/// A corner of a cell lies in two of its sides.
void ProductComplex::list_fillings() {
  levels_.index_links();
  by_cell_.assign(by_side_.begin(), by_side_.end());
  std::sort(by_cell_.begin(), by_cell_.end(), [](const Face& p, const Face& q) {
    return p.cell != q.cell ? p.cell < q.cell : p.side < q.side;
  });
  first_sides_.assign(cells_.size() + 1, 0);
  for (const Face& face : by_cell_) ++first_sides_[face.cell + 1];
  std::partial_sum(first_sides_.begin(), first_sides_.end(), first_sides_.begin());
  const auto sides = [this](std::uint32_t cell) {
    return std::span(by_cell_).subspan(first_sides_[cell],
                                       first_sides_[cell + 1] - first_sides_[cell]);
  };
  for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
    corners_.clear();
    for (const Face& side : sides(cell))
      for (const Face& corner : sides(side.side)) corners_.push_back({corner.side, side.side});
    std::sort(corners_.begin(), corners_.end());
    for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
      if (corners_[i].side == corners_[i + 1].side)
        levels_.add_filling(corners_[i].side, corners_[i].cell, cell, corners_[i + 1].cell);
    }
  }
  levels_.merge_links();
}

std::uint32_t ProductComplex::vertex_of(const FeatureNodes& a,
                                        const FeatureNodes& b) const noexcept {
  const std::uint32_t cell = find(key_of({a.ids.data(), a.count}, {b.ids.data(), b.count}));
  return cell == kNone ? kNone : vertices_[cell];
}

std::span<const std::uint32_t> ProductComplex::holders(std::uint32_t vertex) {
  holders_.clear();
  above_.assign(1, apexes_[vertex]);
  for (std::size_t next = 0; next < above_.size(); ++next) {
    const std::uint32_t side = above_[next];
    if (cells_[side].pair != kNone) holders_.push_back(cells_[side].pair);
    // Faces are listed by the side, as its cell was taken.
    auto face = std::lower_bound(by_side_.begin(), by_side_.end(), Face{side, 0});
    for (; face != by_side_.end() && face->side == side; ++face) {
      if (std::find(above_.begin(), above_.end(), face->cell) == above_.end())
        above_.push_back(face->cell);
    }
  }
  std::sort(holders_.begin(), holders_.end());
  return holders_;
}

}  // namespace plekton::contact::structure

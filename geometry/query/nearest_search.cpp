// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/nearest_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::geometry {
namespace {

using Row = BoxTree::Row;

/// Of a distance, more than rounding in boxes, supports and the kernel's usual case adds up to.
constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();

Proximity reversed(const Proximity& p) {
  return {p.b, p.a, -p.normal, p.gap, p.arm_b, p.arm_a, p.relation};
}

double radius_of(const PlacedSurface& on, CellId cell) {
  return on.surface.radius(on.surface.structure_of(cell));
}

/// Corners by ascending node id, as proximity() takes them.
Core core_of(const PlacedSurface& on, CellId cell) {
  const auto nodes = on.surface.nodes_of(cell);
  std::array<NodeId, 3> sorted{nodes[0], nodes[1], nodes.back()};
  if (sorted[1] < sorted[0]) std::swap(sorted[0], sorted[1]);
  if (nodes.size() == 3 && sorted[2] < sorted[1]) std::swap(sorted[1], sorted[2]);
  if (nodes.size() == 3 && sorted[1] < sorted[0]) std::swap(sorted[0], sorted[1]);
  Core core{{}, nodes.size()};
  for (std::size_t k = 0; k < core.count; ++k) core.x[k] = on.x[index_of(sorted[k])];
  return core;
}

Probe probe_of(const PlacedSurface& on, CellId cell) {
  return {core_of(on, cell), radius_of(on, cell)};
}

Box box_of(const Core& core) {
  return bounding_box(core.corners(), 0.0);
}

/// How far apart (m) cores may be for a pair of these radii to have a gap as small as one.
double interaction_range_of(double gap, double radius_a, double radius_b) {
  const double radii = radius_a + radius_b;
  return gap + radii + kRounding * (std::abs(gap) + radii);
}

/// Whether cores whose boxes are apart by a squared distance are certainly further apart than a
/// reach. Cores in boxes that overlap may cross, and be any depth below that.
bool are_beyond(double squared_distance, double reach) {
  if (squared_distance == 0.0) return false;
  return reach < 0.0 || squared_distance * (1.0 - kRounding) > reach * reach;
}

/// Which side rounding is counted on.
enum class Rounding { certain, tied };

/// Whether a plane across a direction keeps two cores further apart than a reach (m): certainly, or
/// as far but for rounding.
template <Rounding kSide = Rounding::certain>
bool separates(const Vec3& direction, const Core& a, const Core& b, double reach) {
  const Vec3& from = a.x[0];
  double greatest = 0.0, least = std::numeric_limits<double>::infinity(), size = 0.0;
  for (std::size_t i = 1; i < a.count; ++i) {
    const Vec3 way = a.x[i] - from;
    greatest = std::max(greatest, direction.dot(way));
    size = std::max(size, way.cwiseAbs().sum());
  }
  for (std::size_t i = 0; i < b.count; ++i) {
    const Vec3 way = b.x[i] - from;
    least = std::min(least, direction.dot(way));
    size = std::max(size, way.cwiseAbs().sum());
  }
  // Of a direction so short that its square is rounded to nothing nobody can tell.
  constexpr double kLeast =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  const double squared = direction.squaredNorm();
  const double rounding = kRounding * (size + reach);
  return squared > kLeast &&
         least - greatest > (kSide == Rounding::certain ? reach + rounding : reach - rounding) *
                                std::sqrt(squared);
}

/// A part of a tree that is still to be looked at.
struct Entry {
  double squared;  ///< m², distance of the boxes
  double radius;   ///< m
  BoxTree::Child child;
};

/// Adds the children that are not ruled out, the nearest last.
template <class Stack, class IsBeyond>
void push_children(const BoxTree::Node& node, const Box& from, Stack& open, std::size_t& count,
                   const IsBeyond& is_beyond) {
  const Row squared = node.squared_distances(from);
  const std::size_t first = count;
  for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) {
    if (!node.child[lane].exists() || is_beyond(squared[lane], node.radius[lane])) continue;
    const Entry entry{squared[lane], node.radius[lane], node.child[lane]};
    std::size_t k = count++;
    for (; k > first && open[k - 1].squared < entry.squared; --k) open[k] = open[k - 1];
    open[k] = entry;
  }
}

/// What is the smallest: gaps, or distances of cores (m).
enum class Measure { gap, core_distance };

/// One question.
template <Measure kMeasure>
class Search {
 public:
  Search(const Probe& probe, const SearchedSurface& on)
      : probe_(probe), on_(on), box_(box_of(probe.core)) {}

  NearestCore run() {
    std::array<Entry, BoxTree::kMostEntries> open;
    std::size_t count = 0;
    const auto beyond = [this](double squared, double radius) {
      return is_beyond(squared, radius);
    };
    push_children(on_.tree.root(), box_, open, count, beyond);
    while (count > 0) {
      const Entry entry = open[--count];
      if (is_beyond(entry.squared, entry.radius)) continue;
      if (entry.child.is_item())
        look_at(CellId{entry.child.item()}, entry.radius);
      else
        push_children(on_.tree.node(entry.child), box_, open, count, beyond);
    }
    return {{best_, proximity(probe_, on_.placed, best_)}, distance_};
  }

 private:
  /// m, up to which cores of a cell of this radius may be nearest.
  double reach(double radius) const {
    if constexpr (kMeasure == Measure::core_distance) return interaction_range_of(least_, 0.0, 0.0);
    return interaction_range_of(least_, probe_.radius, radius);
  }
  bool is_beyond(double squared, double radius) const { return are_beyond(squared, reach(radius)); }

  void look_at(CellId cell, double radius) {
    const double within = reach(radius);
    const Core core = core_of(on_.placed, cell);
    if (within < kUnknown && within >= 0.0 && separates(normal_, probe_.core, core, within)) return;
    const CoreProximity found = core_proximity(probe_.core, core);
    const double measured = kMeasure == Measure::gap
                                ? found.signed_distance - probe_.radius - radius
                                : found.signed_distance;
    if (measured < least_ || (measured == least_ && cell < best_)) {
      least_ = measured;
      best_ = cell;
      normal_ = found.normal;
      distance_ = found.signed_distance;
    }
  }

  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  const Probe& probe_;
  const SearchedSurface& on_;
  Box box_;
  double least_ = kUnknown;  ///< m
  CellId best_{0};
  Vec3 normal_ = Vec3::UnitZ();  ///< of the nearest cell so far, to it
  double distance_ = kUnknown;   ///< m, of its core
};

/// A part of each tree: where they are, and their boxes.
struct EntryPair {
  double squared;  ///< m²
  BoxTree::Child a;
  BoxTree::Child b;
  double radius_a;  ///< m
  double radius_b;  ///< m
  Box box_a;
  Box box_b;
};

double size_of(const Box& box) {
  return (box.upper - box.lower).squaredNorm();
}

/// Both surfaces.
class PairSearch {
 public:
  PairSearch(const SearchedSurface& a, const SearchedSurface& b, const NearestCells& first)
      : a_(a), b_(b), best_(first) {}

  NearestCells run() {
    const BoxTree::Node& root = a_.tree.root();
    for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) {
      if (!root.child[lane].exists()) continue;
      split_b(EntryPair{0.0, root.child[lane], {0}, root.radius[lane], 0.0, root.box(lane), {}});
      go_down();
    }
    return best_;
  }

 private:
  void go_down() {
    while (!open_.empty()) {
      const EntryPair pair = open_.back();
      open_.pop_back();
      if (is_beyond(pair)) continue;
      if (pair.a.is_item() && pair.b.is_item()) {
        look_at(pair);
      } else if (pair.b.is_item() ||
                 (!pair.a.is_item() && size_of(pair.box_a) > size_of(pair.box_b))) {
        split_a(pair);
      } else {
        split_b(pair);
      }
    }
  }

  double reach(const EntryPair& pair) const {
    return interaction_range_of(best_.proximity.gap, pair.radius_a, pair.radius_b);
  }
  bool is_beyond(const EntryPair& pair) const { return are_beyond(pair.squared, reach(pair)); }

  void split_a(const EntryPair& pair) {
    const BoxTree::Node& node = a_.tree.node(pair.a);
    const Row squared = node.squared_distances(pair.box_b);
    push(node, squared, pair, [&](EntryPair& part, std::size_t lane) {
      part.a = node.child[lane];
      part.radius_a = node.radius[lane];
      part.box_a = node.box(lane);
    });
  }
  void split_b(const EntryPair& pair) {
    const BoxTree::Node& node = b_.tree.node(pair.b);
    const Row squared = node.squared_distances(pair.box_a);
    push(node, squared, pair, [&](EntryPair& part, std::size_t lane) {
      part.b = node.child[lane];
      part.radius_b = node.radius[lane];
      part.box_b = node.box(lane);
    });
  }

  /// The nearest part last.
  template <class Replace>
  void push(const BoxTree::Node& node, const Row& squared, const EntryPair& pair,
            const Replace& replace) {
    std::array<std::size_t, BoxTree::kLanes> order{0, 1, 2, 3};
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t k) { return squared[i] > squared[k]; });
    for (const std::size_t lane : order) {
      if (!node.child[lane].exists()) continue;
      EntryPair part = pair;
      part.squared = squared[lane];
      replace(part, lane);
      if (!is_beyond(part)) open_.push_back(part);
    }
  }

  void look_at(const EntryPair& pair) {
    const CellId a{pair.a.item()}, b{pair.b.item()};
    const bool is_lower = a < best_.a || (a == best_.a && b < best_.b);
    const Core core_a = core_of(a_.placed, a), core_b = core_of(b_.placed, b);
    if (is_lower ? are_apart<Rounding::certain>(core_a, core_b, reach(pair))
                 : are_apart<Rounding::tied>(core_a, core_b, reach(pair)))
      return;
    const Proximity found = proximity(a_.placed, a, b_.placed, b);
    if (found.gap < best_.proximity.gap || (found.gap == best_.proximity.gap && is_lower))
      best_ = {a, b, found};
  }

  /// Whether one of some likely directions shows it: that of the nearest cells so far, and the
  /// normals of both facets.
  template <Rounding kSide>
  bool are_apart(const Core& a, const Core& b, double reach) const {
    if (reach < 0.0) return false;
    if (separates<kSide>(best_.proximity.normal, a, b, reach)) return true;
    const auto is_across = [&](const Core& facet) {
      if (facet.count != 3) return false;
      const Vec3 normal = (facet.x[1] - facet.x[0]).cross(facet.x[2] - facet.x[0]);
      return separates<kSide>(normal, a, b, reach) || separates<kSide>(-normal, a, b, reach);
    };
    return is_across(a) || is_across(b);
  }

  const SearchedSurface& a_;
  const SearchedSurface& b_;
  NearestCells best_;
  std::vector<EntryPair> open_;
};

/// To and fro from the first cell while that leads nearer: a pair that is near, so that few are
/// left to look at.
NearestCells near_pair(const SearchedSurface& a, const SearchedSurface& b) {
  NearestCells best{};
  CellId from{0};
  for (bool is_first = true;; is_first = false) {
    const NearestCell to = nearest_cell(probe_of(a.placed, from), b);
    const NearestCell back = nearest_cell(probe_of(b.placed, to.cell), a);
    if (!is_first && !(back.proximity.gap < best.proximity.gap)) break;
    best = {back.cell, to.cell, reversed(back.proximity)};
    from = back.cell;
  }
  best.proximity = proximity(a.placed, best.a, b.placed, best.b);
  return best;
}

}  // namespace

NearestCell nearest_cell(const Probe& probe, const SearchedSurface& on) {
  return Search<Measure::gap>(probe, on).run().nearest;
}

NearestCore nearest_core(const Probe& probe, const SearchedSurface& on) {
  return Search<Measure::core_distance>(probe, on).run();
}

NearestCells nearest_cells(const SearchedSurface& a, const SearchedSurface& b) {
  return PairSearch(a, b, near_pair(a, b)).run();
}

}  // namespace plekton::geometry

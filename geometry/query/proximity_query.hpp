// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/proximity.hpp"

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace plekton::geometry {

/// Which pairs of a scene are asked for.
struct PairChoice {
  double largest_gap;  ///< m, finite, from kSmallestSkin on: how far apart a pair may be to be
                       ///< reported
  bool cells_with_cells = true;    ///< cylinders and facets of different structures
  bool within_structures = false;  ///< and of one structure with itself, but for neighbours
};

/// An element of a scene: a sphere, or a cylinder or facet as the cell that it is of the surface.
struct ElementId {
  enum class Kind : std::uint8_t { sphere, cell };
  Kind kind;
  std::int32_t id;  ///< SphereId or CellId, by kind

  friend constexpr auto operator<=>(const ElementId&, const ElementId&) = default;
};

/// Two elements; spheres before cells, then the lower id first.
struct ElementPair {
  ElementId a;
  ElementId b;

  friend constexpr auto operator<=>(const ElementPair&, const ElementPair&) = default;
};

/// Geometry alone: positions in, proximities out. For whoever wants to know what is near what,
/// without any dynamics. All six kinds of pairs of primitives (primitive_pairs.hpp).
///
/// Lists of candidates are kept while nodes move by less than half the largest gap; a question
/// between two rebuilds takes O(elements + candidates). It can be moved, not copied.
class ProximityQuery {
 public:
  /// @param threads  >= 1, of find(); fewer are refused with std::invalid_argument before all else
  /// @throws std::invalid_argument listing every problem of the elements (see Surface; spheres
  ///         whose node does not exist or whose radius is negative or not below 1e75 m) and of
  ///         largest_gap
  ProximityQuery(Elements elements, std::size_t node_count, const PairChoice& choice,
                 int threads = 1);
  ProximityQuery(Elements elements, std::size_t node_count, double largest_gap, int threads = 1)
      : ProximityQuery(std::move(elements), node_count, PairChoice{largest_gap}, threads) {}

  /// Every chosen pair that is nearer than the largest gap: spheres with spheres first, then
  /// spheres with cells, then cells with cells, each in ascending order of the ids. Cells that
  /// share a node are never a pair. One entry for each pair of elements; what a sphere on several
  /// cells is pushed by is for contacts to decide. The same whatever the number of threads. Valid
  /// until the next call.
  /// @param x  m, one position for each node, finite and below 1e75
  /// @throws std::invalid_argument if that are not as many as there are nodes, or naming those
  ///         whose coordinates are not so
  std::span<const Proximity> find(Positions x);

  /// The elements of each entry that the last find() gave.
  std::span<const ElementPair> found_elements() const noexcept { return found_elements_; }

  const Surface& surface() const noexcept { return *surface_; }

 private:
  /// What one thread has found.
  struct Found {
    std::vector<Proximity> proximities;
    std::vector<ElementPair> elements;
  };

  void list_candidates(Positions x);
  void list_cell_pairs(Positions x);
  bool is_chosen(CellId a, CellId b) const;
  Proximity proximity_of(const ElementPair& pair, Positions x) const;

  Elements elements_;
  PairChoice choice_;
  std::vector<Sphere>
      grown_;  ///< the spheres with largest_gap more radius: what the neighbours see
  std::unique_ptr<Surface> surface_;  ///< at a fixed address, which the neighbours know
  std::unique_ptr<ThreadPool> pool_;
  std::unique_ptr<Neighbours> neighbours_;
  Skin cell_skin_;
  BroadPhase cell_tree_;
  std::vector<Box> cell_boxes_;
  std::vector<IndexPair> cell_pairs_;
  std::vector<ElementPair> candidates_;
  std::vector<Found> found_by_worker_;
  std::vector<Proximity> found_;
  std::vector<ElementPair> found_elements_;
};

}  // namespace plekton::geometry

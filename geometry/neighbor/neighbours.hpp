// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/neighbor/exclusion_groups.hpp"
#include "geometry/neighbor/skin.hpp"
#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace plekton::geometry {

class StateArchive;

/// The cells of one structure that a sphere may touch: a part of Neighbours::cells().
struct NearCells {
  std::uint32_t first;
  std::uint32_t count;
};

/// Which spheres and cells may touch each other, kept up to date while the nodes move.
///
/// The lists are supersets: a pair that is not in them does not touch. They are made anew only when
/// some node has moved by more than half the skin since they were made (skin.hpp has the proof).
class Neighbours {
 public:
  /// @param spheres, surface  must outlive this; their nodes are not checked
  /// @param skin  m, >= 0; 0 makes the lists anew in each update whose way is not 0
  /// @param reach  m, at which distance of the surfaces a pair is wanted already
  /// @throws std::invalid_argument for a skin as Skin does
  Neighbours(std::span<const Sphere> spheres, const Surface& surface, double skin,
             double reach = 0.0);

  /// Pairs within a group are not listed. To be called before the first update.
  void leave_out(ExclusionGroups groups) { groups_ = std::move(groups); }

  /// From now on finds pairs of spheres in a share of all that there is. All else is whole.
  void take_share(const SearchShare& share) noexcept { share_ = share; }

  /// From now on chooses the skin anew whenever the lists are made, from how many steps the last
  /// ones lasted: the one for which the lists and the pairs in them, which grow with the skin, cost
  /// least together. It depends on the motion alone, not on measured times. The pairs that touch
  /// are listed with any skin.
  /// @param radius  m, > 0, of a usual sphere
  void tune_skin(double radius) noexcept { usual_radius_ = radius; }

  /// Makes the lists anew if they have to be. @returns whether they were
  /// @param way  m, see Skin::may_need_rebuild
  bool update(Positions x, ThreadPool& pool, double way = std::numeric_limits<double>::infinity()) {
    const bool are_due = is_due(x, pool, way);
    if (are_due) make(x, pool);
    return are_due;
  }

  // The same in two, for ranks that do not know all nodes as long as no lists are made.

  /// Whether the lists have to be made anew. To be asked once in a step.
  /// @param known  see Skin::needs_rebuild
  bool is_due(Positions x, ThreadPool& pool, double way, const KnownNodes* known = nullptr);
  /// Makes them.
  void make(Positions x, ThreadPool& pool);

  /// Goes on with what is left of the surface: the lists stay as they are but for the cells that
  /// are gone; the sides that a torn facet has left take its place. So pairs of spheres keep their
  /// order, and the lists last as long as they would have. Linear in the length of the lists, times
  /// log for sorting.
  /// @param change  to what the surface is now
  void follow(const SurfaceChange& change);

  /// The lists are made anew from where the nodes were when they were made. @throws StateMismatch
  void exchange(const StateArchive& archive, ThreadPool& pool);
  /// m, where the nodes were when the lists were made; empty before that.
  Positions list_positions() const noexcept { return skin_.listed_positions(); }

  double skin() const noexcept { return 2.0 * skin_.margin(); }
  /// How often the lists were made.
  std::int64_t rebuild_count() const noexcept { return rebuild_count_; }

  /// Pairs of spheres, sorted; those of the share that is taken.
  std::span<const IndexPair> sphere_pairs() const noexcept { return sphere_pairs_; }
  std::size_t sphere_count() const noexcept { return spheres_.size(); }

  /// Pairs (sphere, structure), sorted.
  std::span<const IndexPair> sphere_structures() const noexcept { return sphere_structures_; }
  /// For each of these, which of the cells.
  std::span<const NearCells> near_cells() const noexcept { return near_cells_; }
  /// Ascending within each pair.
  std::span<const CellId> cells() const noexcept { return cells_; }

 private:
  void choose_skin();
  void rebuild(Positions x, ThreadPool& pool);
  template <class Boxes>
  void fit(BroadPhase& tree, const Boxes& boxes);
  /// Of the spheres whose boxes overlap, those whose surfaces are at most the skin apart: as no
  /// centre moves by more than half the skin, no others can touch. A third fewer pairs to look at
  /// in every step of a dense bed.
  bool may_touch(const IndexPair& pair, Positions x) const noexcept;
  void group_by_structure();

  std::span<const Sphere> spheres_;
  const Surface* surface_;
  SearchShare share_;
  Skin skin_;
  double reach_;
  ExclusionGroups groups_;
  BroadPhase sphere_tree_;
  BroadPhase cell_tree_;
  std::vector<Box> boxes_;  ///< of cells
  std::vector<IndexPair> sphere_pairs_;
  std::vector<IndexPair> sphere_cells_;
  std::vector<IndexPair> sphere_structures_;
  std::vector<NearCells> near_cells_;
  std::vector<CellId> cells_;
  std::int64_t rebuild_count_ = 0;
  double usual_radius_ = 0.0;  ///< m; 0: the skin stays as it is
  int steps_of_list_ = 0;      ///< updates since the lists were made
};

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/critical/product_features.hpp"
#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/neighbor/exclusion_groups.hpp"
#include "geometry/neighbor/near_nodes.hpp"
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

/// Which cells of a surface may touch each other: of different structures, and of one structure
/// with itself where it folds.
///
/// The list is a superset, made anew only when some node has moved by more than half the skin
/// (skin.hpp). Cells of one structure that hang together are not in it: those that share a node,
/// and those with nodes near each other along edges at rest (near_nodes.hpp); likewise of pieces of
/// a structure that has fallen apart, so that nothing is pushed apart by a break alone.
class CellNeighbours {
 public:
  /// @param surface       must outlive this
  /// @param rest          m, where the nodes are when the structures are at rest
  /// @param skin          m, >= 0; 0 makes the list anew in each update whose way is not 0
  /// @param self_contact  whether cells of one structure are listed
  /// @throws std::invalid_argument for a skin as Skin does; std::length_error where the lists of
  /// near nodes would take GB (near_nodes.hpp)
  CellNeighbours(const Surface& surface, Positions rest, double skin, bool self_contact);

  /// Pairs within a group are not listed. To be called before the first update.
  void leave_out(ExclusionGroups groups) { groups_ = std::move(groups); }

  /// From the next list on, a skin of the radius of the thinnest structure (a quarter of it where
  /// edges are far shorter than thick): a longer list costs little, because contacts leave far
  /// pairs alone, and making it costs much.
  void choose_skin();

  /// Makes the list anew if it has to be. @returns whether it has changed
  /// @param way  m, see Skin::may_need_rebuild
  bool update(Positions x, ThreadPool& pool, double way = std::numeric_limits<double>::infinity());

  /// Goes on with what is left of the surface: the next update makes the list anew.
  void follow(const SurfaceChange& change);

  /// The list is made anew from where the nodes were when it was made. @throws StateMismatch
  void exchange(const StateArchive& archive, ThreadPool& pool);

  /// Sorted; a on the lower structure, or on the same and lower itself.
  std::span<const CellPair> pairs() const noexcept { return pairs_; }
  /// How often the list was made.
  std::int64_t rebuild_count() const noexcept { return rebuild_count_; }

 private:
  bool may_touch(CellId a, CellId b) const;
  bool are_distant(CellId a, CellId b, Positions x) const;
  void find_own_nodes();
  void collect_parts();
  void gather_own_nodes(Positions x);
  void make_list(Positions x, ThreadPool& pool);
  void make_boxes(Positions x);
  std::span<const CellId> cells_of_part(std::int32_t part) const noexcept;
  bool may_parts_touch(std::int32_t a, std::int32_t b) const;

  const Surface* surface_;
  Skin skin_;
  bool self_contact_;
  ExclusionGroups groups_;
  std::int64_t rebuild_count_ = 0;
  std::vector<NodeId> own_nodes_;  ///< those of cells
  std::vector<Vec3> own_x_;
  BroadPhase tree_;
  /// Cells of a group of near nodes go into the tree as one part; where each node is a group of
  /// its own, so does each cell. Parts whose groups are near each other need no look at their
  /// cells, of which there are very many where edges are far shorter than thick.
  std::vector<CellId> part_cells_;        ///< part by part
  std::vector<std::size_t> part_begins_;  ///< by part, where its cells begin; and their end
  std::vector<std::int32_t> part_group_;  ///< by part; -1 of a cell by itself
  std::vector<Box> boxes_;                ///< by part
  std::vector<IndexPair> overlaps_;
  std::vector<CellPair> pairs_;
  std::vector<CellPair> previous_;
  NearNodes near_nodes_;
};

/// Box (m) of a cell, grown by its radius and a margin.
Box box(const Surface& surface, CellId cell, Positions x, double margin) noexcept;

}  // namespace plekton::geometry

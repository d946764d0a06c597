// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/base/types.hpp"

#include <span>
#include <vector>

namespace plekton::geometry {

class Ranks;
class StateArchive;

/// Of which nodes one of several ranks knows where they are: together they know of all.
struct KnownNodes {
  Ranks* ranks;
  std::span<const NodeId> common;  ///< known to all ranks
  std::span<const NodeId> own;     ///< known to this one
};

/// m. Squares of shorter skins would vanish.
inline constexpr double kSmallestSkin = 1e-100;

/// How long a list of overlapping boxes stays good while the nodes move: a Verlet list with a
/// proven rule.
///
/// Let every box be made from the node positions x at some moment and grown by margin() = skin / 2
/// on all sides. Claim: as long as no node has moved by more than skin / 2 since then, every two
/// elements that touch are in the list of overlapping boxes. Proof: A point of an element with
/// radius r is sum w_k x_k + q with weights w_k >= 0 of sum 1 and |q| <= r. With displacements u_k
/// it is now sum w_k x_k + sum w_k u_k + q. The middle term is no longer than max |u_k| <= skin /
/// 2, since the ball of that radius is convex, so the point is still within r + skin / 2 of the old
/// core and thereby in the old box. Two elements that touch have a point in common; it lies in both
/// old boxes, so these overlap. The same holds for elements that come nearer than a range g if the
/// boxes are grown by g / 2 more, and growth of a radius counts as displacement. Nothing else moves
/// a box: the rule is one for nodes, whatever they carry.
///
/// Rounding: needs_rebuild compares 4 |u|^2 with skin^2 (1 - 1e-12). Each component of u is one
/// subtraction, so the computed |u|^2 is within 5 eps of the true one, and the rest of 1e-12 pays
/// for what rounding took from a box: r + margin is within eps (r + margin) / 2 of its value, less
/// than 2.4e-13 skin whenever skin > 1e-3 r.
class Skin {
 public:
  /// @param skin m. Zero asks for a rebuild at every question.
  /// @throws std::invalid_argument if it is negative, not finite, or between 0 and
  /// kSmallestSkin
  explicit Skin(double skin);

  /// Takes another skin, from the next list on: mark_built() has to follow.
  /// @throws as the constructor
  void set(double skin);

  /// How far to grow every box on all sides (m): half the skin.
  double margin() const noexcept { return 0.5 * skin_; }

  /// Remembers the node positions from which the list is being built. Allocates only when their
  /// number grows.
  void mark_built(Positions x);

  /// Whether the list may miss a pair: some node has moved by more than half the skin (or is NaN),
  /// the number of nodes has changed, or nothing has been built yet. O(number of nodes).
  /// @param known  null: this process knows all nodes; else asked by all ranks, with one answer
  bool needs_rebuild(Positions x, ThreadPool& pool, const KnownNodes* known = nullptr);

  /// Asks less often: adds up how far nodes may have moved, and is false as long as the sum is
  /// below half the skin, so that needs_rebuild would be false too. A sum that is above it begins
  /// anew from what needs_rebuild sees. O(1).
  /// @param way  m, how far any node has moved at most since the last call, but for the rounding of
  ///             x += v dt; infinite if that is not known
  bool may_need_rebuild(double way) noexcept;

  /// m, from which the list was built; empty if nothing has been built yet.
  Positions built_positions() const noexcept {
    return built_ ? Positions(built_positions_) : Positions();
  }

  /// m, of the list that there is, also where it is due to be made anew; empty if there is none.
  Positions listed_positions() const noexcept { return built_positions_; }
  /// The list is due, wherever nodes are.
  void expire() noexcept { built_ = false; }

  void exchange(const StateArchive& archive);

 private:
  template <class NodeAt>
  double largest_square(Positions x, std::size_t count, const NodeAt& node_at, ThreadPool& pool);

  double skin_;
  bool built_ = false;
  std::vector<Vec3> built_positions_;
  double way_ = 0.0;             ///< m, no node has moved further since the list was built
  double furthest_ = 0.0;        ///< m, largest coordinate when it was built
  std::vector<double> largest_;  ///< m², by thread
};

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

/// How much of each pass counts when basins are joined: the correction of the contact rule for holes.
///
/// The basins (minima) of a contact region and the passes between them form a graph. The region has one connected
/// component per tree of a spanning forest, so a forest's passes must be subtracted from the minima, once each, and a
/// pass that only closes a ring around a hole must not. On a ring nothing says which pass is the one too many; picking
/// the shallowest would make the force jump whenever two of them tie. Every spanning tree gets a say instead, with a
/// probability proportional to the product of (overlap of its passes)^2; the weight of a pass is the probability that
/// it is in the tree. So:
///   - a pass on no ring has weight 1; the weights sum to basins - components (Foster's theorem), so what is counted
///     is exactly the number of components;
///   - on a single ring the unit that is left out is shared in proportion to overlap^-2: a symmetric ring shares
///     evenly, and a pass that leaves the range takes the unit with it, continuously.
/// Source: transfer-current theorem, Burton & Pemantle, Annals of Probability 21 (1993); Lyons & Peres, Probability on
/// Trees and Networks (2016), chapter 4.
namespace plekton::contact {

/// A pass between two basins.
struct Link {
  std::uint32_t a;
  std::uint32_t b;
  double overlap;  ///< m, > 0: how far the pass is in range
};

/// Keeps its working space, so that a warm call without rings does not allocate.
class SpanningWeights {
 public:
  /// Weights of the links, each in [0, 1].
  ///
  /// Computed on the cycle space: with resistances R = overlap^-2 and the fundamental cycles C of the spanning forest
  /// of greatest overlap, a link is left out with probability R_e (C^T (C R C^T)^-1 C)_ee. Scaled by the closing links
  /// the matrix is the identity plus a positive semidefinite one with entries of at most the length of a path, so it
  /// is well conditioned however different the overlaps are.
  /// @param links  sorted by falling overlap; loops (a == b) get weight 0
  std::span<const double> find(std::uint32_t basin_count, std::span<const Link> links);

  /// Basins that hang together have the same root, the lowest of them. Of the last call.
  std::uint32_t root_of(std::uint32_t basin) const noexcept;

 private:
  struct Parent {
    std::uint32_t basin;
    std::uint32_t link;
    std::uint32_t depth;
  };

  void grow_forest(std::uint32_t basin_count, std::span<const Link> links);
  void hang_trees(std::uint32_t basin_count, std::span<const Link> links);
  void share_rings(std::span<const Link> links);

  std::vector<std::uint32_t> root_;
  std::vector<std::uint32_t> tree_links_;
  std::vector<std::uint32_t> closing_links_;
  std::vector<Parent> parent_;
  std::vector<double> weights_;
  Eigen::MatrixXd cycles_;  ///< closing link x tree link: signed, scaled overlap of closing over tree link
};

}  // namespace plekton::contact

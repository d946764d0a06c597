// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/spanning_forest.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// How much of each pass counts when basins are joined: the correction of the contact rule for
/// holes.
///
/// The minima of a contact region and the passes between them are the vertices of a graph; every
/// branch of a pass is a link from it down to the first minimum or pass that it meets. The region
/// has one connected component per tree of a spanning forest of this graph, so what a forest joins
/// must be subtracted from the minima, once each, and a link that only closes a ring around a hole
/// must not. On a ring nothing says which link is the one too many; picking the shallowest would
/// make the force jump whenever two of them tie. Every spanning tree gets a say instead, with a
/// probability proportional to the product of the conductances of its links; the weight of a link
/// is the probability that it is in the tree. So:
///   - a link on no ring has weight 1; the weights sum to vertices - components (Foster's theorem),
///   so what is counted
///     is exactly the number of components;
///   - on a single ring the unit that is left out is shared in proportion to the resistances: a
///   symmetric ring shares
///     evenly, and a pass that leaves the range, where resistances grow without bound, takes the
///     unit with it;
///   - the resistance of a link is what overlap^-2 falls by from its upper to its lower end
///   (link_resistance). So a pass
///     that is born, dies or slides along a wire changes nothing but what it adds itself:
///     resistances in a row add up, and a pass beside its minimum is one with it. On a net the
///     force is Lipschitz in the position, and the same whatever the order of creation. (With
///     overlap^-2 of the upper end alone, and links that run on through lower passes by the first
///     branch they find, a grain on a net of aperture R/20 at 5 % overlap felt jumps of 0.3 of a
///     contact at any step, and a pull sideways of 0.14 when it was centred.)
/// Source: transfer-current theorem, Burton & Pemantle, Annals of Probability 21 (1993); Lyons &
/// Peres, Probability on Trees and Networks (2016), chapter 4.
namespace plekton::contact {

/// Keeps its working space, so that a warm call does not allocate.
class SpanningWeights {
 public:
  /// Weights of the links, each in [0, 1].
  ///
  /// Computed on the cycle space: with the fundamental cycles C of a spanning forest of little
  /// resistance R, a link is left out with probability R_e (C^T (C R C^T)^-1 C)_ee. Scaled by the
  /// closing links the matrix is the identity plus a positive semidefinite one with entries of at
  /// most the length of a path, so it is well conditioned however different the resistances are.
  /// @param links  loops (a == b) get weight 0
  /// @returns      in the order of the links; valid until the next call
  std::span<const double> find(std::uint32_t vertex_count, std::span<const Link> links);

  /// Vertices that hang together have the same root, the lowest of them. Of the last call.
  std::uint32_t root_of(std::uint32_t vertex) const noexcept { return forest_.root_of(vertex); }

 private:
  void fill_cycles(std::span<const Link> links);
  void share_rings(std::span<const Link> links);

  SpanningForest forest_;
  std::vector<double> weights_;
  // Working space of share_rings.
  std::vector<std::uint32_t> tree_place_;  ///< by link: its place among the tree links
  std::vector<double> cycles_;  ///< closing link x tree link: signed root of the tree link's share
                                ///< of the closing one's resistance
  std::vector<double> gram_;  ///< closing link x closing link: 1 + C C^T, then its Cholesky factor
  std::vector<double> column_;  ///< closing link
};

}  // namespace plekton::contact

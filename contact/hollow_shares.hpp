// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/shells.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// How the hollows of some facets are shared over their corners, for every part of them below a
/// corner.
///
/// The share of a facet is its diagonal entry of the projection on the space of shells
/// (shells.hpp), when a facet taken c times weighs c^2 times the sum of the weights of its corners;
/// a corner gets its part of that sum. So the shares are never negative, add up to the number of
/// hollows, and depend on nothing but weights and connections: not on numbers, and as smoothly on
/// the position as the weights do. On a single shell a corner has its weight times the number of
/// facets around it, over the sum of these. This is what harmonic_shares.hpp does with rings, one
/// dimension up; but nothing fills a hollow.
///
/// With shells Z whose last facets L are in no other shell, and facet weights W, a facet has the
/// share W_f z_f^T (Z^T W Z)^-1 z_f. Scaled by the roots of the weights of L the matrix is the
/// identity plus a positive semidefinite one; corners nearer than the last one weigh less, so it is
/// well conditioned however different the weights are (as in spanning_weights.hpp).
class HollowShares {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  /// @param facets  ascending by upper
  void build(std::span<const WholeFacet> facets) { shells_.build(facets); }

  /// Hollows of the part of all facets whose corners are below this number.
  std::size_t hollow_count(std::uint32_t vertex_count) const noexcept;

  /// Shares of the corners of that part. Takes the third power of the number of hollows.
  /// @param weights  by corner, > 0; rising with the number, but for rounding
  /// @returns        by corner; valid until the next call
  std::span<const double> find(std::uint32_t vertex_count, std::span<const double> weights);

 private:
  void list_by_facet(std::size_t hollows, std::span<const double> weights);
  void invert_products(std::size_t hollows, std::span<const double> weights);
  double weight_of(std::uint32_t facet, std::span<const double> weights) const noexcept;

  Shells shells_;
  std::vector<double> scale_;            ///< by shell: weight of its last facet to the power -1/2
  std::vector<std::uint32_t> first_;     ///< by facet: its first entry in by_facet_
  std::vector<Shells::Entry> by_facet_;  ///< which shells take a facet, scaled
  std::vector<double> products_;         ///< shell x shell, then the Cholesky factor
  std::vector<double> inverse_;          ///< shell x shell
  std::vector<double> shares_;
};

}  // namespace plekton::contact

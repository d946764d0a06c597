// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Which pairs of features count how often, so that the union of many pairs of cells is counted
/// once.
///
/// A set K of pairs of cells, with all pairs of their faces, is a complex of convex products. Let
///
///     weight(a, b) = 1 - sum of the weights of all pairs in K that have (a, b) as a proper face.
///
/// Then the weights of the closed products that hold any one point of the union add up to 1
/// (inclusion and exclusion), and so do, for any function with convex sublevel sets on each
/// product, the weights of those that a sublevel set meets: to its Euler number, which is 1 for
/// every part of it that hangs together without a hole. Of two whole surfaces the weight is the
/// product of the weights of both features, which are 1 for a facet, 1 - facets for an edge and 1 -
/// edges + facets for a node: so 1, -1, 1 inside a sheet and 0 on its rim, however it is cut into
/// facets.
/// Source: Euler integration, Schapira, J. Pure Appl. Algebra 72 (1991) 83-93.
namespace plekton::geometry {

/// Two cells that may touch.
struct CellPair {
  CellId a;
  CellId b;

  friend constexpr auto operator<=>(const CellPair&, const CellPair&) = default;
};

/// Two features that count. Of two structures, a is on the lower one.
struct FeaturePair {
  Feature a;
  Feature b;
  std::int32_t weight;  ///< not 0
  std::uint32_t
      first_holder;  ///< the pairs of cells that have it: a part of ProductFeatures::holders
  std::uint32_t holder_count;
};

struct ProductFeatures {
  /// Of weight other than 0: products of higher dimension first; within one dimension in the order
  /// of the cell pairs that have them.
  std::vector<FeaturePair> pairs;
  /// Places in the list of cell pairs, ascending for each feature pair.
  std::vector<std::uint32_t> holders;
};

/// @param pairs  sorted, each once; the cells of a pair share no node
ProductFeatures product_features(const Surface& surface, std::span<const CellPair> pairs);

/// product_features() of one list after the other, in memory that it keeps. A copy begins without.
class ProductFeatureFinder {
 public:
  ProductFeatureFinder() = default;
  ProductFeatureFinder(const ProductFeatureFinder&) noexcept {}
  ProductFeatureFinder(ProductFeatureFinder&&) noexcept = default;
  ProductFeatureFinder& operator=(const ProductFeatureFinder&) noexcept { return *this; }
  ProductFeatureFinder& operator=(ProductFeatureFinder&&) noexcept = default;
  ~ProductFeatureFinder() = default;

  /// @returns what lasts until the next call
  const ProductFeatures& find(const Surface& surface, std::span<const CellPair> pairs);

 private:
  using Key = std::array<Feature, 2>;

  std::uint32_t number_of(const Key& key);
  std::size_t slot_of(const Key& key) const noexcept;
  void grow();
  void list_faces(const Surface& surface, std::span<const CellPair> pairs);
  void list_holders();
  void sort_by_dimension();
  std::span<const std::uint32_t> holders_of(std::uint32_t number) const noexcept {
    return {holders_.data() + first_holders_[number], holders_.data() + first_holders_[number + 1]};
  }

  /// Pairs of features by number, in the order in which they were asked for first. Open addressing,
  /// at most half full.
  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;  ///< 2^n

  std::vector<std::uint32_t> faces_;        ///< of all pairs of cells, by number
  std::vector<std::size_t> face_ends_;      ///< by pair of cells: where its faces end
  std::vector<std::size_t> first_holders_;  ///< by number, and the number of all
  std::vector<std::uint32_t>
      holders_;  ///< pairs of cells that have each pair of features, ascending
  std::vector<std::size_t> next_;
  std::vector<std::uint32_t> sorted_;  ///< numbers, those of higher dimension first, else ascending
  std::vector<std::int32_t> covered_;  ///< by number: weights of those it is a proper face of
  ProductFeatures found_;
};

/// Nodes of a feature: 1, 2 or 3.
struct FeatureNodes {
  std::array<NodeId, 3> ids;
  std::size_t count;

  const NodeId* begin() const noexcept { return ids.data(); }
  const NodeId* end() const noexcept { return ids.data() + count; }
};
FeatureNodes nodes_of(const Surface& surface, const Feature& feature) noexcept;

/// The feature that has these nodes, in any order; without an id if there is none.
Feature feature_of(const Surface& surface, const FeatureNodes& nodes) noexcept;

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/product_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace plekton::geometry::product_features_test {
namespace {

NodeId node(int i) {
  return NodeId{i};
}

/// Two squares of two facets each, then a chain of three cylinders.
Surface two_squares_and_a_chain() {
  const double r = 0.1;
  const std::vector<Facet> facets{{{node(0), node(1), node(2)}, r},
                                  {{node(1), node(3), node(2)}, r},
                                  {{node(4), node(5), node(6)}, r},
                                  {{node(5), node(7), node(6)}, r}};
  const std::vector<Cylinder> cylinders{
      {{node(8), node(9)}, r}, {{node(9), node(10)}, r}, {{node(10), node(11)}, r}};
  return {cylinders, facets, 12};
}

std::vector<CellPair> all_pairs(int first, int last, int first_other, int last_other) {
  std::vector<CellPair> pairs;
  for (int a = first; a <= last; ++a) {
    for (int b = first_other; b <= last_other; ++b) pairs.push_back({CellId{a}, CellId{b}});
  }
  return pairs;
}

int sum_of_weights(const ProductFeatures& features) {
  int sum = 0;
  for (const FeaturePair& pair : features.pairs) sum += pair.weight;
  return sum;
}

TEST(ProductFeatures, OfTwoSheetsWeighTheProductOfBothFeatures) {
  const Surface surface = two_squares_and_a_chain();
  const ProductFeatures features = product_features(surface, all_pairs(0, 1, 2, 3));
  // In each square two facets weigh 1, the diagonal -1, the rim nothing.
  ASSERT_EQ(features.pairs.size(), 9u);
  for (const FeaturePair& pair : features.pairs) {
    const auto weight = [](const Feature& f) { return f.kind == FeatureKind::face ? 1 : -1; };
    EXPECT_EQ(pair.weight, weight(pair.a) * weight(pair.b));
    EXPECT_EQ(pair.holder_count,
              pair.a.kind == pair.b.kind ? (pair.a.kind == FeatureKind::face ? 1u : 4u) : 2u);
  }
  EXPECT_EQ(sum_of_weights(features), 1);
}

TEST(ProductFeatures, PutTheLowerStructureFirst) {
  const Surface surface = two_squares_and_a_chain();
  const ProductFeatures features = product_features(surface, all_pairs(0, 1, 4, 6));
  const auto structure = [&](const Feature& f) {
    return surface.structure_of(nodes_of(surface, f).ids[0]);
  };
  for (const FeaturePair& pair : features.pairs) {
    EXPECT_LT(structure(pair.a), structure(pair.b));
  }
}

/// Weights of all pairs add up to the Euler number of the union: here of random sets of products,
/// counted by cells of every dimension.
TEST(ProductFeatures, WeighTheEulerNumberOfAnySetOfProducts) {
  const Surface surface = two_squares_and_a_chain();
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<CellPair> pairs = all_pairs(0, 1, 2, 6);
    std::erase_if(pairs, [&](const CellPair&) { return random() % 3 == 0; });
    std::map<std::pair<Feature, Feature>, int> cells;
    const auto faces_of = [&](CellId cell) {
      std::vector<Feature> faces{surface.feature_of(cell)};
      if (faces[0].kind == FeatureKind::face) {
        for (const EdgeId edge : surface.edges_of(FaceId{faces[0].id})) faces.emplace_back(edge);
      }
      for (const NodeId n : surface.nodes_of(cell)) faces.emplace_back(n);
      return faces;
    };
    for (const CellPair& pair : pairs) {
      for (const Feature& a : faces_of(pair.a)) {
        for (const Feature& b : faces_of(pair.b)) {
          cells[{a, b}] = (static_cast<int>(a.kind) + static_cast<int>(b.kind)) % 2 == 0 ? 1 : -1;
        }
      }
    }
    int euler = 0;
    for (const auto& [cell, sign] : cells) euler += sign;
    EXPECT_EQ(sum_of_weights(product_features(surface, pairs)), euler) << trial;
  }
}

/// Two grids of n x n squares.
Surface two_grids(int n) {
  std::vector<Facet> facets;
  const auto add_grid = [&](int first) {
    const auto at = [&](int i, int k) { return node(first + i * (n + 1) + k); };
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        facets.push_back({{at(i, k), at(i + 1, k), at(i, k + 1)}, 0.1});
        facets.push_back({{at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}, 0.1});
      }
    }
  };
  const int nodes = (n + 1) * (n + 1);
  add_grid(0);
  add_grid(nodes);
  return {{}, facets, static_cast<std::size_t>(2 * nodes)};
}

TEST(ProductFeatures, TellWhichPairsOfCellsHaveThem) {
  constexpr int kSide = 12, kFacets = 2 * kSide * kSide;
  const Surface surface = two_grids(kSide);
  std::mt19937 random(9);
  std::vector<CellPair> pairs = all_pairs(0, kFacets - 1, kFacets, 2 * kFacets - 1);
  std::erase_if(pairs, [&](const CellPair&) { return random() % 300 != 0; });
  const ProductFeatures features = product_features(surface, pairs);
  const auto has = [&](CellId cell, const Feature& feature) {
    const FeatureNodes nodes = nodes_of(surface, feature);
    const auto of_cell = surface.nodes_of(cell);
    return std::ranges::all_of(
        nodes, [&](NodeId n) { return std::ranges::find(of_cell, n) != of_cell.end(); });
  };
  ASSERT_GT(features.pairs.size(), pairs.size());
  std::size_t first = 0;
  int last_dimension = 4;
  for (const FeaturePair& pair : features.pairs) {
    std::vector<std::uint32_t> having;
    for (std::uint32_t i = 0; i < pairs.size(); ++i)
      if (has(pairs[i].a, pair.a) && has(pairs[i].b, pair.b)) having.push_back(i);
    ASSERT_EQ(pair.first_holder, first);
    const auto holders = features.holders.begin() + static_cast<std::ptrdiff_t>(first);
    EXPECT_EQ(std::vector(holders, holders + pair.holder_count), having);
    first += pair.holder_count;
    const int dimension = static_cast<int>(pair.a.kind) + static_cast<int>(pair.b.kind);
    EXPECT_LE(dimension, last_dimension);
    last_dimension = dimension;
  }
  EXPECT_EQ(first, features.holders.size());
}

}  // namespace
}  // namespace plekton::geometry::product_features_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/product_features.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace plekton::geometry {
namespace {

/// A feature and its faces, the feature itself first.
struct Closure {
  std::array<Feature, 7> features;
  std::size_t count = 0;

  void add(const Feature& feature) { features[count++] = feature; }
  auto begin() const { return features.begin(); }
  auto end() const { return features.begin() + static_cast<std::ptrdiff_t>(count); }
};

Closure closure_of(const Surface& surface, const Feature& feature) {
  Closure closure;
  closure.add(feature);
  if (feature.kind == FeatureKind::face) {
    for (const EdgeId edge : surface.edges_of(FaceId{feature.id})) closure.add(Feature(edge));
  }
  if (feature.kind != FeatureKind::node) {
    for (const NodeId node : nodes_of(surface, feature)) closure.add(Feature(node));
  }
  return closure;
}

struct Key {
  Feature a;
  Feature b;
  friend bool operator==(const Key&, const Key&) = default;
};

struct KeyHash {
  std::size_t operator()(const Key& key) const noexcept {
    const auto half = [](const Feature& f) {
      return static_cast<std::uint64_t>(f.kind) << 32 | static_cast<std::uint32_t>(f.id);
    };
    const std::uint64_t mixed = (half(key.a) * 0x9e3779b97f4a7c15u) ^ (half(key.b) + 0x7f4a7c15u);
    return static_cast<std::size_t>(mixed * 0xff51afd7ed558ccdu >> 7);
  }
};

/// A pair of features while it is being counted.
struct Count {
  std::int32_t covered = 0;  ///< sum of the weights of the pairs it is a proper face of
  std::vector<std::uint32_t> holders;
};
using Counts = std::unordered_map<Key, Count, KeyHash>;

std::size_t dimension(const Feature& feature) {
  return static_cast<std::size_t>(feature.kind);
}

StructureId structure_of(const Surface& surface, const Feature& feature) {
  return surface.structure_of(nodes_of(surface, feature).ids[0]);
}

/// Both features, in the order in which they are kept.
Key ordered(const Surface& surface, const Feature& a, const Feature& b) {
  const StructureId on_a = structure_of(surface, a);
  const StructureId on_b = structure_of(surface, b);
  const bool keeps = on_a != on_b ? on_a < on_b : a < b;
  return keeps ? Key{a, b} : Key{b, a};
}

/// Calls visit for a pair of features and all pairs of their faces.
template <class Visit>
void for_each_face(const Surface& surface, const Feature& of_a, const Feature& of_b, Visit visit) {
  const Closure closure_b = closure_of(surface, of_b);
  for (const Feature& a : closure_of(surface, of_a)) {
    for (const Feature& b : closure_b) visit(ordered(surface, a, b));
  }
}

}  // namespace

FeatureNodes nodes_of(const Surface& surface, const Feature& feature) noexcept {
  if (feature.kind == FeatureKind::face) return {surface.nodes_of(FaceId{feature.id}), 3};
  const NodeId node{feature.id};
  if (feature.kind == FeatureKind::node) return {{node, node, node}, 1};
  const auto& ends = surface.nodes_of(EdgeId{feature.id});
  return {{ends[0], ends[1], ends[1]}, 2};
}

ProductFeatures product_features(const Surface& surface, std::span<const CellPair> pairs) {
  Counts counts;
  std::array<std::vector<Key>, 5> by_dimension;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const Feature a = surface.feature_of(pairs[i].a);
    for_each_face(surface, a, surface.feature_of(pairs[i].b), [&](const Key& key) {
      auto& holders = counts[key].holders;
      if (holders.empty()) by_dimension[dimension(key.a) + dimension(key.b)].push_back(key);
      holders.push_back(i);
    });
  }
  ProductFeatures found;
  for (std::size_t d = by_dimension.size(); d-- > 0;) {
    for (const Key& key : by_dimension[d]) {
      const Count& count = counts.at(key);
      const std::int32_t weight = 1 - count.covered;
      if (weight == 0) continue;
      found.pairs.push_back({key.a, key.b, weight, static_cast<std::uint32_t>(found.holders.size()),
                             static_cast<std::uint32_t>(count.holders.size())});
      found.holders.insert(found.holders.end(), count.holders.begin(), count.holders.end());
      for_each_face(surface, key.a, key.b, [&](const Key& face) {
        if (!(face == key)) counts.at(face).covered += weight;
      });
    }
  }
  return found;
}

Feature feature_of(const Surface& surface, const FeatureNodes& nodes) noexcept {
  const auto has_all = [&](std::span<const NodeId> of_feature) {
    return std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) {
      return std::find(of_feature.begin(), of_feature.end(), node) != of_feature.end();
    });
  };
  if (nodes.count == 1) return Feature(nodes.ids[0]);
  if (nodes.count == 2) {
    for (const EdgeId edge : surface.edges_of(nodes.ids[0]))
      if (has_all(surface.nodes_of(edge))) return Feature(edge);
  }
  if (nodes.count == 3) {
    for (const FaceId face : surface.faces_of(nodes.ids[0]))
      if (has_all(surface.nodes_of(face))) return Feature(face);
  }
  return {};
}

}  // namespace plekton::geometry

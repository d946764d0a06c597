// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/product_features.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

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

using Key = std::array<Feature, 2>;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::size_t hash_of(const Key& key) noexcept {
  const auto half = [](const Feature& f) {
    return static_cast<std::uint64_t>(f.kind) << 32 | static_cast<std::uint32_t>(f.id);
  };
  // Kinds are in high bits, and whoever asks looks at low ones.
  const std::uint64_t mixed =
      half(key[0]) * 0x9e3779b97f4a7c15u + half(key[1]) * 0xc2b2ae3d27d4eb4fu;
  return static_cast<std::size_t>((mixed ^ mixed >> 32) * 0xff51afd7ed558ccdu >> 24);
}

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

std::uint32_t ProductFeatureFinder::number_of(const Key& key) {
  if (2 * (keys_.size() + 1) > slots_.size()) grow();
  std::uint32_t& number = slots_[slot_of(key)];
  if (number == kNone) {
    number = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
  }
  return number;
}

std::size_t ProductFeatureFinder::slot_of(const Key& key) const noexcept {
  const std::size_t last = slots_.size() - 1;
  std::size_t slot = hash_of(key) & last;
  while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & last;
  return slot;
}

void ProductFeatureFinder::grow() {
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), kNone);
  for (std::uint32_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = i;
}

void ProductFeatureFinder::list_faces(const Surface& surface, std::span<const CellPair> pairs) {
  keys_.clear();
  std::ranges::fill(slots_, kNone);
  faces_.clear();
  face_ends_.clear();
  for (const CellPair& pair : pairs) {
    for_each_face(surface, surface.feature_of(pair.a), surface.feature_of(pair.b),
                  [&](const Key& key) { faces_.push_back(number_of(key)); });
    face_ends_.push_back(faces_.size());
  }
}

void ProductFeatureFinder::list_holders() {
  first_holders_.assign(keys_.size() + 1, 0);
  for (const std::uint32_t face : faces_) ++first_holders_[face + 1];
  std::inclusive_scan(first_holders_.begin(), first_holders_.end(), first_holders_.begin());
  next_ = first_holders_;
  holders_.resize(faces_.size());
  std::size_t face = 0;
  for (std::uint32_t pair = 0; pair < face_ends_.size(); ++pair) {
    for (; face < face_ends_[pair]; ++face) holders_[next_[faces_[face]]++] = pair;
  }
}

void ProductFeatureFinder::sort_by_dimension() {
  sorted_.clear();
  for (std::size_t d = 5; d-- > 0;) {
    for (std::uint32_t i = 0; i < keys_.size(); ++i)
      if (dimension(keys_[i][0]) + dimension(keys_[i][1]) == d) sorted_.push_back(i);
  }
}

const ProductFeatures& ProductFeatureFinder::find(const Surface& surface,
                                                  std::span<const CellPair> pairs) {
  list_faces(surface, pairs);
  list_holders();
  sort_by_dimension();
  found_.pairs.clear();
  found_.holders.clear();
  covered_.assign(keys_.size(), 0);
  for (const std::uint32_t i : sorted_) {
    const std::int32_t weight = 1 - covered_[i];
    if (weight == 0) continue;
    const auto having = holders_of(i);
    found_.pairs.push_back({keys_[i][0], keys_[i][1], weight,
                            static_cast<std::uint32_t>(found_.holders.size()),
                            static_cast<std::uint32_t>(having.size())});
    found_.holders.insert(found_.holders.end(), having.begin(), having.end());
    // The feature itself comes first, and is done.
    for_each_face(surface, keys_[i][0], keys_[i][1],
                  [&](const Key& face) { covered_[number_of(face)] += weight; });
  }
  return found_;
}

ProductFeatures product_features(const Surface& surface, std::span<const CellPair> pairs) {
  return ProductFeatureFinder().find(surface, pairs);
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

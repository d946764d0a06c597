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
    // Kinds are in high bits, and whoever asks looks at low ones.
    const std::uint64_t mixed =
        half(key.a) * 0x9e3779b97f4a7c15u + half(key.b) * 0xc2b2ae3d27d4eb4fu;
    return static_cast<std::size_t>((mixed ^ mixed >> 32) * 0xff51afd7ed558ccdu >> 24);
  }
};

/// Pairs of features by number, in the order in which they were asked for first. Open addressing, at
/// most half full.
class Numbers {
 public:
  std::uint32_t of(const Key& key) {
    if (2 * (keys_.size() + 1) > slots_.size()) grow();
    std::uint32_t& number = slots_[slot_of(key)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back(key);
    }
    return number;
  }
  const std::vector<Key>& keys() const noexcept { return keys_; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::size_t slot_of(const Key& key) const noexcept {
    const std::size_t last = slots_.size() - 1;
    std::size_t slot = KeyHash()(key) & last;
    while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & last;
    return slot;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), kNone);
    for (std::uint32_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = i;
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;  ///< 2^n
};

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

/// Numbers in rows of any length.
struct Rows {
  std::vector<std::size_t> firsts;  ///< by row, and the number of all
  std::vector<std::uint32_t> numbers;

  std::span<const std::uint32_t> row(std::size_t i) const {
    return {numbers.data() + firsts[i], numbers.data() + firsts[i + 1]};
  }
};

/// The pairs of cells that have each pair of features, ascending.
/// @param faces      of all pairs of cells, by number
/// @param face_ends  by pair of cells: where its faces end
Rows holders_of(std::size_t count, std::span<const std::uint32_t> faces,
                std::span<const std::size_t> face_ends) {
  Rows holders{std::vector<std::size_t>(count + 1, 0), std::vector<std::uint32_t>(faces.size())};
  for (const std::uint32_t face : faces) ++holders.firsts[face + 1];
  std::inclusive_scan(holders.firsts.begin(), holders.firsts.end(), holders.firsts.begin());
  std::vector<std::size_t> next(holders.firsts);
  std::size_t face = 0;
  for (std::uint32_t pair = 0; pair < face_ends.size(); ++pair) {
    for (; face < face_ends[pair]; ++face) holders.numbers[next[faces[face]]++] = pair;
  }
  return holders;
}

/// Numbers of those of higher dimension first, else ascending.
std::vector<std::uint32_t> by_dimension(std::span<const Key> keys) {
  const auto dimensions = [&](std::uint32_t i) {
    return dimension(keys[i].a) + dimension(keys[i].b);
  };
  std::vector<std::uint32_t> sorted;
  sorted.reserve(keys.size());
  for (std::size_t d = 5; d-- > 0;) {
    for (std::uint32_t i = 0; i < keys.size(); ++i)
      if (dimensions(i) == d) sorted.push_back(i);
  }
  return sorted;
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
  Numbers numbers;
  std::vector<std::uint32_t> faces;  // of all pairs of cells, by number
  std::vector<std::size_t> face_ends;
  for (const CellPair& pair : pairs) {
    for_each_face(surface, surface.feature_of(pair.a), surface.feature_of(pair.b),
                  [&](const Key& key) { faces.push_back(numbers.of(key)); });
    face_ends.push_back(faces.size());
  }
  const std::vector<Key>& keys = numbers.keys();
  const Rows holders = holders_of(keys.size(), faces, face_ends);

  ProductFeatures found;
  std::vector<std::int32_t> covered(keys.size(), 0);  // weights of those it is a proper face of
  for (const std::uint32_t i : by_dimension(keys)) {
    const std::int32_t weight = 1 - covered[i];
    if (weight == 0) continue;
    const auto having = holders.row(i);
    found.pairs.push_back({keys[i].a, keys[i].b, weight,
                           static_cast<std::uint32_t>(found.holders.size()),
                           static_cast<std::uint32_t>(having.size())});
    found.holders.insert(found.holders.end(), having.begin(), having.end());
    // The feature itself comes first, and is done.
    for_each_face(surface, keys[i].a, keys[i].b,
                  [&](const Key& face) { covered[numbers.of(face)] += weight; });
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/law/any_law.hpp"
#include "geometry/base/bit_hash.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Properties of pairs of materials, in any order of the two. The rest has those of
/// PropertiesOf<Law>{}.
template <class Law>
using PairProperties = std::map<std::pair<MaterialId, MaterialId>, PropertiesOf<Law>>;

/// The contact materials of a scene, and what their pairs do.
class MaterialPairs {
 public:
  using Parameters = AnyLaw::Parameters;

  /// @param others  properties of the pairs that have none of their own
  explicit MaterialPairs(std::vector<Material> materials = {},
                         const PairProperties<AnyLaw>& properties = {},
                         const AnyLaw::Properties& others = {})
      : materials_(std::move(materials)), others_(others) {
    for (const auto& [pair, of_pair] : properties)
      properties_[std::minmax(pair.first, pair.second)] = of_pair;
  }

  Parameters combine(const SphereBody& a, const SphereBody& b) const {
    return combine(BodyPart{a.material, a.radius, a.mass}, BodyPart{b.material, b.radius, b.mass});
  }
  Parameters combine(const BodyPart& a, const BodyPart& b) const {
    return AnyLaw::combine(properties(a.material, b.material),
                           {at(a.material), a.radius, a.mass, a.shape},
                           {at(b.material), b.radius, b.mass, b.shape});
  }

  const AnyLaw::Properties& properties(MaterialId a, MaterialId b) const {
    const auto own = properties_.find(std::minmax(a, b));
    return own == properties_.end() ? others_ : own->second;
  }

  /// From now on contacts are not those of the first step (end_start()).
  /// @returns whether that changed any pair
  bool end_start() {
    bool changed = AnyLaw::end_start(others_);
    for (auto& [pair, properties] : properties_) changed |= AnyLaw::end_start(properties);
    return changed;
  }

  /// Whether any contact may go on over a distance (HasInteractionRange).
  bool may_act_at_a_distance() const {
    return others_.law->has_interaction_range ||
           std::any_of(properties_.begin(), properties_.end(),
                       [](const auto& pair) { return pair.second.law->has_interaction_range; });
  }

  /// Of the materials and of the laws of their pairs: others have another one. Linear in both.
  std::uint64_t hash() const {
    geometry::BitHash hash;
    for (const Material& material : materials_) {
      for (const double number : {material.young_modulus, material.stiffness_ratio,
                                  material.friction, material.poisson_ratio})
        hash.add(number);
    }
    if (!materials_.empty()) add(others_, MaterialId{0}, MaterialId{0}, hash);
    for (const auto& [pair, of_pair] : properties_) {
      hash.add(static_cast<std::uint64_t>(pair.first));
      hash.add(static_cast<std::uint64_t>(pair.second));
      add(of_pair, pair.first, pair.second, hash);
    }
    return hash.value();
  }

  std::size_t size() const noexcept { return materials_.size(); }
  const Material& at(MaterialId id) const { return materials_[static_cast<std::size_t>(id)]; }

 private:
  /// Of bodies of some sizes and shapes: what a law makes of two materials, in the first step and
  /// later.
  void add(const AnyLaw::Properties& properties, MaterialId a, MaterialId b,
           geometry::BitHash& hash) const {
    for (const char c : properties.law->name)
      hash.add(std::uint64_t{static_cast<unsigned char>(c)});
    AnyLaw::Properties later = properties;
    hash.add(std::uint64_t{AnyLaw::end_start(later)});
    for (const Shape shape : {Shape::sphere, Shape::flat}) {
      const Parameters of_pair =
          AnyLaw::combine(properties, {at(a), 1.0, 1.0, Shape::sphere}, {at(b), 0.5, 1.0, shape});
      for (std::size_t i = 0; i < of_pair.law->parameter_numbers; ++i) hash.add(of_pair.numbers[i]);
    }
  }

  std::vector<Material> materials_;
  PairProperties<AnyLaw> properties_;
  AnyLaw::Properties others_;
};

/// What the bodies of a scene are made of, as far as contacts are concerned.
struct ContactMaterials {
  MaterialPairs pairs;
  std::vector<MaterialId> of_spheres;     ///< by SphereId
  std::vector<MaterialId> of_structures;  ///< by StructureId
  /// kg, by NodeId, for laws that ask for masses; empty: all bodies count as held.
  std::vector<double> masses = {};
  /// kg, by StructureId, mean of its nodes at the start, whatever breaks away; empty: of the nodes
  /// that it has.
  std::vector<double> structure_masses = {};

  double mass_of(geometry::NodeId node) const {
    return masses.empty() ? std::numeric_limits<double>::infinity() : masses[index_of(node)];
  }
};

}  // namespace plekton::contact

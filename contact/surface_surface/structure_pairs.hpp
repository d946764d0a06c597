// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/surface_surface/normal_spring.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/primitives/elements.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact::structure {

/// Two structures that may touch, or one that may touch itself.
struct StructurePair {
  std::array<std::int32_t, 2> structures;  ///< the lower one first
  AnyLaw::Parameters parameters;           ///< without the attraction
  double radius_first;                     ///< m, of the lower structure
  double radius_second;
  double attraction;  ///< N, of one contact
  /// What the parameters are of.
  struct Damped {
    AnyLaw::Properties properties;
    std::array<Body, 2> bodies;     ///< the lower structure first
    std::array<bool, 2> are_rigid;  ///< their nodes have the mass of all
  };
  std::shared_ptr<const Damped> damped;  ///< by the mass of what is rigid; null of any other pair

  /// Of a part of a contact, with that part of the mass of what is rigid: springs side by side
  /// carry it together, and so do their dashpots. What deforms has its mass in the nodes there.
  /// @param part  of its contacts; what is not between 0 and 1 counts as the whole
  AnyLaw::Parameters of_part(double part) const {
    if (damped == nullptr || !(part > 0.0 && part < 1.0)) return parameters;
    std::array<Body, 2> parts = damped->bodies;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (damped->are_rigid[i]) parts[i].mass *= part;
    return AnyLaw::without_attraction(AnyLaw::combine(damped->properties, parts[0], parts[1]));
  }
};

/// The pairs of structures that have been near each other, with their parameters and springs: each
/// is made when a list first has it, as of many structures few ever meet.
class StructurePairs {
 public:
  /// @param are_rigid  by StructureId: all nodes have the mass of the whole; empty: none is
  void set_rigid(std::vector<char> are_rigid) { are_rigid_ = std::move(are_rigid); }

  /// What structures bring to their pairs; the first call counts.
  void know_structures(const geometry::Surface& surface, const ContactMaterials& materials);
  /// Goes on with other parameters of the same materials.
  void take_parameters(const geometry::Surface& surface, const ContactMaterials& materials);

  /// The place of a pair of known structures, which is new or there already.
  std::uint32_t place_of(std::int32_t first, std::int32_t second, const MaterialPairs& materials);

  /// Of one that is there already. @throws std::out_of_range
  std::uint32_t place_of(std::int32_t first, std::int32_t second) const {
    return places_.at({first, second});
  }

  const StructurePair& operator[](std::uint32_t place) const noexcept { return pairs_[place]; }
  std::size_t size() const noexcept { return pairs_.size(); }
  /// By place.
  std::span<const NormalSpring> springs() const noexcept { return springs_; }
  /// Whether any two of them stick where they come to touch.
  bool glues() const noexcept { return glues_; }

  /// Which structures something is of. @returns their law. @throws geometry::StateMismatch
  const AnyLaw::Functions* exchange(geometry::RowFields& row, std::uint32_t& place) const;

 private:
  StructurePair pair_of(std::int32_t first, std::int32_t second,
                        const MaterialPairs& materials) const;

  std::vector<char> are_rigid_;        ///< by StructureId
  std::vector<BodyPart> structures_;   ///< by StructureId
  std::deque<StructurePair> pairs_;    // springs point there
  std::vector<NormalSpring> springs_;  ///< by place
  std::map<std::array<std::int32_t, 2>, std::uint32_t> places_;
  bool glues_ = false;
};

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_pairs.hpp"

#include "contact/base/bodies.hpp"
#include "contact/surface_surface/mean_node_masses.hpp"

#include <algorithm>
#include <utility>

namespace plekton::contact::structure {
namespace {

std::vector<BodyPart> parts_of(const geometry::Surface& surface,
                               const ContactMaterials& materials) {
  const std::vector<double> masses = materials.structure_masses.empty()
                                         ? mean_node_masses(surface, materials.masses)
                                         : materials.structure_masses;
  std::vector<BodyPart> parts;
  for (std::size_t i = 0; i < surface.structure_count(); ++i) {
    const auto id = geometry::id_at<geometry::StructureId>(i);
    parts.push_back(
        {materials.of_structures[i], surface.radius(id), masses[i], shape_of(surface, id)});
  }
  return parts;
}

}  // namespace

void StructurePairs::know_structures(const geometry::Surface& surface,
                                     const ContactMaterials& materials) {
  if (structures_.empty()) structures_ = parts_of(surface, materials);
}

void StructurePairs::take_parameters(const geometry::Surface& surface,
                                     const ContactMaterials& materials) {
  if (structures_.empty()) return;
  structures_ = parts_of(surface, materials);
  glues_ = false;
  for (StructurePair& pair : pairs_) {
    pair = pair_of(pair.structures[0], pair.structures[1], materials.pairs);
    glues_ = glues_ || AnyLaw::cements(pair.parameters);
  }
}

StructurePair StructurePairs::pair_of(std::int32_t first, std::int32_t second,
                                      const MaterialPairs& materials) const {
  const auto i = static_cast<std::size_t>(first), k = static_cast<std::size_t>(second);
  const BodyPart &a = structures_[i], &b = structures_[k];
  const AnyLaw::Parameters parameters = materials.combine(a, b);
  StructurePair pair{{first, second}, AnyLaw::without_attraction(parameters), a.radius,
                     b.radius,        AnyLaw::attraction(parameters),         nullptr};
  const auto is_rigid = [&](std::size_t of) {
    return of < are_rigid_.size() && are_rigid_[of] != 0;
  };
  if ((is_rigid(i) || is_rigid(k)) && AnyLaw::normal_damping(pair.parameters, -a.radius) > 0.0) {
    const auto body = [&](const BodyPart& of) {
      return Body{materials.at(of.material), of.radius, of.mass, of.shape};
    };
    pair.damped = std::make_shared<const StructurePair::Damped>(
        StructurePair::Damped{materials.properties(a.material, b.material),
                              {body(a), body(b)},
                              {is_rigid(i), is_rigid(k)}});
  }
  return pair;
}

std::uint32_t StructurePairs::place_of(std::int32_t first, std::int32_t second,
                                       const MaterialPairs& materials) {
  const auto [at, is_new] =
      places_.try_emplace({first, second}, static_cast<std::uint32_t>(pairs_.size()));
  if (!is_new) return at->second;
  const StructurePair& pair = pairs_.emplace_back(pair_of(first, second, materials));
  springs_.push_back(NormalSpring::of<AnyLaw>(
      pair.parameters, pair.radius_first + pair.radius_second, &pair.attraction));
  glues_ = glues_ || AnyLaw::cements(pair.parameters);
  return at->second;
}

const AnyLaw::Functions* StructurePairs::exchange(geometry::RowFields& row,
                                                  std::uint32_t& place) const {
  std::array<std::int32_t, 2> structures{-1, -1};
  if (!row.is_reading()) structures = pairs_[place].structures;
  row("structures", structures);
  const auto at = places_.find(structures);
  if (at == places_.end())
    throw geometry::StateMismatch(
        "in the state structures touch that are not near each other, or not there");
  place = at->second;
  return pairs_[place].parameters.law;
}

}  // namespace plekton::contact::structure

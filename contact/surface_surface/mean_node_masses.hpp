// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/material_pairs.hpp"
#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <vector>

namespace plekton::contact::structure {

/// kg, by StructureId; 0 of a structure without elements. What moves in a contact of structures is
/// about a node of each.
inline std::vector<double> mean_node_masses(const geometry::Surface& surface,
                                            const ContactMaterials& materials) {
  std::vector<double> masses(surface.structure_count(), 0.0);
  std::vector<double> counts(surface.structure_count(), 0.0);
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto node = geometry::id_at<geometry::NodeId>(n);
    const auto structure = surface.structure_of(node);
    if (structure == geometry::StructureId{-1}) continue;
    masses[index_of(structure)] += materials.mass_of(node);
    counts[index_of(structure)] += 1.0;
  }
  for (std::size_t i = 0; i < masses.size(); ++i) masses[i] /= std::max(1.0, counts[i]);
  return masses;
}

}  // namespace plekton::contact::structure

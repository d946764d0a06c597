// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// kg, by StructureId; 0 of a structure without elements. What moves in a contact of structures is
/// about a node of each.
/// @param node_masses  kg, by NodeId; empty: all infinite
inline std::vector<double> mean_node_masses(const geometry::Surface& surface,
                                            std::span<const double> node_masses) {
  constexpr double kHeld = std::numeric_limits<double>::infinity();
  std::vector<double> masses(surface.structure_count(), 0.0);
  std::vector<double> counts(surface.structure_count(), 0.0);
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto node = geometry::id_at<geometry::NodeId>(n);
    const auto structure = surface.structure_of(node);
    if (structure == geometry::StructureId{-1}) continue;
    masses[index_of(structure)] += node_masses.empty() ? kHeld : node_masses[n];
    counts[index_of(structure)] += 1.0;
  }
  for (std::size_t i = 0; i < masses.size(); ++i) masses[i] /= std::max(1.0, counts[i]);
  return masses;
}

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <limits>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// kg, by StructureId, of the nodes that move; infinite if none does, 0 of a structure without
/// elements. What moves in a contact of structures is about a node of each.
/// @param node_masses  kg, by NodeId, infinite of what is held; empty: all infinite
inline std::vector<double> mean_node_masses(const geometry::Surface& surface,
                                            std::span<const double> node_masses) {
  constexpr double kHeld = std::numeric_limits<double>::infinity();
  std::vector<double> masses(surface.structure_count(), 0.0);
  std::vector<double> moving(surface.structure_count(), 0.0);
  std::vector<char> has_nodes(surface.structure_count(), 0);
  for (std::size_t n = 0; n < surface.node_count(); ++n) {
    const auto node = geometry::id_at<geometry::NodeId>(n);
    const auto structure = surface.structure_of(node);
    if (structure == geometry::StructureId{-1}) continue;
    has_nodes[index_of(structure)] = 1;
    if (node_masses.empty() || !(node_masses[n] < kHeld)) continue;
    masses[index_of(structure)] += node_masses[n];
    moving[index_of(structure)] += 1.0;
  }
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (moving[i] > 0.0) masses[i] /= moving[i];
    if (moving[i] == 0.0 && has_nodes[i]) masses[i] = kHeld;
  }
  return masses;
}

}  // namespace plekton::contact::structure

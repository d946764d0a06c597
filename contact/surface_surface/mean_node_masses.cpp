// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/mean_node_masses.hpp"

#include <limits>

namespace plekton::contact::structure {

std::vector<double> mean_node_masses(const geometry::Surface& surface,
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

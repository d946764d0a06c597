// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <span>
#include <vector>

namespace plekton::contact::structure {

/// kg, by StructureId, of the nodes that move; infinite if none does, 0 of a structure without
/// elements. What moves in a contact of structures is about a node of each.
/// @param node_masses  kg, by NodeId, infinite of what is held; empty: all infinite
std::vector<double> mean_node_masses(const geometry::Surface& surface,
                                     std::span<const double> node_masses);

}  // namespace plekton::contact::structure

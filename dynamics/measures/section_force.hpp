// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/measures/force_and_moment.hpp"
#include "dynamics/state/node_state.hpp"

#include <vector>

namespace plekton::dynamics {

class BeamBonds;
class SheetFacets;

/// What a section carries that cuts some nodes from all others: what beams and sheets across it do
/// to these nodes. Torn elements carry nothing. Linear in the number of elements.
/// @param is_inside  by node, 1 of these, else 0
/// @param state      where the nodes were at the last advance of bonds and sheets
/// @param about      m, point of the moment
ForceAndMoment section_force(const std::vector<char>& is_inside, const NodeState& state,
                             const BeamBonds& bonds, const SheetFacets& sheets, const Vec3& about);

}  // namespace plekton::dynamics

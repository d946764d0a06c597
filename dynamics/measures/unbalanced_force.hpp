// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/measures/reactions.hpp"

namespace plekton::dynamics {

/// How far from balance a scene is: the mean magnitude of the resultant forces on free nodes,
/// weight included, over the mean magnitude of the forces between bodies and within structures. It
/// goes to 0 as everything comes to rest; 1e-2 to 1e-3 is usually called quasi-static.
///
/// Of nodes, those that are free along some axis count, along their free axes; of forces, those of
/// all contacts, bonds and ties, and those of sheet facets on their corners. As the unbalanced force of
/// YADE (Smilauer et al., Yade Documentation, 2nd ed. (2015), utils.unbalancedForce), after Cundall
/// & Strack.
/// @param carried  mean of the forces between bodies and within structures (N)
/// @returns  0 where no resultant is left, infinity where there is one and nothing is carried, or
///           less than 1e-10 of it, as rounding makes of stiff bonds that carry nothing
double unbalanced_force_ratio(const LoadedNodesView& nodes, double carried) noexcept;

}  // namespace plekton::dynamics

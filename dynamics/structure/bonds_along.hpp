// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/beam_bond.hpp"
#include "geometry/primitives/cylinder.hpp"

#include <limits>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// Stands for no bond.
inline constexpr std::size_t kNoBond = std::numeric_limits<std::size_t>::max();

/// For each cylinder the bond between its nodes: the first one that holds, else the first one;
/// kNoBond where there is none. Time grows with n log n for n bonds.
std::vector<std::size_t> bonds_along(std::span<const geometry::Cylinder> cylinders,
                                     const BeamBonds& bonds);

}  // namespace plekton::dynamics

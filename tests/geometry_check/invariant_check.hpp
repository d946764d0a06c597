// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/tally.hpp"

#include <cstdint>
#include <vector>

namespace plekton::geometry_check {

/// Statements about which features of a surface push on a point (geometry/critical_features.hpp):
///   - their coefficients add up to the Euler number of the surface, closed, open, non-manifold,
///     mixed, on lattices and turned;
///   - another numbering of nodes and cells gives the same features;
///   - so does a motion of everything on an integer lattice.
std::vector<InvariantTally> invariant_rows();

void check_invariant(InvariantTally& row, std::uint64_t trials, std::uint64_t seed);

}  // namespace plekton::geometry_check

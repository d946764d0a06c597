// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/tally.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace plekton::geometry_check {

/// Statements about which features of a surface push on a point
/// (geometry/critical/critical_features.hpp):
///   - their coefficients add up to the Euler number of the surface, closed, open, non-manifold,
///     mixed, on lattices and turned;
///   - another numbering of nodes and cells gives the same features;
///   - so does a motion of everything on an integer lattice;
///   - the force on a ball changes by no more than its motion allows (force_check.hpp);
/// about contacts of a ball that spread over many (spread_check.hpp, knot_check.hpp), and about
/// structures that touch each other or themselves (structure_check.hpp).
std::vector<InvariantTally> invariant_rows();

/// Each surface has a seed of its own, the first one this, the others those after it.
/// @param examples  gets the seed of the surface for each of the first violations; with that seed
///                  and one trial it is the first again
void check_invariant(InvariantTally& row, std::uint64_t trials, std::uint64_t seed,
                     std::vector<std::string>& examples);

}  // namespace plekton::geometry_check

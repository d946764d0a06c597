// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"

#include <cstdint>

namespace plekton::dynamics {

/// A hash of what moves (geometry/base/bit_hash.hpp): two runs of a scene that have the same one
/// after the same number of steps are the same to the bit so far, on whatever machines and with
/// any number of threads.
///
/// In this order: the number of steps; time (s); of each node, by id, position (m), velocity (m/s),
/// angular velocity (rad/s) and orientation (x, y, z, w); of each plane point (m) and velocity
/// (m/s), of a container radius (m) and widening (m/s) too; the number of the nodes, planes, bonds and facets of sheets, and the places of the
/// broken ones among the latter two. What contacts remember is not part of it: where that differs,
/// velocities do a step later. Linear in the number of nodes, about 20 ns each.
std::uint64_t state_hash(const Simulation& simulation);

}  // namespace plekton::dynamics

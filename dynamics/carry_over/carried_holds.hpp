// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/carry_over/late_starts.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/rigid/rigid_bodies.hpp"

#include <cstdint>
#include <vector>

namespace plekton::dynamics {

/// Stops what is held from now on. Rigid bodies that are held in another way turn from now on as
/// they move now; the others to the last bit as before.
/// @param places  of nodes
void follow_holds(const Scene& before, const std::vector<std::int32_t>& places, Scene& now,
                  RigidBodies& bodies);

/// Adds what was not there, and what was held along an axis, or moved as told, and is free now.
/// @param places  of nodes
void add_late_starts(const Scene& before, const std::vector<std::int32_t>& places, const Scene& now,
                     LateStarts& starts);

}  // namespace plekton::dynamics

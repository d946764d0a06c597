// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/problems.hpp"
#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"

#include <span>
#include <string>

namespace plekton::apps {

/// What to say where the lists of self-contact would take too much memory
/// (geometry::CellNeighbours): with the place of the membrane whose edges are the shortest against
/// its thickness.
/// @param membranes  at least one
InputError refused_self_contact(const Scenario& scenario, std::span<const BuiltMembrane> membranes,
                                const std::string& what);

}  // namespace plekton::apps

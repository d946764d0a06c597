// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/carry_over/scene_change.hpp"
#include "dynamics/model/scene.hpp"

#include <cstdint>
#include <vector>

namespace plekton::dynamics {

/// @throws std::invalid_argument listing every problem
void require_places(const Scene& before, const Scene& now, const SceneChange& change);

/// @param before  surface of the scene of before
/// @param places  of nodes
/// @throws geometry::StateMismatch if nodes of structures have other ids now
void require_same_structures(const geometry::Surface& before,
                             const std::vector<std::int32_t>& places);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/scene_change.hpp"

namespace plekton::dynamics {

/// @throws std::invalid_argument listing every problem
void require_places(const Scene& before, const Scene& now, const SceneChange& change);

}  // namespace plekton::dynamics

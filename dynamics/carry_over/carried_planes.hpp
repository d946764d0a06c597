// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/carry_over/scene_change.hpp"
#include "dynamics/model/scene.hpp"

#include <vector>

namespace plekton::dynamics {

/// Puts planes where the scene has them if they were moved there, and gives the others what their
/// driver does not set of their pace.
/// @param made  of the scene as it was made; its own planes are as they moved on
void settle_planes(const Scene& before, const SceneChange& change,
                   const std::vector<contact::Plane>& made, Scene& now);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <iosfwd>

namespace plekton::dynamics {

/// Writes a line for everything that is wrong with the rigid bodies of a scene: nodes that do not
/// exist, follow two bodies or are a reference node; no mass or inertia where the body may move; a
/// bond or a sheet facet within a body, which could do nothing.
void list_rigid_problems(const Scene& scene, std::ostream& problems);

}  // namespace plekton::dynamics

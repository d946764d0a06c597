// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

namespace plekton::dynamics {

struct Scene;

/// Writes a line for everything that is wrong with the loads of a scene: nodes or planes that do
/// not exist or are named twice, motions that are prescribed twice or held already, numbers that
/// are not finite, negative stiffness.
/// @param scene  whose arrays have the lengths they should have
void list_load_problems(const Scene& scene, std::ostream& problems);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

namespace plekton::dynamics {

struct Scene;

/// Writes a line for everything that is wrong with the ties and cables of a scene: nodes, cables or
/// segments that do not exist, weights that are none, numbers that are negative or not finite, what
/// does not go together.
void list_tie_problems(const Scene& scene, std::ostream& problems);

}  // namespace plekton::dynamics

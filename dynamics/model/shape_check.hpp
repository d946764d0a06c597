// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <iosfwd>

namespace plekton::dynamics {

/// Writes a line for every shape that cannot take part in contacts: a facet without area, a
/// cylinder without length (both by exact signs), a sphere on a node that another sphere, a
/// cylinder or a facet holds too, and so would push on itself for ever. Elements that name nodes
/// which do not exist, or one node twice, or whose nodes are not finite are passed over: these are
/// other problems.
void list_shape_problems(const Scene& scene, std::ostream& problems);

}  // namespace plekton::dynamics

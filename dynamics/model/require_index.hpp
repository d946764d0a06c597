// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstddef>
#include <string_view>

/// Ids and indices that a caller hands to a simulation.
namespace plekton::dynamics {

/// @param call   of the simulation, for the message
/// @param what   as in "bond"
/// @param count  how many of these there are
/// @throws std::out_of_range with all of them, unless the index is below the count
void require_index(std::string_view call, std::string_view what, std::size_t index,
                   std::size_t count);

/// Likewise; a negative id is none either.
void require_node(std::string_view call, geometry::NodeId node, std::size_t count);

}  // namespace plekton::dynamics

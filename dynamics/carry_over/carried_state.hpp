// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "geometry/base/state_tree.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace plekton::dynamics {

/// Rows of a group of arrays, and where they are in the other scene.
struct KeptRows {
  std::string_view group;
  const std::vector<std::int32_t>& places;
};

/// The state of a scene with what was before in another: rows of groups by their places, all else
/// as it was there.
geometry::StateTree carried_state(const geometry::StateTree& before, geometry::StateTree now,
                                  std::span<const KeptRows> groups);

/// Where the rigid bodies of a scene are among those of another.
/// @param now    of the other
/// @param nodes  places of nodes
std::vector<std::int32_t> body_places(const Scene& before, const RigidNodes& now,
                                      const std::vector<std::int32_t>& nodes);

}  // namespace plekton::dynamics

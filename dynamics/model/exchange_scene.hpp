// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

/// What of a scene changes as it moves, written to a state or read from one.
namespace plekton::dynamics {

/// Whether ids are of nodes that there are.
inline bool are_nodes(std::span<const NodeId> nodes, std::size_t count) noexcept {
  return std::ranges::all_of(nodes, [count](NodeId node) {
    const auto i = static_cast<std::int64_t>(node);
    return i >= 0 && i < static_cast<std::int64_t>(count);
  });
}

/// Places, velocities and the last forces. @throws geometry::StateMismatch for another number
void exchange_nodes(const geometry::StateArchive& archive, NodeState& state, NodeForces& forces);

/// Places and velocities. @throws geometry::StateMismatch for another number
void exchange_planes(const geometry::StateArchive& archive, std::vector<contact::Plane>& planes);

/// What is left of the elements, with their materials.
/// @returns whether they are others than before
/// @throws geometry::StateMismatch for nodes or materials that are none
bool exchange_elements(const geometry::StateArchive& archive, Scene& scene);

}  // namespace plekton::dynamics

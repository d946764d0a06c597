// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"

#include <cstdint>

namespace plekton::dynamics {

/// A scene that has moved for some steps.
struct MovedScene {
  const NodeState& state;
  const NodeProperties& properties;
  const NodeForces& forces;
  const Vec3& gravity;                   ///< m/s², the largest
  const NodalStiffness::Total& springs;  ///< of all nodes
  double drift;                          ///< s, of the last step
  std::int64_t steps;
};

/// What rounding may add up to in the ledger (J). A place is rounded by eps |x| and a turn by eps in
/// each step, which is worth 1/2 k (eps |x|)² in a spring; these add up like the variances of a
/// random walk. The sum over nodes that gives the energy of gravity is rounded by n eps of its
/// absolute terms, and their change in each step by eps. Work in a step is a sum of terms of either
/// sign, as that of pressure on a shell that is moved, each rounded by eps; those of the last step
/// stand for all. And springs that places rounded by eps |x| strain push with k eps |x|, either way,
/// against what is moved.
double rounding_energy(const MovedScene& scene);

}  // namespace plekton::dynamics

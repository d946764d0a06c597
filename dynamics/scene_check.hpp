// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::dynamics {

struct Scene;

/// Whether a simulation can start from a scene; each asks this first.
/// @throws std::invalid_argument listing every problem: arrays of different lengths (and nothing
///         else then), ids out of range, a node without mass that is not held, a value that is not
///         finite, a structure of several materials, a facet without area, a cylinder without
///         length, a sphere on a node of another element, rigid bodies that share nodes or have
///         bonds of their own, ties that hold nothing, loads that cannot be applied.
void check(const Scene& scene);

}  // namespace plekton::dynamics

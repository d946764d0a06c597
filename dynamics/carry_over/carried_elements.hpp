// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

namespace plekton::dynamics {

/// Whether the same of two scenes is there, of the nodes of structures, which come first in both.
bool are_same_there(const Scene& a, const Scene& b);

/// Takes over which elements are left of those that are there.
/// @param now  as it is made, without what is absent; its elements, with their materials, become
///             what is left of them
/// @returns whether any are others than they were made
bool take_elements(const Scene& before, Scene& now);

}  // namespace plekton::dynamics

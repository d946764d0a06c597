// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <cstdint>

namespace plekton::dynamics {

/// A hash of what a scene is made of (geometry/base/bit_hash.hpp): nodes, elements and what they
/// are made of, bonds, sheets, planes. Where they are, how they move and what acts on them is not
/// part of it: a state of the scene can be read into it with other loads.
std::uint64_t scene_hash(const Scene& scene);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/stress/scene_text.hpp"

#include <cstdint>

namespace plekton::stress {

/// A small random scene: up to five bodies one above the other that come together within
/// milliseconds, of every shape, mode, law, load, strength and output that a scenario can name.
///
/// Some are refused, as a bed that does not fit its box is: then all who read them have to agree.
/// About a third are free: nothing from outside but even gravity acts on them, so that momentum is
/// known.
/// @param number  of the scene within the seed; the same two numbers give the same scene
SceneText random_scene(std::uint64_t seed, std::uint64_t number);

}  // namespace plekton::stress

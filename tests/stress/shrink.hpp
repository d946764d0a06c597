// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/stress/scene_text.hpp"

#include <chrono>
#include <functional>

namespace plekton::stress {

/// Makes a scene that fails as small as it can be: leaves out tables, then keys, and halves
/// numbers of parts and the duration, as long as it still fails, until nothing more can go.
/// @param fails    whether a scene still fails in the same way
/// @param longest  after which it stays as small as it is
SceneText shrunk(SceneText scene, const std::function<bool(const SceneText&)>& fails,
                 std::chrono::seconds longest = std::chrono::seconds(120));

}  // namespace plekton::stress

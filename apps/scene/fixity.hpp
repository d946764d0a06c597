// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/stage_settings.hpp"
#include "apps/scene/build_scene.hpp"

#include <vector>

namespace plekton::apps {

/// Frees and fixes at the start of a stage what it says.
/// @param there  with all bodies where they are
/// @param held   by node
/// @throws InputError where there is no node
void fix_and_free(const StageSettings& stage, const BuiltScene& there,
                  std::vector<dynamics::Held>& held);

}  // namespace plekton::apps

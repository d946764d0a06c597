// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/stage_settings.hpp"
#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// @param built  with all bodies where they are
/// @throws InputError where a strain is asked for of two rigid bodies whose centres are one point: it
///         has no length to be measured against
void require_apart(const StageEnd& end, const BuiltScene& built);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

#include <span>

namespace plekton::apps {

/// What a scene without stages would begin with, as that of the first stage.
StageBodies first_stage(const BuiltScene& built);

/// Builds the scene of a stage: membranes as they were made, for what they resist depends on it;
/// grains where they are. Loads are told how things stood where they began.
/// @param bodies     of the stage
/// @param positions  m, of its nodes now
/// @throws InputError as build_scene()
BuiltScene build_stage(const Scenario& stage, const StageBodies& bodies,
                       std::span<const Vec3> positions, const HearSetUp& hear = {});

/// The same of a stage that begins now: places the grains that come with it clear of all that is
/// there, fixes and frees, and notes how things stand.
/// @param stage      planes are where they are now
/// @param bodies     of the stage before, without what is taken out; becomes that of this one
/// @param positions  m, of nodes that were there before; of the new ones too when it is done
/// @param time       s, now
BuiltScene begin_stage(const Scenario& stage, StageBodies& bodies, std::vector<Vec3>& positions,
                       double time, const HearSetUp& hear = {});

/// The same before anything is run, to see whether it can be: nobody knows yet where the grains of
/// earlier stages will be, so that they are in nobody's way, and nothing is looked for in boxes
/// among them.
BuiltScene try_stage(const Scenario& stage, StageBodies& bodies, std::vector<Vec3>& positions,
                     const HearSetUp& hear = {});
/// Whether the stage frees grains in boxes, which try_stage() leaves as they are.
bool frees_grains_at_places(const StageSettings& stage);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// Young's modulus of the stiffest over that of the softest material or membrane above which one of
/// them is taken for a slip of units: MPa for Pa is 1e6, and steel is 1e5 times as stiff as rubber.
inline constexpr double kFarStiffer = 2e5;
/// Tangential over normal stiffness of elastic bodies that touch without slip: 2 (1 - ν) / (2 - ν),
/// which is 4/3 for ν = -1, the least there is (Mindlin, J. Appl. Mech. 16 (1949) 259).
inline constexpr double kLargestStiffnessRatio = 4.0 / 3.0;

/// Stiffnesses that do not go together.
std::vector<std::string> warnings_about_stiffness(const Scenario& scenario,
                                                  const BuiltScene& built);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"

#include <string>

namespace plekton::apps {

/// What limits the critical time step of a scene, and what would lengthen it, in lines: the
/// node, its motion, the stiffest part of what holds it, and advice that
/// follows from the figures. Empty if nothing is stiff and free.
std::string step_advice(const Scenario& scenario, const PreparedRun& prepared);

}  // namespace plekton::apps

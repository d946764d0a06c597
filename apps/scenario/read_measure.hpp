// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scenario/section.hpp"

#include <vector>

namespace plekton::apps {

/// A table [[output.measures]].
/// @param scenario  with its planes
/// @param earlier   tables before it: names must differ
MeasureSettings read_measure(Section section, const Scenario& scenario,
                             const std::vector<MeasureSettings>& earlier);

/// A cylinder from the keys from, to and radius of a table; radius NaN after a problem.
geometry::CylinderRegion read_cylinder(Section section);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// kg/m³, between foam of polystyrene (EN 13163: from 10 on) and osmium (22 590, CRC Handbook): what
/// is beyond is taken for g/cm³ or t/mm³.
inline constexpr double kLightest = 10.0;
inline constexpr double kHeaviest = 25000.0;
/// m/s²: geotechnical centrifuges go up to 500 times the gravity of the earth (R. N. Taylor,
/// Geotechnical Centrifuge Technology, 1995). What is above is taken for mm/s².
inline constexpr double kLargestGravity = 5000.0;

/// Numbers that are right in other units than those of SI alone.
std::vector<std::string> warnings_about_units(const Scenario& scenario);

}  // namespace plekton::apps

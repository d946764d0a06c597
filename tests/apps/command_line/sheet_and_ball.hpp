// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton::apps {

/// The beginning of a scenario: a sheet and a closed ball above it.
inline constexpr std::string_view kSheetAndSphere = R"([simulation]
duration = "2 ms"
[materials.stone]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "10 cm", length = "10 cm", cells = [4, 4] }
thickness = "2 mm"
material = "stone"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
[[membranes]]
name = "ball"
shape = { kind = "sphere", radius = "3 cm", subdivisions = 1 }
translate = [0, 0, "6 cm"]
thickness = "2 mm"
material = "stone"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
)";

/// A plane above both.
inline constexpr std::string_view kLid = R"([[planes]]
name = "lid"
point = [0, 0, "20 cm"]
normal = [0, 0, -1]
material = "stone"
)";

}  // namespace plekton::apps

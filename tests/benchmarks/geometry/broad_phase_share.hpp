// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace plekton::benchmarks {

/// Share of the time of a run that goes into making the lists of candidates anew: a dense packing
/// of spheres that move at random, the skin chosen by the program. A step that makes the lists
/// costs what it takes beyond the median of the others.
/// @param speed  m/s, of each sphere along each axis at most
nlohmann::ordered_json broad_phase_share(int spheres, double speed);

}  // namespace plekton::benchmarks

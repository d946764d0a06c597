// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace plekton::benchmarks {

/// Nearest points of the pairs of cores, ns each (the least of interleaved runs), on generic
/// inputs and on those whose regions no double decides; of a point and a triangle also in plain
/// double, and the ratio.
std::vector<nlohmann::ordered_json> kernel_times();

}  // namespace plekton::benchmarks

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace plekton::benchmarks {

/// Nearest points of a point and a triangle, certified and in plain double: ns each (the least of
/// interleaved runs) and their ratio, on generic inputs and on those whose regions no double
/// decides.
std::vector<nlohmann::ordered_json> certified_ratios();

}  // namespace plekton::benchmarks

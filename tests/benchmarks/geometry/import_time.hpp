// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace plekton::benchmarks {

/// Seconds that the import of a binary STL file of a torus takes, with welding its points,
/// orienting, all checks and the report.
/// @param facets  about as many
nlohmann::ordered_json import_time(int facets);

}  // namespace plekton::benchmarks

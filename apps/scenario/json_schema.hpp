// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace plekton::apps {

/// JSON Schema (draft 2020-12) of a scenario, from the keys that the reader asks for: editors
/// complete and check by it. Every scenario that the reader takes is valid by it; what keys have to
/// do with each other only the reader knows.
nlohmann::ordered_json scenario_schema();

}  // namespace plekton::apps

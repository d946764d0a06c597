// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// What the stages of a scenario have in common, from all of them: names for their columns.
NamesOfStages names_in(std::span<const Scenario> stages);

/// Complains about what stages cannot change: contact laws of materials that there were.
void check_stages(const std::vector<Scenario>& stages, Problems& problems);

/// Stage of a name. @throws InputError with the names that there are
const Scenario& stage_called(const Scenario& scenario, const std::string& name);

/// As the columns of planes are called, their names or as in "planes[0]": of a stage those of all
/// stages.
std::vector<std::string> plane_names(const Scenario& scenario);
/// The places of the planes of a scenario among these.
std::vector<std::size_t> plane_numbers(const Scenario& scenario);

}  // namespace plekton::apps

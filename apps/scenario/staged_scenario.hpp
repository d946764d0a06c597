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

/// Name of the first stage after one in which a body is there that was not; empty if there is none.
/// @param bodies  table of membranes, grains or rigid bodies
/// @param after   number of a stage
template <class Body>
std::string stage_that_brings(const Scenario& scenario, std::vector<Body> Scenario::*bodies,
                              std::size_t i, std::size_t after) {
  for (std::size_t k = after + 1; k < scenario.stages.size(); ++k) {
    const std::vector<Body>& there = scenario.stages[k].*bodies;
    if (i < there.size() && !there[i].is_absent) return scenario.stages[k].stage->name;
  }
  return "";
}

/// As the columns of planes are called, their names or as in "planes[0]": of a stage those of all
/// stages.
std::vector<std::string> plane_names(const Scenario& scenario);
/// The places of the planes of a scenario among these.
std::vector<std::size_t> plane_numbers(const Scenario& scenario);

}  // namespace plekton::apps

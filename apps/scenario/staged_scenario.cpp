// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/staged_scenario.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

/// What a history of the pair is made for.
const contact::AnyLaw::Functions* law_of(const Scenario& stage, std::size_t first,
                                         std::size_t second) {
  for (const PairSettings& pair : stage.contacts) {
    if (std::minmax(pair.first, pair.second) == std::minmax(first, second))
      return contact::properties_of(pair.contact).law;
  }
  return contact::properties_of({}).law;
}

void check_laws(const Scenario& before, const Scenario& now, Problems& problems) {
  for (const PairSettings& pair : now.contacts) {
    if (std::max(pair.first, pair.second) >= before.materials.size()) continue;
    if (law_of(before, pair.first, pair.second) == law_of(now, pair.first, pair.second)) continue;
    problems.add(
        pair.place,
        fmt::format("{}.contacts: {} with {} had another contact law before, or one that "
                    "did not roll or dash; a stage may change its numbers alone: write the "
                    "table outside of the stages, with numbers that do nothing at first, such as "
                    "rolling_limit = 0",
                    now.stage->path, now.materials[pair.first].name,
                    now.materials[pair.second].name));
  }
}

template <class Thing>
void add_new(std::vector<Thing>& all, const Thing& thing) {
  if (std::find(all.begin(), all.end(), thing) == all.end()) all.push_back(thing);
}

/// The same load may have a volume in one stage and none in another.
void add_pressure(std::vector<PressureColumn>& all, const PressureColumn& pressure) {
  const auto found = std::ranges::find(all, pressure.load, &PressureColumn::load);
  if (found == all.end())
    all.push_back(pressure);
  else
    found->has_volume = found->has_volume || pressure.has_volume;
}

}  // namespace

std::vector<std::string> plane_names(const Scenario& scenario) {
  return scenario.stage ? scenario.names_of_stages.planes : names_in({&scenario, 1}).planes;
}

std::vector<std::size_t> plane_numbers(const Scenario& scenario) {
  const std::vector<std::string> all = plane_names(scenario);
  std::vector<std::size_t> numbers;
  for (const PlaneSettings& plane : scenario.planes) {
    const auto found = std::find(all.begin(), all.end(), plane.label());
    numbers.push_back(static_cast<std::size_t>(found - all.begin()));
  }
  return numbers;
}

NamesOfStages names_in(std::span<const Scenario> stages) {
  NamesOfStages names;
  for (const Scenario& stage : stages) {
    for (const PlaneSettings& plane : stage.planes) add_new(names.planes, plane.label());
    for (const LoadSettings& load : stage.loads) {
      if (const auto* const pressure = std::get_if<PressureSettings>(&load.load))
        add_pressure(names.pressures, {load.name, pressure->load.gas.has_value() ||
                                                      pressure->load.by_volume.has_value()});
    }
    for (const ReactionSettings& reaction : stage.output.reactions)
      add_new(names.reactions, reaction.name);
  }
  return names;
}

void check_stages(const std::vector<Scenario>& stages, Problems& problems) {
  for (std::size_t k = 1; k < stages.size(); ++k) check_laws(stages[k - 1], stages[k], problems);
}

const Scenario& stage_called(const Scenario& scenario, const std::string& name) {
  if (scenario.stages.empty())
    throw InputError(fmt::format("{}: has no [[stages]]", scenario.file.string()));
  std::vector<std::string_view> names;
  for (const Scenario& stage : scenario.stages) {
    if (stage.stage->name == name) return stage;
    names.push_back(stage.stage->name);
  }
  const std::string closest = closest_word(name, names);
  throw InputError(fmt::format("{}: has no stage \"{}\"; {}", scenario.file.string(), name,
                               closest.empty() ? "its stages are " + listed(names)
                                               : fmt::format("did you mean \"{}\"?", closest)));
}

}  // namespace plekton::apps

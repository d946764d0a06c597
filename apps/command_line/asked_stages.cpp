// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/asked_stages.hpp"

#include "apps/command_line/summary.hpp"
#include "apps/run/enclosed_bodies.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "apps/scene/build_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace plekton::apps {
namespace {

/// The first stage to be run, and from where it goes on.
struct Begin {
  PreparedRun prepared;
  geometry::StateTree state;
  std::optional<Resumption> from = std::nullopt;
};

/// The stage after one that has ended.
const Scenario& stage_after(const Scenario& scenario, const Scenario& ended) {
  if (!ended.stage->is_last) return scenario.stages[ended.stage->number + 1];
  throw InputError(
      fmt::format("{}: is the last one, and has ended; there is nothing to go on "
                  "with",
                  ended.stage->path));
}

std::unique_ptr<Begin> begin_of_next(const Scenario& stage, PreparedRun& there,
                                     const geometry::StateTree& state, bool same_folder,
                                     const HearSetUp& hear) {
  StageBegin next = next_stage(stage, there, state, hear);
  auto begin = std::make_unique<Begin>(Begin{std::move(next.prepared), std::move(next.run)});
  const double time = begin->prepared.simulation->time();
  begin->from.emplace(Resumption{begin->state, same_folder,
                                 same_folder ? std::nullopt : std::optional(time), true});
  return begin;
}

std::unique_ptr<Begin> begin_of(const Scenario& scenario, const StagesAsked& asked,
                                const HearSetUp& hear) {
  if (asked.resume != nullptr) {
    const StageOfState of = stage_of(*asked.resume);
    const Scenario& stage = scenario.stages.at(of.bodies.stage);
    auto begin = std::make_unique<Begin>(Begin{prepare_stage(stage, *asked.resume, hear), {}});
    if (!of.has_ended) {
      begin->from.emplace(
          Resumption{*asked.resume, asked.same_folder, asked.written_from, false, asked.by_clock});
      return begin;
    }
    begin->prepared.simulation->restore(*asked.resume);
    begin = begin_of_next(stage_after(scenario, stage), begin->prepared, *asked.resume,
                          asked.same_folder, hear);
    begin->from->from = asked.written_from;  // nothing: what is written goes on
    begin->from->by_clock = asked.by_clock;
    return begin;
  }
  if (asked.from.empty()) return std::make_unique<Begin>(Begin{prepare_run(scenario, hear), {}});
  const Scenario& stage = stage_called(scenario, asked.from[0]);
  const geometry::StateTree state = end_of_stage(asked.from[1], asked.from[0]);
  PreparedRun there = ended_stage(scenario, stage, state, hear);
  Scenario next = stage_after(scenario, stage);
  if (!is_same_but_for_output(scenario, state)) next.stage->origins.changes_nothing = false;
  return begin_of_next(next, there, state, false, hear);
}

std::string limits_of(const StageSettings& stage) {
  const StageEnd& end = stage.end;
  std::vector<std::string> ends;
  if (end.duration) ends.push_back(fmt::format("after {:.6g} s", *end.duration));
  if (end.kinetic_energy)
    ends.push_back(fmt::format("kinetic energy below {:.6g} J", *end.kinetic_energy));
  if (end.unbalanced_force)
    ends.push_back(fmt::format("unbalanced force ratio below {:.6g}", *end.unbalanced_force));
  if (end.servo)
    ends.push_back(
        fmt::format("servo \"{}\" within {:.3g} %", end.servo->load, 100.0 * end.servo->tolerance));
  if (end.displacement)
    ends.push_back(fmt::format("displacement of {:.6g} m", end.displacement->distance));
  if (end.force)
    ends.push_back(fmt::format("force of \"{}\" along {} {} {:.6g} N", end.force->reaction,
                               "xyz"[end.force->axis], end.force->is_above ? "above" : "below",
                               end.force->force));
  if (end.strain) ends.push_back(fmt::format("strain of {:.6g}", end.strain->strain));
  std::string text = fmt::format("ends: {}", fmt::join(ends, ", or "));
  if (stage.max_duration) text += fmt::format("; fails after {:.6g} s", *stage.max_duration);
  return text;
}

/// The step is judged for good where the stage begins, with the contacts that there are then.
/// @param simulation  of the stage, its bodies where they are made
void look_at_step(const Scenario& stage, const dynamics::Simulation& simulation,
                  std::vector<std::string>& warnings) {
  if (!stage.simulation.time_step) return;
  if (*stage.simulation.time_step > stage.simulation.duration)
    throw InputError(
        fmt::format("{}: simulation.time_step of {:.6g} s is longer than the stage, which ends "
                    "after {:.6g} s at the latest; choose a shorter one, or \"auto\"",
                    stage.stage->path, *stage.simulation.time_step, stage.simulation.duration));
  const double limit = dynamics::kLargestStep * simulation.critical_step().dt;
  if (*stage.simulation.time_step < limit) return;
  warnings.push_back(fmt::format(
      "{}: simulation.time_step of {:.6g} s is not below {:.6g} s, {} of the critical time step of "
      "its bodies where they are made; if it still is not when the stage begins, the run ends "
      "there",
      stage.stage->path, *stage.simulation.time_step, limit, dynamics::kLargestStep));
}

}  // namespace

RunReport run_stages_asked(const Scenario& scenario, const StagesAsked& asked,
                           const RunSettings& settings, const HearSetUp& hear,
                           std::ostream* aloud) {
  StagesToRun stages;
  stages.last = asked.until.empty() ? scenario.stages.size() - 1
                                    : stage_called(scenario, asked.until).stage->number;
  const std::unique_ptr<Begin> begin = begin_of(scenario, asked, hear);
  if (begin->prepared.bodies.stage > stages.last)
    throw InputError(
        fmt::format("--until {}: that stage has ended where this run begins", asked.until));
  stages.begins = [&](const Scenario& stage, const PreparedRun& prepared) {
    if (hear) hear("", 0.0);
    if (asked.begins) asked.begins(*prepared.simulation);
    if (aloud != nullptr)
      *aloud << fmt::format("stage {} ({} of {}), from {:.6g} s\n", stage.stage->name,
                            stage.stage->number + 1, scenario.stages.size(),
                            prepared.simulation->time())
             << summary_of(scenario, prepared) << std::flush;
  };
  if (aloud != nullptr) {
    stages.ends = [&](const Scenario& stage, const RunReport& report) {
      *aloud << fmt::format("stage {} has ended by {} at {:.6g} s, step {}\n", stage.stage->name,
                            report.ended_by, report.simulated_time, report.steps)
             << std::flush;
    };
  }
  stages.hear = hear;
  RunSettings from_there = settings;
  if (begin->from) from_there.resume = &*begin->from;
  return run_stages(scenario, std::move(begin->prepared), from_there, stages);
}

std::string text_of(const std::vector<StagesSeen::Stage>& stages) {
  std::string text;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StagesSeen::Stage& stage = stages[i];
    text +=
        fmt::format("stage {} ({} of {}): {}; {} grains, {} planes, {} loads\n", stage.name, i + 1,
                    stages.size(), stage.limits, stage.grains, stage.planes, stage.loads);
  }
  return text;
}

StagesSeen look_at_stages(const Scenario& scenario, const HearSetUp& hear) {
  StagesSeen seen;
  const auto tell = [&](const Scenario& stage, std::size_t grains) {
    seen.stages.push_back({stage.stage->name, limits_of(*stage.stage), grains, stage.planes.size(),
                           stage.loads.size()});
  };
  const Scenario& first = scenario.stages.front();
  const BuiltScene built = build_scene(first, hear);
  tell(first, built.scene.elements.spheres.size());
  std::vector<std::string> told = built.warnings;
  for (std::string& warning : warnings_about_solids(first, built, built.scene))
    told.push_back(std::move(warning));
  StagesAhead ahead(first, built);
  bool knows_what_is_free = !frees_grains_at_places(*first.stage);
  for (const Scenario& stage : std::span(scenario.stages).subspan(1)) {
    knows_what_is_free = knows_what_is_free && !frees_grains_at_places(*stage.stage);
    const StageAhead next = ahead.next(stage, hear);
    tell(stage, next.simulation->elements().spheres.size());
    for (const std::string& warning : next.warnings) {
      if (std::find(told.begin(), told.end(), warning) != told.end()) continue;
      told.push_back(warning);
      seen.warnings.push_back(warning);
    }
    if (knows_what_is_free) require_something_free(stage, *next.simulation);
    look_at_step(stage, *next.simulation, seen.warnings);
  }
  return seen;
}

}  // namespace plekton::apps

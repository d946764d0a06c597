// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_stages.hpp"

#include "apps/run/checkpoints.hpp"
#include "apps/run/run_state.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

Scenario scenario_in(const geometry::StateTree& state) {
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  return parse_scenario(text.text, text.file, text.overrides);
}

template <class Table>
std::vector<std::string> names_of_tables(const std::vector<Table>& tables) {
  std::vector<std::string> names;
  for (const Table& table : tables) names.push_back(table.name);
  return names;
}

bool are_same_nodes(const NodeSetSettings& a, const NodeSetSettings& b) {
  return a.rigid_body == b.rigid_body && a.of_grains == b.of_grains && a.body == b.body &&
         a.which == b.which && a.box.lower == b.box.lower && a.box.upper == b.box.upper;
}

/// Whether the ties of both are between the same nodes.
bool tie_the_same(const TieSettings& a, const TieSettings& b) {
  return a.kind == b.kind && a.point == b.point && a.within == b.within &&
         are_same_nodes(a.from, b.from) && are_same_nodes(a.to, b.to);
}

/// What goes on by its number has to be the same by its name.
void require_same_tables(const Scenario& then, const Scenario& now) {
  const auto require = [&](const char* what, const auto& before, const auto& after) {
    if (names_of_tables(before) == names_of_tables(after)) return;
    throw InputError(fmt::format(
        "{}: has other {} than the run that it is to go on from: there they are \"{}\", here "
        "\"{}\"; up to that stage they have to be the same",
        now.stage->path, what, fmt::join(names_of_tables(before), "\", \""),
        fmt::join(names_of_tables(after), "\", \"")));
  };
  require("grains", then.grains, now.grains);
  require("membranes", then.membranes, now.membranes);
  require("rigid bodies", then.rigid_bodies, now.rigid_bodies);
  require("planes", then.planes, now.planes);
  require("ties", then.ties, now.ties);
  for (std::size_t i = 0; i < now.ties.size(); ++i) {
    if (tie_the_same(then.ties[i], now.ties[i])) continue;
    throw InputError(fmt::format(
        "{}: {} ties other nodes than in the run that it is to go on from; its from, to and within "
        "have to be the same",
        now.stage->path, now.ties[i].path));
  }
  if (then.stage->number != now.stage->number)
    throw InputError(
        fmt::format("{}: is stage {} here and was stage {} in the run that it is to go "
                    "on from; the stages up to there have to be the same",
                    now.stage->path, now.stage->number + 1, then.stage->number + 1));
}

/// @param fail  what is done before an error is thrown on: the stages before are told of
template <class Fail>
StageBegin begin_next(const Scenario& stage, PreparedRun& before, const geometry::StateTree& end,
                      const HearSetUp& hear, Fail&& fail) {
  try {
    return next_stage(stage, before, end, hear);
  } catch (const std::exception& error) {
    fail(error);
    throw;
  }
}

}  // namespace

RunReport run_stages(const Scenario& scenario, PreparedRun first, const RunSettings& settings,
                     const StagesToRun& stages) {
  PreparedRun prepared = std::move(first);
  geometry::StateTree state;
  Resumption from{state, true, std::nullopt, true};
  std::optional<RunReport> before;
  while (true) {
    const Scenario& stage = scenario.stages[prepared.bodies.stage];
    if (stages.begins) stages.begins(stage, prepared);
    RunSettings of_stage = settings;
    geometry::StateTree end;
    of_stage.end_of_stage = &end;
    const std::size_t number = stage.stage->number;
    of_stage.has_next_stage = number < stages.last && !stage.stage->is_last;
    if (before) {
      of_stage.resume = &from;
      of_stage.stages_before = &*before;
    }
    before = run(stage, prepared, of_stage);
    const bool has_ended = before->status == RunStatus::finished && !before->ended_by.empty();
    if (!has_ended) return *before;
    if (stages.ends) stages.ends(stage, *before);
    if (!of_stage.has_next_stage) return *before;
    StageBegin next = begin_next(scenario.stages[number + 1], prepared, end, stages.hear,
                                 [&](const std::exception& error) {
                                   before->status = RunStatus::failed;
                                   before->message = error.what();
                                   write_run_report(settings.out, *before);
                                 });
    prepared = std::move(next.prepared);
    state = std::move(next.run);
  }
}

geometry::StateTree end_of_stage(const fs::path& folder, const std::string& stage) {
  std::vector<fs::path> files = checkpoints_of(folder);
  std::vector<std::string> ended;
  for (; !files.empty(); files.pop_back()) {
    geometry::StateTree state = dynamics::read_checkpoint(files.back());
    const StageOfState of = stage_of(state);
    if (!of.has_ended) continue;
    const std::string name = scenario_in(state).stages.at(of.bodies.stage).stage->name;
    if (name == stage) return state;
    ended.push_back(name);
  }
  std::reverse(ended.begin(), ended.end());
  throw InputError(fmt::format(
      "{}: has no end of a stage \"{}\"; {}", folder.string(), stage,
      ended.empty() ? "it has none of any: plekton run of a scenario with [[stages]] writes them"
                    : fmt::format("it has those of \"{}\"", fmt::join(ended, "\", \""))));
}

PreparedRun ended_stage(const Scenario& scenario, const Scenario& stage,
                        const geometry::StateTree& state, const HearSetUp& hear) {
  const Scenario all = scenario_in(state);
  Scenario then = all.stages.at(stage_of(state).bodies.stage);
  require_same_tables(then, stage);
  then.simulation.threads = scenario.simulation.threads;
  PreparedRun prepared = prepare_stage(then, state, hear);
  prepared.simulation->restore(state);
  return prepared;
}

}  // namespace plekton::apps

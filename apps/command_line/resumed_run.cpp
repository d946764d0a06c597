// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/resumed_run.hpp"

#include "apps/run/build_info.hpp"
#include "apps/run/run_state.hpp"
#include "apps/run/stage_change.hpp"
#include "apps/scenario/overrides.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/section.hpp"
#include "apps/scenario/toml_file.hpp"
#include "apps/scenario/toml_text.hpp"
#include "apps/scenario/units.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

/// What may be other than it was: where it ends, how many threads there are, what is written.
bool may_change(std::string_view key) {
  constexpr std::array<std::string_view, 4> kFree = {"simulation.duration", "simulation.threads",
                                                     "output", "stop"};
  return std::ranges::find(kFree, key) != kFree.end();
}

/// The first key that may not change and is in one table alone, or another in both; empty: none.
/// @param path  of the tables, "" or with a dot behind
std::string changed_key(const Table& before, const Table& now, const std::string& path) {
  const auto is_same = [](const Value& a, const Value& b) {
    return to_toml({{{"value", {}, a}}}) == to_toml({{{"value", {}, b}}});
  };
  for (const auto& [of, other] : {std::pair(&before, &now), std::pair(&now, &before)}) {
    for (const Entry& entry : of->entries) {
      const std::string key = path + entry.key;
      if (may_change(key)) continue;
      const Entry* const there = other->find(entry.key);
      const Table none;
      const auto* const table = std::get_if<Table>(&entry.value.data);
      const auto* const of_other = there ? std::get_if<Table>(&there->value.data) : &none;
      if (table != nullptr && of_other != nullptr) {
        const std::string changed = changed_key(*table, *of_other, key + ".");
        if (!changed.empty()) return changed;
      } else if (there == nullptr || !is_same(entry.value, there->value)) {
        return key;
      }
    }
  }
  return "";
}

void require_same_run(const ScenarioText& then, std::span<const std::string> overrides) {
  const auto table_with = [&](std::span<const std::string> more) {
    Table table = parse_toml(then.text, then.file);
    apply_overrides(table, then.overrides);
    apply_overrides(table, more);
    return table;
  };
  const Table before = table_with({});
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const std::string changed = changed_key(before, table_with(overrides.first(i + 1)), "");
    if (changed.empty()) continue;
    throw InputError(
        fmt::format("--set {}: would make it another run, as {} is another; a run that goes on may "
                    "change simulation.duration, simulation.threads, output and stop alone",
                    overrides[i], changed));
  }
}

/// Of the last stage. @param state  of a scenario with stages
bool has_ended(const geometry::StateTree& state, const Scenario& scenario) {
  const StageOfState of = stage_of(state);
  return of.has_ended && of.bodies.stage + 1 == scenario.stages.size();
}

/// s, infinite where nobody knows: of stages that have not all ended. A run without stages may have
/// been longer than the checkpoint that it goes on from knows.
double end_of(const Scenario& scenario, const ResumeArguments& arguments) {
  const geometry::StateTree last = last_checkpoint(arguments.folder).state;
  if (scenario.stages.empty()) return std::max(scenario.simulation.duration, time_of(last));
  return has_ended(last, scenario) ? time_of(last) : std::numeric_limits<double>::infinity();
}

/// Times of a part of a run are times of the run.
void require_within(const Scenario& scenario, const std::optional<double>& begin,
                    const std::optional<double>& to, const ResumeArguments& arguments) {
  const double end = end_of(scenario, arguments);
  const auto require = [&](bool holds, const char* option, const std::string& got,
                           const char* expected) {
    if (holds) return;
    throw InputError(
        fmt::format("{}: got \"{}\"; expected a time {} the end of the run, {:.6g} s{}", option,
                    got, expected, end,
                    scenario.stages.empty() ? "; to go on beyond that give --set "
                                              "simulation.duration=TIME"
                                            : ""));
  };
  constexpr double kRounding = 1e-9;
  if (begin) require(*begin < end, "--from", arguments.from, "before");
  if (to) require(*to <= end * (1.0 + kRounding), "--to", arguments.to, "up to");
}

/// There is nothing to go on with where a run is beyond its end already.
void require_not_beyond(const ResumedRun& run, const std::string& to) {
  const double now = time_of(run.checkpoint.state);
  const double end = run.until.value_or(run.scenario.simulation.duration);
  constexpr double kRounding = 1e-9;
  if (!run.scenario.stages.empty() || end >= now * (1.0 - kRounding)) return;
  throw InputError(
      to.empty()
          ? fmt::format("simulation.duration: got {:.6g} s; the run is at {:.6g} s already", end,
                        now)
          : fmt::format("--to: got \"{}\"; the run is at {:.6g} s already: give --from with a "
                        "time before it",
                        to, now));
}

ResumedRun resumed_at(const ResumeArguments& arguments, const std::optional<double>& begin) {
  return resumed_from(arguments.same_folder ? last_checkpoint_with_files(arguments.folder)
                                            : last_checkpoint(arguments.folder, begin),
                      arguments.overrides);
}

/// Whether nothing is left of what is asked for: the checkpoint is that of its last step.
bool is_over(const ResumedRun& run, const std::optional<double>& to) {
  const double now = time_of(run.checkpoint.state);
  if (to) return now >= *to;  // the run may have been longer than the checkpoint knows
  if (run.scenario.stages.empty()) return now >= run.scenario.simulation.duration;
  return has_ended(run.checkpoint.state, run.scenario);
}

}  // namespace

std::optional<double> time_option(const char* name, const std::string& text) {
  if (text.empty()) return std::nullopt;
  double time = 0.0;
  try {
    time = parse_quantity(text, kTime);
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  if (!kNotNegative.holds(time))
    throw InputError(
        fmt::format("{}: got \"{}\"; expected a time{}", name, text, kNotNegative.text));
  return time;
}

bool is_of_last_checkpoint(const std::filesystem::path& run, const geometry::StateTree& state) {
  return steps_of(state) == steps_of(last_checkpoint(run).state);
}

void refuse_beyond_last(const char* option, const std::string& got, double last) {
  throw InputError(
      fmt::format("{}: got \"{}\"; expected times up to the last checkpoint of the run, "
                  "which is of {:.6g} s",
                  option, got, last));
}

ResumedRun find_resumed_run(const ResumeArguments& arguments) {
  const std::optional<double> begin = time_option("--from", arguments.from);
  const std::optional<double> end = time_option("--to", arguments.to);
  if (begin && end && !(*begin < *end))
    throw InputError(fmt::format("--to: got \"{}\"; expected a time after --from \"{}\"",
                                 arguments.to, arguments.from));
  ResumedRun run = resumed_at(arguments, begin);
  if (begin && is_over(run, end))
    run = resumed_from(checkpoint_before(arguments.folder, steps_of(run.checkpoint.state), begin),
                       arguments.overrides);
  if (begin || end) require_within(run.scenario, begin, end, arguments);
  run.from = begin;
  run.until = end;
  require_not_beyond(run, arguments.to);
  // Steps are those of the whole run; beyond its end there is no other.
  double& duration = run.scenario.simulation.duration;
  if (end) duration = std::max(duration, *end);
  return run;
}

std::vector<std::string> warnings_about(const ResumedRun& run) {
  std::vector<std::string> warnings = run.checkpoint.damaged;
  if (!warnings.empty())
    warnings.push_back(
        fmt::format("goes on from an earlier checkpoint, {}: what came after is "
                    "computed again",
                    run.checkpoint.file.string()));
  const std::string writer = dynamics::writer_of_checkpoint(run.checkpoint.file).revision;
  if (writer != build_info().revision)
    warnings.push_back(
        fmt::format("{}: was written by revision {} of plekton, and this is {}: results may be "
                    "others than those of one of them alone",
                    run.checkpoint.file.string(), writer, build_info().revision));
  return warnings;
}

ResumedRun resumed_from(FoundCheckpoint checkpoint, std::span<const std::string> overrides) {
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(checkpoint.state).group(kRunGroup));
  require_same_run(text, overrides);
  text.overrides.insert(text.overrides.end(), overrides.begin(), overrides.end());
  return {std::move(checkpoint), parse_scenario(text.text, text.file, text.overrides), std::nullopt,
          std::nullopt};
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/resume_command.hpp"

#include "apps/run/run_state.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/section.hpp"
#include "apps/scenario/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

/// What may be other than it was: where it ends, how many threads there are, what is written.
bool may_change(std::string_view replaced) {
  constexpr std::array<std::string_view, 4> kFree = {
      "simulation.duration=", "simulation.threads=", "output.", "stop."};
  return std::any_of(kFree.begin(), kFree.end(),
                     [&](std::string_view free) { return replaced.starts_with(free); });
}

void require_same_run(std::span<const std::string> overrides) {
  for (const std::string& replaced : overrides) {
    if (may_change(replaced)) continue;
    throw InputError(
        fmt::format("--set {}: would make it another run; a run that goes on may change "
                    "simulation.duration, simulation.threads, output and stop alone",
                    replaced));
  }
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

ResumedRun find_resumed_run(const std::filesystem::path& folder,
                            std::span<const std::string> overrides, const std::string& from,
                            const std::string& to) {
  const std::optional<double> begin = time_option("--from", from);
  const std::optional<double> end = time_option("--to", to);
  if (begin && end && !(*begin < *end))
    throw InputError(
        fmt::format("--to: got \"{}\"; expected a time after --from \"{}\"", to, from));
  ResumedRun run = resumed_from(last_checkpoint(folder, begin), overrides);
  run.from = begin;
  if (end) run.scenario.simulation.duration = *end;
  return run;
}

ResumedRun resumed_from(FoundCheckpoint checkpoint, std::span<const std::string> overrides) {
  require_same_run(overrides);
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(checkpoint.state).group(kRunGroup));
  text.overrides.insert(text.overrides.end(), overrides.begin(), overrides.end());
  return {std::move(checkpoint), parse_scenario(text.text, text.file, text.overrides),
          std::nullopt};
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/verify_command.hpp"

#include "apps/command_line/asked_stages.hpp"
#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/interrupt.hpp"
#include "apps/command_line/resumed_run.hpp"
#include "apps/command_line/scenario_options.hpp"
#include "apps/command_line/warnings.hpp"
#include "apps/programs/scratch_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_state.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

using geometry::StateTree;

/// Part of a run that is computed again.
struct VerifyArguments {
  std::filesystem::path folder;       ///< of the run
  std::vector<std::string> interval;  ///< begin and end, as in "0.1 s"; empty: up to the end
  ScenarioOptions scenario;           ///< the threads of it alone
};

/// What of a state is that of the run, and not of the files it is written to.
bool is_compared(const std::string& name) {
  const std::string run = std::string(kRunGroup) + "/";
  return !name.starts_with(run) || name.starts_with(run + "states/") ||
         name.starts_with(run + "lost_grains/");
}

std::uint64_t hash_of(const geometry::StateArray& array) {
  StateTree tree;
  tree.arrays["it"] = array;
  return tree.hash();
}

/// Names of the arrays that differ.
std::vector<std::string> differences(const StateTree& a, const StateTree& b, std::size_t& count) {
  std::vector<std::string> names;
  count = 0;
  for (const auto& [name, array] : a.arrays) {
    if (!is_compared(name)) continue;
    ++count;
    const auto other = b.arrays.find(name);
    if (other == b.arrays.end() || hash_of(other->second) != hash_of(array)) names.push_back(name);
  }
  return names;
}

/// What a checkpoint knows of its scenario.
ScenarioText scenario_text(const StateTree& state) {
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  return text;
}

/// A run as it was when a later checkpoint was written: it may have been given a longer duration.
ResumedRun resumed_towards(const StateTree& last, FoundCheckpoint first,
                           std::span<const std::string> overrides) {
  scenario_text(last).exchange(geometry::StateArchive::writer(first.state).group(kRunGroup));
  return resumed_from(std::move(first), overrides);
}

/// The state of a run at that of a later checkpoint, computed from an earlier one.
StateTree computed_again(const ResumedRun& resumed, const StateTree& last) {
  const ScratchFolder scratch("verify");
  std::ostringstream silence;
  const InterruptGuard guard;
  const dynamics::Simulation* simulation = nullptr;
  const bool ends_stage = resumed.scenario.stage && stage_of(last).has_ended;
  const auto is_there = [&] {
    // A stage ends by itself.
    return guard.interrupted() || (!ends_stage && simulation->steps() >= steps_of(last));
  };
  RunSettings settings{scratch.path(),         silence, ProgressStyle::none, is_there,
                       Progress::Clock::now(), true};
  if (resumed.scenario.stage) {
    StagesAsked asked;
    asked.resume = &resumed.checkpoint.state;
    asked.same_folder = false;
    asked.until = resumed.scenario.stages.at(stage_of(last).bodies.stage).stage->name;
    asked.begins = [&](const dynamics::Simulation& of_stage) { simulation = &of_stage; };
    run_stages_asked(resumed.scenario, asked, settings, {}, nullptr);
  } else {
    PreparedRun prepared = prepare_run(resumed.scenario);
    simulation = prepared.simulation.get();
    const Resumption from{resumed.checkpoint.state, false, std::nullopt};
    settings.resume = &from;
    run(resumed.scenario, prepared, settings);
  }
  if (guard.interrupted()) throw InputError("verify: interrupted; nothing was compared");
  return last_checkpoint(scratch.path()).state;
}

/// @param last  checkpoint that is not after the second time
void require_there(const VerifyArguments& arguments, double from, double to,
                   const geometry::StateTree& last) {
  const double there = time_of(last);
  constexpr double kRounding = 1e-9;
  const std::string &begin = arguments.interval[0], &end = arguments.interval[1];
  if (is_of_last_checkpoint(arguments.folder, last) &&
      !(from < there && to <= there * (1.0 + kRounding)))
    refuse_beyond_last("--interval", from < there ? end : begin, there);
  if (!(from < there))
    throw InputError(
        fmt::format("--interval: got \"{}\" \"{}\", between which the run has no checkpoint to "
                    "compare with; expected an interval with one: the one before is of {:.6g} s",
                    begin, end, there));
}

/// Computes a run again from one of its checkpoints to a later one, and compares both states.
/// Nothing in its folder is changed.
/// @param out       told what was compared, and whether every bit is the same
/// @param problems  told of later checkpoints that are damaged
/// @returns whether it is
/// @throws InputError if there are no two checkpoints for that interval
bool verify_run(const VerifyArguments& arguments, std::ostream& out, std::ostream& problems) {
  const std::string begin = arguments.interval.empty() ? "" : arguments.interval[0];
  const std::string end = arguments.interval.empty() ? "" : arguments.interval[1];
  const std::optional<double> from = time_option("--interval", begin);
  const std::optional<double> to = time_option("--interval", end);
  if (from && !(*from < *to))
    throw InputError(fmt::format(
        "--interval: got \"{}\" \"{}\"; expected a second time after the first", begin, end));
  const FoundCheckpoint last = last_checkpoint(arguments.folder, to);
  if (from) require_there(arguments, *from, *to, last.state);
  const FoundCheckpoint first = checkpoint_before(arguments.folder, steps_of(last.state), from);
  print_warnings(warnings_about(last), problems);
  print_warnings(warnings_about(first), problems);
  const bool is_of_one_scenario =
      scenario_text(first.state).overrides == scenario_text(last.state).overrides;
  const ResumedRun resumed = resumed_towards(last.state, first, overrides_of(arguments.scenario));
  const StateTree again = computed_again(resumed, last.state);
  std::size_t count = 0;
  const std::vector<std::string> others = differences(last.state, again, count);
  out << fmt::format("{}: {:.9g} s to {:.9g} s, steps {} to {}: ", arguments.folder.string(),
                     time_of(first.state), time_of(last.state), steps_of(first.state),
                     steps_of(last.state));
  if (others.empty()) {
    out << fmt::format("all {} arrays of the state are the same to the last bit\n", count);
    return true;
  }
  constexpr std::size_t kShown = 8;
  out << fmt::format("{} of {} arrays of the state differ:\n", others.size(), count);
  for (std::size_t i = 0; i < std::min(kShown, others.size()); ++i)
    out << "  " << others[i] << '\n';
  if (others.size() > kShown) out << "  and more\n";
  out << (is_of_one_scenario
              ? "the run was of another version or build of plekton, or its files were changed\n"
              : "between them the run was given a longer duration or other output, for which other "
                "steps are cut short: choose an --interval before or after that\n");
  return false;
}

}  // namespace

ProgramCommand add_verify(CLI::App& app) {
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* verify = app.add_subcommand(
      "verify", "Compute a part of a run again, between two of its checkpoints, and compare bits");
  verify->add_option("run", arguments->folder, "Folder of the run")->required();
  verify
      ->add_option(
          "--interval", arguments->interval,
          "Begin and end, as in \"0.1 s\" \"0.2 s\": from the checkpoint of the step of the "
          "begin, or else the last one before it, to that of the end")
      ->expected(2)
      ->type_name("BEGIN END");
  add_threads_option(*verify, arguments->scenario);
  return {verify, [arguments] {
            const bool is_same = verify_run(*arguments, std::cout, std::cerr);
            flush_output();
            return is_same ? kDone : kFailed;
          }};
}

}  // namespace plekton::apps

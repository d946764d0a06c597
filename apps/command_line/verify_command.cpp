// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/verify_command.hpp"

#include "apps/command_line/interrupt.hpp"
#include "apps/command_line/resume_command.hpp"
#include "apps/programs/scratch_folder.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_state.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace plekton::apps {
namespace {

using geometry::StateTree;

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

/// The state of a run at the step of a later checkpoint, computed from an earlier one.
StateTree computed_again(const ResumedRun& resumed, std::int64_t last_step) {
  const ScratchFolder scratch("verify");
  PreparedRun prepared = prepare_run(resumed.scenario);
  std::ostringstream silence;
  const InterruptGuard guard;
  const Resumption from{resumed.checkpoint.state, false, std::nullopt};
  const auto is_there = [&] {
    return guard.interrupted() || prepared.simulation->steps() >= last_step;
  };
  const RunSettings settings{
      scratch.path(), silence, ProgressStyle::none, is_there, Progress::Clock::now(), true, &from};
  run(resumed.scenario, prepared, settings);
  if (guard.interrupted()) throw InputError("verify: interrupted; nothing was compared");
  return last_checkpoint(scratch.path()).state;
}

}  // namespace

bool verify_run(const VerifyArguments& arguments, std::ostream& out) {
  const std::string begin = arguments.interval.empty() ? "" : arguments.interval[0];
  const std::string end = arguments.interval.empty() ? "" : arguments.interval[1];
  const FoundCheckpoint last = last_checkpoint(arguments.folder, time_option("--interval", end));
  const std::optional<double> from = time_option("--interval", begin);
  const FoundCheckpoint first = checkpoint_before(arguments.folder, steps_of(last.state), from);
  ResumedRun resumed = resumed_from(first, arguments.overrides);
  if (resumed.scenario.stage)
    throw InputError(fmt::format(
        "{}: has stages, which verify does not compute again; run its scenario in "
        "another folder, from the start or with --from, and compare `states` in run.json",
        arguments.folder.string()));
  const StateTree again = computed_again(resumed, steps_of(last.state));
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
  out << "the run was of another version or build of plekton, or its files were changed\n";
  return false;
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/python/session.hpp"

#include "apps/command_line/view_command.hpp"
#include "apps/python/from_python.hpp"
#include "apps/python/interpreter_lock.hpp"
#include "apps/run/body_tables.hpp"
#include "apps/run/frames.hpp"
#include "apps/run/other_file.hpp"
#include "apps/run/plane_places.hpp"
#include "apps/run/run_state.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace plekton::python {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone when it is left.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name) {
    std::string pattern = (fs::temp_directory_path() / "plekton-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw dynamics::OutputError(pattern, "make a folder for the page", errno);
    root_ = pattern;
    path_ = root_ / name;
    fs::create_directory(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path root_;
  fs::path path_;
};

}  // namespace

class Session::Moving {
 public:
  Moving(Session& session, Attendant& attendant) : session_(session) {
    session.require_at_rest();
    attendant.start(*session.prepared_->simulation);
    session.attendant_ = &attendant;
  }
  Moving(const Moving&) = delete;
  Moving& operator=(const Moving&) = delete;
  ~Moving() { session_.attendant_ = nullptr; }

 private:
  Session& session_;
};

Session::Session(apps::Scenario scenario) : scenario_(std::move(scenario)), prepared_(prepare()) {}

Session::Session(apps::ResumedRun resumed, std::optional<fs::path> folder)
    : scenario_(std::move(resumed.scenario)),
      prepared_(prepare()),
      checkpoint_(std::move(resumed.checkpoint)),
      origin_(folder),
      folder_(std::move(folder)) {
  prepared_->simulation->restore(checkpoint_->state);
}

std::shared_ptr<apps::PreparedRun> Session::prepare() const {
  if (scenario_.stage)
    throw apps::InputError(
        "the scenario has [[stages]], which run_stages(), resume_stages() and plekton run run with "
        "results");
  const WithoutLock free;
  auto prepared = std::make_shared<apps::PreparedRun>(
      apps::prepare_run(scenario_, [](const std::string&, double) { check_signals(); }));
  apps::require_possible_start(prepared->start, scenario_);
  return prepared;
}

dynamics::Simulation& Session::simulation() const {
  if (attendant_ != nullptr && !attendant_->is_calling())
    throw std::logic_error(
        "the simulation is running in another thread; ask from a function that run(every=...) "
        "calls, or after the run");
  return *prepared_->simulation;
}

void Session::require_at_rest() const {
  if (attendant_ != nullptr)
    throw std::logic_error(
        "the simulation is running; a function that it calls can read and stop it, not move it");
}

void Session::run(double until, Attendant& attendant) {
  const Moving moving(*this, attendant);
  dynamics::Simulation& simulation = *prepared_->simulation;
  apps::require_possible_duration("until", until - simulation.time(), simulation.time_step());
  const WithoutLock free;
  while (simulation.step_until(until))
    if (attendant.wants_end(simulation)) return;
  simulation.check_energy();
}

void Session::step(std::int64_t count, Attendant& attendant) {
  const Moving moving(*this, attendant);
  dynamics::Simulation& simulation = *prepared_->simulation;
  const WithoutLock free;
  for (std::int64_t i = 0; i < count; ++i) {
    simulation.step();
    if (attendant.wants_end(simulation)) return;
  }
}

apps::RunReport Session::run_into(const fs::path& folder, double until, bool overwrite,
                                  Attendant& attendant) {
  require_at_rest();
  const std::int64_t steps = prepared_->simulation->steps();
  const bool goes_on = checkpoint_.has_value();
  if (goes_on && !origin_)
    throw std::logic_error(
        "the checkpoint that this went on from is of no run with results; resume the folder of a "
        "run, or run without out");
  if (steps != (goes_on ? apps::steps_of(checkpoint_->state) : 0))
    throw std::logic_error(fmt::format(
        "results begin with the run, and this simulation has made steps up to {} already; load or "
        "resume it again for run(out=...)",
        steps));
  apps::require_possible_duration("until", until, prepared_->simulation->time_step());
  const Moving moving(*this, attendant);
  const std::shared_ptr<apps::PreparedRun> prepared = prepared_;
  const std::optional<fs::path> earlier = folder_;
  // A state is restored by the run itself, into a scene that has none.
  if (goes_on) prepared_ = prepare();
  std::error_code ignored;
  std::optional<apps::Resumption> resumption;
  if (goes_on)
    resumption.emplace(
        apps::Resumption{checkpoint_->state, fs::equivalent(folder, *origin_, ignored), {}});
  apps::Scenario scenario = scenario_;
  scenario.simulation.duration = until;
  std::ostringstream unseen;
  apps::RunSettings settings{folder, unseen, apps::ProgressStyle::none, {}};
  settings.is_interrupted = [&] { return attendant.wants_end(*prepared_->simulation); };
  settings.overwrite = overwrite;
  settings.resume = resumption ? &*resumption : nullptr;
  folder_ = folder;
  try {
    const WithoutLock free;
    return apps::run(scenario, *prepared_, settings);
  } catch (...) {
    if (prepared_->simulation->steps() <= steps) {  // refused: as if never asked
      prepared_ = prepared;
      folder_ = earlier;
    }
    throw;
  }
}

void Session::stop() noexcept {
  if (attendant_ != nullptr) attendant_->stop();
}

void Session::save(const fs::path& file) const {
  apps::refuse_other_file(file, "checkpoint of Plekton", dynamics::is_checkpoint);
  geometry::StateTree state = simulation().snapshot();
  const auto archive = geometry::StateArchive::writer(state).group(apps::kRunGroup);
  apps::text_of(scenario_).exchange(archive);
  dynamics::write_checkpoint(file, state);
}

void Session::restore(const fs::path& file) {
  require_at_rest();
  const geometry::StateTree state = dynamics::read_checkpoint(file);
  auto fresh = prepare();
  fresh->simulation->restore(state);
  require_at_rest();  // another thread may have begun to run while this one prepared
  prepared_ = std::move(fresh);
  checkpoint_.reset();
  origin_.reset();
  folder_.reset();
}

void Session::write_frame(const fs::path& folder) const {
  const apps::BodyTables bodies(scenario_, prepared_->built, simulation());
  apps::Frames frames(folder, apps::settings_for(scenario_.output, simulation()), bodies);
  apps::PlanePlaces planes(folder, scenario_);
  frames.write(simulation());
  planes.add(simulation());
  planes.close();
}

fs::path Session::view(const std::optional<fs::path>& out) const {
  std::ostringstream unseen;
  if (folder_) {
    const fs::path page = out.value_or(*folder_ / apps::kViewPage);
    apps::view_run({*folder_, page, apps::ViewArguments{}.limit, {}}, unseen);
    return page;
  }
  const fs::path page = out.value_or(apps::kViewPage);
  const TemporaryFolder folder(scenario_.file.stem().string());
  write_frame(folder.path());
  apps::view_run({folder.path(), page, apps::ViewArguments{}.limit, {}}, unseen);
  return page;
}

}  // namespace plekton::python

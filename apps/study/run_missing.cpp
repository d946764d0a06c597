// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_missing.hpp"

#include "apps/programs/child_process.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/study/run_log.hpp"
#include "apps/study/run_results.hpp"
#include "geometry/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <thread>

namespace plekton::apps {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<std::string> arguments_of(const StudyRuns& study, const PlannedRun& run,
                                      const MakeSettings& settings) {
  // Absolute, so that no name can be an option.
  std::vector<std::string> arguments = {settings.program.string(), "run",
                                        std::filesystem::absolute(study.study().scenario).string()};
  for (const std::string& replaced : run.overrides)
    arguments.insert(arguments.end(), {"--set", replaced});
  arguments.insert(arguments.end(), {"--threads", std::to_string(settings.threads), "--out",
                                     std::filesystem::absolute(study.folder_of(run)).string(),
                                     "--overwrite", "--quiet"});
  return arguments;
}

/// Runs that go on at the same time, and those that wait for their turn.
class Maker {
 public:
  Maker(StudyRuns& study, std::vector<PlannedRun>& runs, const MakeSettings& settings)
      : study_(study), runs_(runs), settings_(settings) {
    const std::vector<std::size_t> missing = missing_among(study, runs);
    waiting_.assign(missing.begin(), missing.end());
    count_ = missing.size();
    const auto whole = std::find_if(runs.begin(), runs.end(), [&](const PlannedRun& run) {
      return run.problem.empty() && study.is_complete(run);
    });
    if (!waiting_.empty() && whole != runs.end()) look_for_results(*whole);
  }

  /// @returns the result that no run will have; empty: all runs were begun
  const std::string& make() {
    while (!going_.empty() || can_begin()) {
      if (!is_interrupted_ && settings_.is_interrupted()) {
        is_interrupted_ = true;
        for (const auto& job : going_) job->process->interrupt();
      }
      while (can_begin() && going_.size() < static_cast<std::size_t>(settings_.jobs)) start_next();
      look_at_all();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return unknown_;
  }

 private:
  struct Job {
    std::size_t run;
    RunLog output;
    Clock::time_point began = Clock::now();
    std::unique_ptr<ChildProcess> process;

    Job(std::size_t run_, const std::filesystem::path& log_file) : run(run_), output(log_file) {}
  };

  bool can_begin() const { return !is_interrupted_ && unknown_.empty() && !waiting_.empty(); }

  /// Of one run that is whole, and no further than to the first that has all of them.
  void look_for_results(const PlannedRun& run) {
    if (has_results_) return;
    try {
      results_of(study_.folder_of(run), study_.study().results);
      has_results_ = true;
    } catch (const UnknownResult& error) {
      unknown_ = error.what();
    } catch (const NoResult&) {
      // That of another run may be there.
    }
  }

  void start_next() {
    const std::size_t index = waiting_.front();
    waiting_.pop_front();
    PlannedRun& run = runs_[index];
    auto job = std::make_unique<Job>(index, study_.log_of(run));
    if (!job->output.is_ours()) {
      run.problem = "another process is at it; start the study again when that has ended";
      tell(run, run.problem);
      return;
    }
    // By another process, since it was looked for.
    if (study_.is_complete(run)) {
      tell(run, "is there, made by another process");
      return;
    }
    job->output.clear();
    job->process = std::make_unique<ChildProcess>(arguments_of(study_, run, settings_),
                                                  job->output.descriptor());
    going_.push_back(std::move(job));
  }

  void look_at_all() {
    for (auto& job : going_) {
      if (const auto end = job->process->poll()) {
        finish(*job, *end);
        job.reset();
      }
    }
    std::erase(going_, nullptr);
  }

  void finish(const Job& job, const ProgramEnd& end) {
    PlannedRun& run = runs_[job.run];
    if (study_.is_complete(run)) {
      look_for_results(run);
      tell(run, fmt::format("done in {:.3g} s{}", seconds_since(job.began),
                            unknown_.empty() ? "" : ", and no more runs are begun: " + unknown_));
      return;
    }
    // Ctrl-C reaches the run itself too, which may have ended before that was looked at here.
    if (is_interrupted_ || settings_.is_interrupted()) {
      say(run, "interrupted");
      return;
    }
    if (end.exit_code == 0) {
      run.problem = "the scenario or the program was changed while it ran; start the study again";
    } else {
      run.problem = job.output.reason(end);
      job.output.record(run.problem);
    }
    tell(run, run.problem);
  }

  /// Of a run that is over, by how much of all is done.
  void tell(const PlannedRun& run, const std::string& what) {
    ++told_;
    const double elapsed = seconds_since(began_);
    const double left = elapsed / static_cast<double>(told_) * static_cast<double>(count_ - told_);
    say(run, fmt::format("{}; {} of {}, about {:.0f} s to go", what, told_, count_, left));
  }

  void say(const PlannedRun& run, const std::string& what) {
    settings_.progress << geometry::printable(fmt::format("run {} ({}): {}", run.point + 1,
                                                          fmt::join(run.overrides, ", "), what))
                       << '\n'
                       << std::flush;
  }

  StudyRuns& study_;
  std::vector<PlannedRun>& runs_;
  const MakeSettings& settings_;
  std::deque<std::size_t> waiting_;
  std::vector<std::unique_ptr<Job>> going_;
  bool is_interrupted_ = false;
  bool has_results_ = false;  ///< a run that is whole
  std::string unknown_;       ///< a result that no run has; empty: none is known
  std::size_t count_ = 0;
  std::size_t told_ = 0;
  Clock::time_point began_ = Clock::now();
};

}  // namespace

std::vector<std::size_t> missing_among(StudyRuns& study, const std::vector<PlannedRun>& runs) {
  std::vector<std::size_t> missing;
  std::set<std::string> keys;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& run = runs[i];
    if (!run.problem.empty() || !keys.insert(run.key).second || study.is_complete(run)) continue;
    missing.push_back(i);
  }
  return missing;
}

std::string make_missing(StudyRuns& study, std::vector<PlannedRun>& runs,
                         const MakeSettings& settings) {
  make_output_folder(study.out() / "runs");
  return Maker(study, runs, settings).make();
}

}  // namespace plekton::apps

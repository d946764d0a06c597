// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/study_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/interrupt.hpp"
#include "apps/programs/shell_word.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/study/job_texts.hpp"
#include "apps/study/run_missing.hpp"
#include "apps/study/study_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// What `plekton study` is to do about runs that are missing.
struct StudyArguments {
  fs::path study;
  fs::path out;                     ///< empty: out/<name of the study>
  std::optional<int> jobs;          ///< instead of that of the study
  std::optional<int> threads;       ///< likewise
  bool parallel = false;            ///< print a line for each
  bool slurm = false;               ///< print a script
  bool collect = false;             ///< only write the table
  std::optional<std::size_t> only;  ///< make this one alone (from 1), and no table
  bool quiet = false;
};

/// This very program.
fs::path program() {
  std::error_code error;
  fs::path path = fs::read_symlink("/proc/self/exe", error);
  if (error) throw InputError("study: cannot find the program plekton itself: " + error.message());
  return path;
}

int threads_of(const StudyArguments& arguments, const Study& study) {
  return arguments.threads.value_or(study.threads);
}

int jobs_of(const StudyArguments& arguments, const Study& study) {
  const int jobs = arguments.jobs.value_or(study.jobs);
  if (jobs > 0) return jobs;
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, processors / threads_of(arguments, study));
}

/// The command that goes on with it.
std::string command_again(const StudyArguments& arguments) {
  std::string command = "plekton study " + shell_word(arguments.study.string());
  if (!arguments.out.empty()) command += " --out " + shell_word(arguments.out.string());
  return command;
}

/// What others make the runs by: printed, nothing is written.
void print_jobs(const StudyArguments& arguments, StudyRuns& study, std::ostream& out) {
  const std::vector<PlannedRun> runs = study.plan_all();
  const std::vector<std::size_t> missing = missing_among(study, runs);
  if (missing.empty())
    throw InputError(fmt::format("{}: nothing is missing; the table is made by: {}",
                                 arguments.study.string(), command_again(arguments)));
  const JobSettings settings{program(), fs::absolute(arguments.study), fs::absolute(study.out()),
                             threads_of(arguments, study.study())};
  out << (arguments.slurm ? slurm_script(settings, missing) : parallel_lines(settings, missing));
}

int make_only(const StudyArguments& arguments, StudyRuns& study, std::ostream& progress) {
  if (*arguments.only < 1 || *arguments.only > study.size())
    throw InputError(
        fmt::format("--only: got {}; the study has runs 1 to {}", *arguments.only, study.size()));
  std::vector<PlannedRun> runs = {study.plan(*arguments.only - 1)};
  const InterruptGuard guard;
  make_missing(study, runs, {program(), 1, threads_of(arguments, study.study()), progress, [&] {
                               return guard.interrupted();
                             }});
  if (guard.interrupted()) return kInterrupted;
  if (!runs[0].problem.empty())
    throw InputError(fmt::format("run {}: {}", *arguments.only, runs[0].problem));
  return kDone;
}

int write_table(const StudyArguments& arguments, StudyRuns& study, std::vector<PlannedRun>& runs,
                std::ostream& progress) {
  const StudyCount count = write_study_table(study, runs);
  progress << fmt::format("wrote {}: {} runs, {} complete, {} failed, {} missing\n",
                          (study.out() / kStudyTable).string(), count.all, count.complete,
                          count.failed, count.missing);
  if (count.complete == count.all) return kDone;
  for (const PlannedRun& run : runs) {
    if (run.problem.empty()) continue;
    throw InputError(fmt::format(
        "{} of {} runs failed, the first of them run {}: {}\n  the others went on; the column "
        "problem of {} has the rest, and {} tries them again",
        count.failed, count.all, run.point + 1, run.problem, (study.out() / kStudyTable).string(),
        command_again(arguments)));
  }
  throw InputError(fmt::format("{} of {} runs are missing", count.missing, count.all));
}

int make_all(const StudyArguments& arguments, StudyRuns& study, std::ostream& progress) {
  refuse_other_table(study.out());
  make_output_folder(study.out());
  const OutputFolderLock lock(study.out());
  std::vector<PlannedRun> runs = study.plan_all();
  if (arguments.collect) return write_table(arguments, study, runs, progress);
  const InterruptGuard guard;
  const MakeSettings settings{program(), jobs_of(arguments, study.study()),
                              threads_of(arguments, study.study()), progress,
                              [&] { return guard.interrupted(); }};
  const std::size_t missing = missing_among(study, runs).size();
  progress << fmt::format("{}: {} runs, {} to make, {} at a time\n", arguments.study.string(),
                          runs.size(), missing, settings.jobs)
           << std::flush;
  const std::string unknown = make_missing(study, runs, settings);
  if (!guard.interrupted() && unknown.empty()) return write_table(arguments, study, runs, progress);
  write_study_table(study, runs);
  if (!unknown.empty())
    throw InputError(fmt::format(
        "{}; no more runs were begun: correct [results] of {} and go on with: {}\n  what is done "
        "stays",
        unknown, arguments.study.string(), command_again(arguments)));
  progress << "interrupted; go on with: " << command_again(arguments) << '\n';
  return kInterrupted;
}

/// @returns an ExitCode: kFailed if a run failed or, where only is collected, is missing
/// @throws InputError, dynamics::OutputError
int study_runs(const StudyArguments& arguments, std::ostream& out) {
  const fs::path folder =
      arguments.out.empty() ? fs::path("out") / arguments.study.stem() : arguments.out;
  StudyRuns study(read_study(arguments.study), folder);
  if (arguments.parallel || arguments.slurm) {
    print_jobs(arguments, study, out);
    return kDone;
  }
  std::ostringstream silence;
  std::ostream& progress = arguments.quiet ? static_cast<std::ostream&>(silence) : out;
  return arguments.only ? make_only(arguments, study, progress)
                        : make_all(arguments, study, progress);
}

}  // namespace

ProgramCommand add_study(CLI::App& app) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App* study = app.add_subcommand(
      "study",
      "Make many runs of a scenario, those that are missing, and a table of their results");
  study->add_option("study", arguments->study, "Study (.toml); apps/study.md documents its keys")
      ->required();
  study->add_option("--out", arguments->out,
                    "Folder for the runs and results.csv; out/<name of the study> if not given");
  CLI::Option* const jobs =
      study->add_option("--jobs", arguments->jobs, "Runs at a time, instead of `jobs` of the study")
          ->check(CLI::Range(1, 1024));
  study
      ->add_option("--threads", arguments->threads,
                   "Threads of each, instead of those of the study")
      ->check(CLI::Range(1, 1024));
  CLI::Option* const parallel =
      study
          ->add_flag("--parallel", arguments->parallel,
                     "Make none, but print a line for each, for GNU parallel or sh")
          ->excludes(jobs);
  CLI::Option* const slurm =
      study->add_flag("--slurm", arguments->slurm, "Make none, but print a script for sbatch")
          ->excludes(parallel)
          ->excludes(jobs);
  CLI::Option* const collect = study
                                   ->add_flag("--collect", arguments->collect,
                                              "Make none, but the table of those that are there")
                                   ->excludes(parallel)
                                   ->excludes(slurm);
  study
      ->add_option("--only", arguments->only,
                   "Make this one alone, by its number from 1, if it is missing; no table")
      ->excludes(parallel)
      ->excludes(slurm)
      ->excludes(collect);
  study->add_flag("--quiet", arguments->quiet, "Print nothing but problems, on standard error");
  return {study, [arguments] {
            const int code = study_runs(*arguments, std::cout);
            flush_output();
            return code;
          }};
}

}  // namespace plekton::apps

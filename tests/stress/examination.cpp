// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/examination.hpp"

#include "apps/command_line/check_report.hpp"
#include "apps/command_line/resumed_run.hpp"
#include "apps/run/checkpoints.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_warnings.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "tests/stress/apart.hpp"
#include "tests/stress/watch.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>
#include <utility>

namespace plekton::stress {
namespace {

namespace fs = std::filesystem;
using apps::PreparedRun;
using apps::RunReport;
using apps::Scenario;

/// What collisions with membranes keep of their energy to at an automatic step: apps/scenario.md.
constexpr double kStatedClosure = 1.0 / 16.0;
constexpr std::int64_t kMostSteps = 6000;

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// How one way to read or run a scenario ended.
struct Outcome {
  std::optional<RunReport> report;  ///< of a run that ended
  std::string refusal;              ///< empty if it was not refused
  std::string divergence;           ///< empty if it has not diverged
};

/// The runs of one scenario.
class Examination {
 public:
  /// @param folder  empty, for what the runs write
  Examination(const std::string& text, const ExaminationOptions& options, fs::path folder,
              const Tell& tell)
      : text_(text), options_(options), folder_(std::move(folder)), tell_(tell) {}

  void execute() {
    begin("check");
    const std::string refusal = check(false);
    begin("run on 1 thread");
    const Outcome base = run(Part::run, 1, base_settings(), true);
    compare_refusals(refusal, base.refusal);
    if (!base.divergence.empty()) judge_divergence(base.divergence);
    if (base.report) judge(*base.report);
    tell_(fmt::format("refused {}\n", base.refusal.empty() ? 0 : 1));
    if (!base.report) return;
    if (wants(Fault::threads)) {
      compare_threads(*base.report, Part::two_threads, 2, kMostSteps);
      compare_threads(*base.report, Part::three_threads, 3, base.report->steps / 2);
    }
    if (wants(Fault::restart)) restart();
  }

 private:
  bool wants(Fault fault) const noexcept { return !options_.only || *options_.only == fault; }

  void begin(const std::string& stage) const { tell_("stage " + stage + '\n'); }

  void find(Fault fault, const std::string& text) const {
    tell_(fmt::format("found {} {}\n", static_cast<int>(fault), first_line(text)));
  }

  /// In place of what the scenario says of its hashes and checkpoints.
  static std::vector<std::string> base_settings() { return {"output.hash_interval=20"}; }

  Scenario scenario_of(std::vector<std::string> settings, int threads) const {
    settings.push_back(fmt::format("simulation.threads={}", threads));
    return apps::parse_scenario(text_, options_.file, settings);
  }

  /// As `plekton check` does it. @returns why it is refused
  std::string check(bool with_estimate) {
    try {
      const Scenario scenario = scenario_of(base_settings(), 1);
      PreparedRun prepared = apps::prepare_run(scenario);
      apps::require_possible_start(prepared.start, scenario);
      warned_ = !prepared.built.warnings.empty();
      if (!with_estimate) return "";
      const auto report = apps::check_report(scenario, prepared);
      warned_ = warned_ || report["estimate"].contains("failure");
    } catch (const apps::InputError& error) {
      return error.what();
    }
    return "";
  }

  /// @param watched  looked at after every step
  Outcome run(Part part, int threads, const std::vector<std::string>& settings, bool watched,
              std::int64_t last_step = kMostSteps) const {
    const bool is_base = part == Part::run;
    try {
      Scenario scenario = scenario_of(settings, threads);
      if (is_base) scenario = with_checkpoints(scenario.simulation.duration, settings, threads);
      PreparedRun prepared = apps::prepare_run(scenario);
      return {run_prepared(part, scenario, prepared, nullptr, watched, last_step), "", ""};
    } catch (const apps::InputError& error) {
      return {std::nullopt, error.what(), ""};
    } catch (const dynamics::Diverged& error) {
      return {std::nullopt, "", error.what()};
    }
  }

  Scenario with_checkpoints(double duration, std::vector<std::string> settings, int threads) const {
    settings.push_back(fmt::format("output.checkpoint_interval={:.17g}", 0.43 * duration));
    return scenario_of(std::move(settings), threads);
  }

  RunReport run_prepared(Part part, const Scenario& scenario, PreparedRun& prepared,
                         const apps::Resumption* resume, bool watched,
                         std::int64_t last_step) const {
    dynamics::Simulation& simulation = *prepared.simulation;
    const Conserved conserved = conserved_in(scenario);
    Watch watch(conserved, simulation);
    const auto after_step = [&] {
      if (options_.disturb) options_.disturb(simulation, part);
      if (watched) watch.look(simulation);
      return simulation.steps() >= last_step;
    };
    std::ostringstream silence;
    const apps::RunSettings settings{folder_of(part),
                                     silence,
                                     apps::ProgressStyle::none,
                                     after_step,
                                     apps::Progress::Clock::now(),
                                     true,
                                     resume};
    const auto ended = [&](bool in_order) {
      tell_(fmt::format("steps {}\n", simulation.steps()));
      if (!watched) return;
      Findings findings;
      if (in_order)
        watch.finish(simulation, findings);
      else
        watch.find_lost(findings);
      for (const Finding& finding : findings.all) find(finding.fault, finding.text);
      tell_(fmt::format("momentum {}\ncontacts {}\n", conserved.momentum ? 1 : 0,
                        watch.most_contacts()));
    };
    try {
      RunReport report = apps::run(scenario, prepared, settings);
      ended(true);
      return report;
    } catch (const dynamics::Diverged&) {
      ended(false);
      throw;
    }
  }

  /// A restart goes on in the folder of the first run.
  fs::path folder_of(Part part) const {
    if (part == Part::restart) return folder_ / fmt::format("{}", static_cast<int>(Part::run));
    return folder_ / fmt::format("{}", static_cast<int>(part));
  }

  void compare_refusals(const std::string& check, const std::string& run) const {
    if (!wants(Fault::check) || check == run) return;
    find(Fault::check,
         fmt::format("check says \"{}\", and run \"{}\"", first_line(check), first_line(run)));
  }

  void judge_divergence(const std::string& divergence) {
    if (!wants(Fault::diverged)) return;
    check(true);
    if (!warned_) find(Fault::diverged, divergence);
  }

  void judge(const RunReport& report) const {
    tell_(fmt::format("broken {}\nclosure {}\n", report.broken_bonds + report.torn_facets,
                      report.energy_closure));
    if (report.energy_closure > kStatedClosure && !is_attracted())
      find(Fault::energy, fmt::format("the balance is off by {:.3g} % of what went through",
                                      100.0 * report.energy_closure));
    const double drift = std::max(report.momentum.linear, report.momentum.angular);
    if (!(drift <= apps::kMomentumDrift))
      find(Fault::momentum,
           fmt::format("contacts, bonds and sheets made {:.3g} of the momentum they carry", drift));
  }

  /// A force that jumps as bodies come to touch is not in the balance: apps/scenario.md.
  bool is_attracted() const { return text_.find("work_of_adhesion") != std::string::npos; }

  void compare_threads(const RunReport& base, Part part, int threads, std::int64_t last) const {
    begin(fmt::format("run on {} threads", threads));
    std::vector<std::string> settings = base_settings();
    for (const char* const files : {"grains", "membranes", "contacts", "contact_list"})
      settings.push_back(fmt::format("output.{}=false", files));
    const Outcome outcome = run(part, threads, settings, false, last);
    if (!outcome.report)
      return find(Fault::threads, fmt::format("on {} threads it ends with: {}{}", threads,
                                              outcome.refusal, outcome.divergence));
    std::map<std::int64_t, std::uint64_t> hashes;
    for (const apps::StateHash& state : base.states.all()) hashes[state.step] = state.hash;
    for (const apps::StateHash& state : outcome.report->states.all()) {
      const auto same = hashes.find(state.step);
      if (same == hashes.end() || same->second == state.hash) continue;
      return find(Fault::threads, fmt::format("another state on {} threads, first seen at step {}",
                                              threads, state.step));
    }
  }

  /// By their names relative to the folder of the run, but for the times in run.json.
  std::map<std::string, std::string> files_of_run() const {
    std::map<std::string, std::string> files;
    const fs::path folder = folder_of(Part::run);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "run.json") continue;
      files[fs::relative(entry.path(), folder).string()] = test::bytes_of(entry.path());
    }
    return files;
  }

  void restart() const {
    begin("restart");
    const std::map<std::string, std::string> before = files_of_run();
    const std::vector<fs::path> checkpoints = apps::checkpoints_of(folder_of(Part::run));
    if (checkpoints.size() < 2) return;
    for (std::size_t i = (checkpoints.size() + 1) / 2; i < checkpoints.size(); ++i)
      fs::remove(checkpoints[i]);
    const int threads = 2 + static_cast<int>(text_.size() % 2);
    const std::vector<std::string> settings{fmt::format("simulation.threads={}", threads)};
    const apps::ResumedRun resumed = apps::find_resumed_run(
        {.folder = folder_of(Part::run), .overrides = settings, .same_folder = true});
    try {
      PreparedRun prepared = apps::prepare_run(resumed.scenario);
      const apps::Resumption from{resumed.checkpoint.state, true, std::nullopt};
      run_prepared(Part::restart, resumed.scenario, prepared, &from, false, kMostSteps);
    } catch (const std::exception& error) {
      return find(Fault::restart, error.what());
    }
    compare_files(before, files_of_run());
  }

  void compare_files(const std::map<std::string, std::string>& before,
                     const std::map<std::string, std::string>& after) const {
    for (const auto& [name, bytes] : before) {
      const auto other = after.find(name);
      if (other != after.end() && other->second == bytes) continue;
      return find(Fault::restart, fmt::format("{} is another one after a restart", name));
    }
    if (before.size() != after.size()) find(Fault::restart, "a restart leaves other files");
  }

  const std::string& text_;
  const ExaminationOptions& options_;
  fs::path folder_;
  const Tell& tell_;
  bool warned_ = false;  // by check
};

/// Reads what an examination has told, as far as it came.
/// @param stage  the last one that began
Findings read_findings(const std::string& told, std::string& stage) {
  Findings findings;
  std::istringstream lines(told);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    if (what == "stage") stage = line.substr(6);
    if (what == "refused") words >> findings.is_refused;
    if (what == "momentum") words >> findings.knows_momentum;
    if (what == "contacts") words >> findings.contacts;
    if (what == "broken") words >> findings.broken;
    if (what == "closure") words >> findings.closure;
    std::int64_t number = 0;
    if (what == "steps" && words >> number) findings.steps += number;
    if (what != "found" || !(words >> number)) continue;
    std::string text;
    std::getline(words >> std::ws, text);
    findings.all.push_back({static_cast<Fault>(number), text});
  }
  return findings;
}

}  // namespace

Findings examine(const std::string& scenario, const ExaminationOptions& options) {
  const test::TemporaryFolder folder;
  const Apart apart = do_apart(
      [&](const Tell& tell) {
        try {
          Examination(scenario, options, folder.path(), tell).execute();
        } catch (const std::exception& error) {
          tell(fmt::format("found {} exception: {}\n", static_cast<int>(Fault::crash),
                           first_line(error.what())));
        }
      },
      options.processor_time);
  std::string stage;
  Findings findings = read_findings(apart.told, stage);
  if (apart.hung) {
    findings.all.push_back({Fault::hang, "in " + stage});
  } else if (apart.signal != 0) {
    findings.all.push_back(
        {Fault::crash, fmt::format("{} in {}", ::strsignal(apart.signal), stage)});
  }
  return findings;
}

std::optional<double> shorter_duration(const std::string& scenario, std::int64_t steps,
                                       const ExaminationOptions& options) {
  const Apart apart = do_apart(
      [&](const Tell& tell) {
        try {
          const Scenario read = apps::parse_scenario(scenario, options.file);
          const PreparedRun prepared = apps::prepare_run(read);
          const double duration = static_cast<double>(steps) * prepared.simulation->time_step();
          if (duration < read.simulation.duration) tell(fmt::format("{:.4g}", duration));
        } catch (const std::exception&) {
        }
      },
      options.processor_time);
  if (apart.told.empty() || apart.signal != 0) return std::nullopt;
  return std::stod(apart.told);
}

}  // namespace plekton::stress

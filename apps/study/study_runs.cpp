// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/study_runs.hpp"

#include "apps/run/build_info.hpp"
#include "apps/run/run_report.hpp"
#include "apps/run/scenario_copy.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/toml_file.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// The report of a run that came to its end, of this build.
std::optional<nlohmann::json> report_of_whole_run(const fs::path& folder) {
  std::string bytes;
  try {
    bytes = geometry::read_regular_file(folder / "run.json", "the report of a run");
  } catch (const geometry::UnreadableFile&) {
    return std::nullopt;
  }
  auto report = nlohmann::json::parse(bytes, nullptr, false);
  const auto is = [&](const char* key, std::string_view value) {
    const auto found = report.find(key);
    return found != report.end() && found->is_string() &&
           found->get_ref<const std::string&>() == value;
  };
  const BuildInfo build = build_info();
  const bool is_ours = report.is_object() && is("plekton", kVersion) &&
                       is("revision", build.revision) && is("compiler", build.compiler);
  const bool is_whole = is_ours && (is("status", name_of(RunStatus::finished)) ||
                                    is("status", name_of(RunStatus::at_rest)));
  if (!is_whole) return std::nullopt;
  return report;
}

/// What --set replaced.
std::vector<std::string> overrides_in(const nlohmann::json& report) {
  std::vector<std::string> overrides;
  const nlohmann::json::json_pointer place("/options/set");
  if (!report.contains(place) || !report[place].is_array()) return overrides;
  for (const auto& text : report[place])
    if (text.is_string()) overrides.push_back(text.get<std::string>());
  return overrides;
}

}  // namespace

StudyRuns::StudyRuns(Study study, fs::path out)
    : study_(std::move(study)),
      out_(std::move(out)),
      text_(read_toml_text(study_.scenario)),
      keys_(study_.scenario) {}

PlannedRun StudyRuns::plan(std::size_t point) {
  PlannedRun run{point, overrides_of(study_, point), "", ""};
  try {
    parse_scenario(text_, study_.scenario, run.overrides);
    run.key = keys_.key_of(text_, run.overrides);
  } catch (const InputError& error) {
    run.problem = error.what();
  }
  return run;
}

std::vector<PlannedRun> StudyRuns::plan_all() {
  std::vector<PlannedRun> runs;
  for (std::size_t i = 0; i < size(); ++i) runs.push_back(plan(i));
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.problem.empty(); }))
    return runs;
  std::string problem = runs[0].problem;
  for (std::size_t at = 0; (at = problem.find('\n', at)) != std::string::npos; at += 3)
    problem.insert(at + 1, "  ");  // what begins with blanks goes on with the same message
  throw InputError(fmt::format("{}: none of the {} runs can be made; of the first:\n  {}",
                               to_string(study_.points[0].place), size(), problem));
}

fs::path StudyRuns::folder_of(const PlannedRun& run) const {
  return out_ / "runs" / run.key;
}

fs::path StudyRuns::log_of(const PlannedRun& run) const {
  return out_ / "runs" / (run.key + ".log");
}

bool StudyRuns::is_complete(const PlannedRun& run) {
  const fs::path folder = folder_of(run);
  const auto report = report_of_whole_run(folder);
  if (!report) return false;
  // The scenario may have been another when it was read by the run; the copy tells.
  try {
    const std::string copy = geometry::read_regular_file(folder / kScenarioCopy, "a scenario");
    return keys_.key_of(copy, overrides_in(*report)) == run.key;
  } catch (const geometry::UnreadableFile&) {
    return false;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace plekton::apps

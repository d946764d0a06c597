// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/study_table.hpp"

#include "apps/run/other_file.hpp"
#include "apps/study/run_log.hpp"
#include "apps/study/run_results.hpp"
#include "apps/viewer/csv_text.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace plekton::apps {
namespace {

/// On one line, for a cell that is looked at.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

class TableWriter {
 public:
  TableWriter(StudyRuns& study, std::vector<PlannedRun>& runs) : study_(study), runs_(runs) {
    for (const PlannedRun& run : runs)
      if (!run.problem.empty() && !run.key.empty()) problems_.try_emplace(run.key, run.problem);
    units_.resize(study.study().results.size());
  }

  StudyCount count() const { return count_; }

  std::string text() {
    std::string rows;
    for (PlannedRun& run : runs_) rows += row(run);
    return head() + rows;
  }

 private:
  /// After the rows, which know the units.
  std::string head() const {
    std::string line = "run";
    for (const std::string& parameter : study_.study().parameters)
      line += ',' + csv_cell(parameter);
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const std::string& name = study_.study().results[i].name;
      line += ',' + csv_cell(units_[i].empty() ? name : fmt::format("{} ({})", name, units_[i]));
    }
    return line + ",status,problem,key\n";
  }

  std::string row(PlannedRun& run) {
    const std::vector<RunResult> results = results_or_problem(run);
    std::string line = std::to_string(run.point + 1);
    for (const std::string& value : study_.study().points[run.point].values)
      line += ',' + csv_cell(value);
    for (std::size_t i = 0; i < units_.size(); ++i)
      line += ',' + (results.empty() ? "" : csv_cell(results[i].text));
    return fmt::format("{},{},{},{}\n", line, status_of(run, results),
                       csv_cell(one_line(run.problem)), run.key);
  }

  /// Empty if there are none.
  std::vector<RunResult> results_or_problem(PlannedRun& run) {
    // Of runs with the same key one alone was made.
    if (const auto found = problems_.find(run.key); found != problems_.end())
      run.problem = found->second;
    if (!run.problem.empty()) return {};
    if (!study_.is_complete(run)) {
      // Of an earlier time, or made by another process.
      run.problem = problem_in_log(study_.log_of(run));
      return {};
    }
    try {
      auto results = results_of(study_.folder_of(run), study_.study().results);
      for (std::size_t i = 0; i < units_.size(); ++i) units_[i] = results[i].unit;
      return results;
    } catch (const NoResult& error) {
      run.problem = error.what();
      return {};
    }
  }

  std::string_view status_of(const PlannedRun& run, const std::vector<RunResult>& results) {
    ++count_.all;
    if (!run.problem.empty()) return ++count_.failed, "failed";
    if (results.empty()) return ++count_.missing, "missing";
    return ++count_.complete, "complete";
  }

  StudyRuns& study_;
  std::vector<PlannedRun>& runs_;
  std::map<std::string, std::string> problems_;  ///< by key
  std::vector<std::string> units_;               ///< by result
  StudyCount count_;
};

bool is_table_of_study(std::string_view head) {
  return head.starts_with("run,");
}

}  // namespace

void refuse_other_table(const std::filesystem::path& folder) {
  refuse_other_file(folder / kStudyTable, "table of plekton study", is_table_of_study);
}

StudyCount write_study_table(StudyRuns& study, std::vector<PlannedRun>& runs) {
  TableWriter table(study, runs);
  const std::string text = table.text();
  dynamics::OutputFile file(study.out() / kStudyTable);
  file.write(text);
  file.commit();
  return table.count();
}

}  // namespace plekton::apps

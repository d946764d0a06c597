// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/measure_sample.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// The columns of measures/NAME.csv.
std::span<const dynamics::OutputField> measure_fields();

/// measures/NAME.csv
std::string file_of(const MeasureSettings& measure);

/// Files of measures in the folder of a run, whatever they are called.
std::vector<std::filesystem::path> measures_in(const std::filesystem::path& folder);

/// Refuses the folder of a run in which somebody's file has the name of a measure. @throws InputError
void refuse_other_measures(const std::filesystem::path& folder, const Scenario& scenario);

/// The region of a measure at the time of the last step, cut at its planes; what is cut away wholly
/// has no volume.
geometry::Region region_of(const MeasureSettings& settings, const dynamics::Simulation& simulation,
                           const dynamics::Sample& sample);

/// Writes a file measures/NAME.csv for each of [[output.measures]].
class Measures {
 public:
  /// Removes the measures of an earlier run, unless that goes on.
  /// @throws dynamics::OutputError
  Measures(const std::filesystem::path& folder, const Scenario& scenario,
           const WrittenFiles* before = nullptr);

  /// Appends a row to each; rows reach the files in blocks, at flush() and at close().
  /// @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation);
  void flush();
  void close();
  /// After a flush.
  void tell(WrittenFiles& written) const;

 private:
  std::vector<MeasureSettings> measures_;
  std::vector<HistoryFile> files_;  ///< one for each
};

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics {

/// One data set of a time series.
struct SeriesEntry {
  double time;                 ///< s
  std::string part;            ///< UTF-8; data sets of the same name follow each other in time
  std::filesystem::path file;  ///< complete; listed relative to the folder of the series
};

/// A `.pvd` file: the data sets of a time series, opened in ParaView as one. It is replaced as a
/// whole by every add(), so it is valid at any moment, also while the simulation runs or after it
/// was stopped, and it names complete files only. Writing grows linearly with the entries so far.
class PvdSeries {
 public:
  /// Nothing is written before the first add().
  explicit PvdSeries(std::filesystem::path file) : file_(std::move(file)) {}

  /// Appends the data sets of one moment.
  /// @throws OutputError if a data set is not there or the series cannot be written; the series is
  /// then as before.
  void add(const std::vector<SeriesEntry>& entries);

 private:
  std::string line(const SeriesEntry& entry);
  std::size_t part_number(const std::string& name);
  void write() const;

  std::filesystem::path file_;
  std::vector<std::string> parts_;  // the number of a part is its position
  std::string lines_;               // XML, one line for each entry
};

}  // namespace plekton::dynamics

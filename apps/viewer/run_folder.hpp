// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/written_files.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// The series of a run, in the order in which a page tells of them.
inline constexpr std::array<std::string_view, 3> kSeries = {"grains", "membranes", "contacts"};

/// What a run has written of one moment.
struct FrameFiles {
  double time = 0.0;                                     ///< s
  std::array<std::filesystem::path, kSeries.size()> of;  ///< by series; empty where there is none
};

/// A table of numbers over time, of a CSV file of the run.
struct RecordedHistory {
  struct Column {
    std::string name;
    std::string unit;  ///< empty of a number without one
    std::vector<double> values;
  };
  std::string file;  ///< its name in the folder of the run
  std::vector<Column> columns;

  std::size_t rows() const noexcept { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// What the folder of a run holds, as it is at the time of the call; the run may still go on.
struct RunFolder {
  std::filesystem::path folder;
  std::string title;                             ///< name of the folder
  std::optional<nlohmann::ordered_json> report;  ///< run.json; none before the end of the run
  std::vector<FrameFiles> frames;                ///< by time
  /// planes.csv: at the times of the frames. @see planes_at
  std::optional<RecordedHistory> planes;
};

/// @throws ViewError for what is no folder of a run: no such folder, neither frames nor run.json in
/// it, or files of that name that are something else
RunFolder open_run_folder(const std::filesystem::path& folder);

/// Point (m), direction and radius (m) of a plane, as in planes.csv.
using PlaneNumbers = std::array<double, 7>;

/// Those of every plane that is there at a time: one that comes in a later stage is not.
std::vector<PlaneNumbers> planes_at(const RunFolder& run, double time);

/// The histories of a run: those of kHistories that are there, then those of its measures by name
/// ("measures/NAME.csv").
inline constexpr std::array<std::string_view, 6> kHistories = {
    "energy.csv", "reactions.csv", "pressures.csv", "rigid_bodies.csv", "ties.csv", kPlanesFile};
/// Of a run that still goes on a last row without its end is left out.
/// @throws ViewError for a file that is no table of numbers
std::vector<RecordedHistory> read_histories(const std::filesystem::path& folder);

/// A CSV file with a head row "name (unit),...". @throws ViewError
RecordedHistory read_history(const std::filesystem::path& file);

}  // namespace plekton::apps

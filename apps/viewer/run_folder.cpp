// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/run_folder.hpp"

#include "apps/run/output_folder.hpp"
#include "apps/viewer/csv_text.hpp"
#include "apps/viewer/view_error.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/mesh/io/xml_elements.hpp"
#include "geometry/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// A number as C++ writes it, also inf and nan; nothing for anything else.
std::optional<double> number_of(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string bytes_of(const fs::path& file, std::string_view expected) {
  try {
    return geometry::read_regular_file(file, expected);
  } catch (const geometry::UnreadableFile& error) {
    throw ViewError(error.what());
  }
}

/// Adds the data sets of a series to the moments that they show.
void read_series(const fs::path& file, std::size_t series, std::map<double, FrameFiles>& frames) {
  const std::string bytes = bytes_of(file, "a series of frames (.pvd)");
  std::vector<geometry::XmlElement> elements;
  try {
    elements = geometry::read_xml(bytes, file.string(), "VTKFile");
  } catch (const geometry::MeshError&) {
    throw ViewError(file.string() +
                    ": is no series of frames, or only a part of one; repeat the run, or move the "
                    "file away to see the rest");
  }
  for (const geometry::XmlElement& element : elements) {
    if (element.name != "DataSet") continue;
    const auto time = number_of(element.attribute("timestep"));
    const std::string_view name = element.attribute("file");
    if (!time || !std::isfinite(*time) || name.empty())
      throw ViewError(fmt::format("{}: line {}: names no time and file; repeat the run",
                                  file.string(), element.line));
    FrameFiles& frame = frames[*time];
    frame.time = *time;
    frame.of[series] = file.parent_path() / fs::path(name);
  }
}

std::optional<nlohmann::ordered_json> read_report(const fs::path& file) {
  if (std::error_code ignored; !fs::exists(file, ignored)) return std::nullopt;
  auto report =
      nlohmann::ordered_json::parse(bytes_of(file, "the report of a run (.json)"), nullptr, false);
  if (!report.is_object() || !report.contains("plekton"))
    throw ViewError(file.string() + ": is no report of a run of plekton; name the folder of a run");
  return report;
}

/// "force (N)" is force in N.
RecordedHistory::Column column_of(std::string_view head) {
  const std::size_t unit = head.rfind(" (");
  if (unit == std::string_view::npos || !head.ends_with(')')) return {std::string(head), "", {}};
  return {std::string(head.substr(0, unit)),
          std::string(head.substr(unit + 2, head.size() - unit - 3)),
          {}};
}

/// Of a row of numbers.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

void add_row(std::string_view line, std::size_t number, const fs::path& file,
             RecordedHistory& history) {
  const auto cells = cells_of(line);
  bool fits = cells.size() == history.columns.size();
  for (std::size_t i = 0; fits && i < cells.size(); ++i) {
    const auto value = number_of(cells[i]);
    fits = value.has_value();
    if (fits) history.columns[i].values.push_back(*value);
  }
  if (!fits)
    throw ViewError(
        fmt::format("{}: line {}: expected {} numbers; repeat the run, or move the "
                    "file away to see the rest",
                    file.string(), number, history.columns.size()));
}

/// Histories of measures, by name.
std::vector<std::string> measure_files(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / kMeasuresFolder, ignored))
    if (entry.path().extension() == ".csv")
      names.push_back(std::string(kMeasuresFolder) + '/' + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// How many columns the first plane has, and any other, where it is first: runs of before have no
/// radius (all of their planes are flat), or not what presses.
std::size_t columns_of_a_plane(std::span<const RecordedHistory::Column> columns) {
  const auto name_of = [](const RecordedHistory::Column& column) {
    return std::string_view(column.name).substr(0, column.name.rfind('.'));
  };
  std::size_t count = 1;
  while (1 + count < columns.size() && name_of(columns[1 + count]) == name_of(columns[1])) ++count;
  return count;
}

}  // namespace

RunFolder open_run_folder(const fs::path& folder) {
  std::error_code ignored;
  if (const std::string problem = problem_with_run_folder(folder); !problem.empty())
    throw ViewError(problem);
  RunFolder run;
  run.folder = folder;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  run.title = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  run.report = read_report(folder / "run.json");
  std::map<double, FrameFiles> frames;
  bool has_series = false;
  for (std::size_t series = 0; series < kSeries.size(); ++series) {
    const fs::path file = folder / fmt::format("{}.pvd", kSeries[series]);
    if (!fs::exists(file, ignored)) continue;
    has_series = true;
    read_series(file, series, frames);
  }
  if (!run.report && !has_series)
    throw ViewError(folder.string() +
                    ": holds no run: neither run.json nor frames are in it; name the folder that "
                    "plekton run wrote to");
  for (auto& [time, frame] : frames) run.frames.push_back(std::move(frame));
  if (const fs::path file = folder / "planes.csv"; fs::exists(file, ignored))
    run.planes = read_history(file);
  return run;
}

std::vector<PlaneNumbers> planes_at(const RunFolder& run, double time) {
  std::vector<PlaneNumbers> planes;
  if (!run.planes || run.planes->rows() == 0) return planes;
  const auto& columns = run.planes->columns;
  const std::vector<double>& times = columns.front().values;
  std::size_t row = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - time) < std::abs(times[row] - time)) row = i;
  const std::size_t each = columns_of_a_plane(columns);
  for (std::size_t first = 1; first + each <= columns.size(); first += each) {
    PlaneNumbers plane{};
    for (std::size_t k = 0; k < std::min(each, plane.size()); ++k)
      plane[k] = columns[first + k].values[row];
    if (std::none_of(plane.begin(), plane.end(), [](double x) { return std::isnan(x); }))
      planes.push_back(plane);
  }
  return planes;
}

RecordedHistory read_history(const fs::path& file) {
  const std::string bytes = bytes_of(file, "a history (.csv)");
  RecordedHistory history;
  history.file = file.filename().string();
  std::string_view rest = bytes;
  for (std::size_t number = 1;; ++number) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return history;  // being written, or at the end
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (number > 1) {
      add_row(line, number, file, history);
      continue;
    }
    // Names may have commas and quotes, but no line breaks.
    for (const CsvRow& row : parse_csv(line))
      for (const std::string& head : row.cells) history.columns.push_back(column_of(head));
    if (history.columns.empty() || history.columns.front().name != "time")
      throw ViewError(file.string() +
                      ": is no history of plekton: its first column is not the time; move the "
                      "file away to see the rest");
  }
}

std::vector<RecordedHistory> read_histories(const fs::path& folder) {
  std::vector<std::string> names(kHistories.begin(), kHistories.end());
  for (std::string& name : measure_files(folder)) names.push_back(std::move(name));
  std::vector<RecordedHistory> histories;
  for (const std::string& name : names) {
    if (std::error_code ignored; !fs::exists(folder / name, ignored)) continue;
    RecordedHistory history = read_history(folder / name);
    history.file = name;
    if (history.rows() > 0) histories.push_back(std::move(history));
  }
  return histories;
}

}  // namespace plekton::apps

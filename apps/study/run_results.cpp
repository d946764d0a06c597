// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_results.hpp"

#include "apps/run/history.hpp"
#include "apps/run/measures.hpp"
#include "apps/run/run_report.hpp"
#include "apps/run/written_files.hpp"
#include "apps/scenario/closest_word.hpp"
#include "apps/viewer/run_folder.hpp"
#include "apps/viewer/view_error.hpp"
#include "geometry/base/regular_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void refuse(const ResultSettings& result, const std::string& what) {
  throw NoResult(fmt::format("results.{}: {}", result.name, what));
}

[[noreturn]] void refuse_name(const ResultSettings& result, const std::string& what) {
  throw UnknownResult(fmt::format("results.{}: {}", result.name, what));
}

/// What is under a key of an object, or at a number (from 0) of a list; null if there is none.
const Json* below(const Json& json, const std::string& key) {
  if (json.is_object()) {
    const auto found = json.find(key);
    return found == json.end() ? nullptr : &*found;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  const bool is_number = error == std::errc() && end == key.data() + key.size();
  return json.is_array() && is_number && number < json.size() ? &json[number] : nullptr;
}

std::string keys_near(const Json& json, const std::string& key) {
  if (!json.is_object()) return "";
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return did_you_mean(key, std::vector<std::string_view>(keys.begin(), keys.end()));
}

/// A value of run.json, or what is wrong with its path.
struct Found {
  const Json* value = nullptr;
  std::string problem;
};

/// @param is_sketch  of a run that was not made: what is in its lists is not known
Found value_at(const Json& report, std::string_view path, bool is_sketch) {
  const Json* value = &report;
  for (std::string_view rest = path;;) {
    const std::string key(rest.substr(0, rest.find('.')));
    const Json* const next = below(*value, key);
    if (next == nullptr)
      return {nullptr, fmt::format("run.json has no \"{}\": there is no \"{}\"{}", path, key,
                                   keys_near(*value, key))};
    value = next;
    if (key.size() == rest.size()) break;
    if (is_sketch && value->is_array()) return {value, ""};
    rest.remove_prefix(key.size() + 1);
  }
  if (value->is_object() || value->is_array())
    return {value, fmt::format("\"{}\" of run.json is no single value; name one in it", path)};
  return {value, ""};
}

/// With all that the report of a run can have.
const Json& sketch_of_report() {
  static const Json kSketch = [] {
    RunReport report;
    report.message = report.stopped_by = "?";
    report.resumed = 0.0;
    report.deepest_overlap.emplace();
    report.stages = {"{}"};
    return Json::parse(to_json(report));
  }();
  return kSketch;
}

std::string report_value(const Json& report, const ResultSettings& result) {
  const auto [value, problem] = value_at(report, result.report, false);
  if (!problem.empty()) refuse(result, problem);
  return value->is_string() ? value->get<std::string>() : value->dump();
}

std::string no_column(const std::string& file, const std::string& column,
                      std::span<const std::string_view> known) {
  return fmt::format("{} has no column \"{}\"{}", file, column, did_you_mean(column, known));
}

const RecordedHistory::Column& column_of(const RecordedHistory& history,
                                         const ResultSettings& result) {
  std::vector<std::string_view> names;
  for (const RecordedHistory::Column& column : history.columns) {
    if (column.name == result.column) return column;
    names.push_back(column.name);
  }
  refuse_name(result, no_column(history.file, result.column, names));
}

/// Whether this is what a run may call the history of a measure, below its folder.
bool is_of_measure(const std::string& file) {
  const fs::path path(file);
  return path.extension() == ".csv" &&
         file == (fs::path(kMeasuresFolder) / path.filename()).string();
}

/// s, of the last row where a time is beyond it by no more than the last step of a run may be short
/// of its end; otherwise the time itself. @param times  s, rising, at least one
double within_rows(const std::vector<double>& times, double time) {
  // Of a step, by Simulation::step_until; rows are at least a step apart.
  constexpr double kShort = 1e-3;
  const double last = times.back();
  const auto rest = std::lower_bound(times.begin(), times.end(), last);
  if (rest == times.begin()) return time;
  const double interval = last - *std::prev(rest);
  return time > last && time <= last + kShort * interval ? last : time;
}

/// Linear between two rows. @param times  s, rising, at least one
double value_then(const std::vector<double>& times, const std::vector<double>& values, double time,
                  const ResultSettings& result) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.end() || (after == times.begin() && *after > time))
    refuse(result, fmt::format("{} has no row at {} s; it goes from {} s to {} s", result.file,
                               time, times.front(), times.back()));
  const auto i = static_cast<std::size_t>(after - times.begin());
  if (times[i] == time) return values[i];
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

double value_at_time(const std::vector<double>& times, const std::vector<double>& values,
                     const ResultSettings& result) {
  const double value = value_then(times, values, within_rows(times, *result.at), result);
  if (std::isnan(value))
    refuse(result, fmt::format("{} has no value of \"{}\" at {} s: it is nan there", result.file,
                               result.column, *result.at));
  return value;
}

/// The integral over time by trapezoids, over the time; of rows at one time their mean.
double mean_over_time(std::span<const double> times, std::span<const double> values) {
  const double span = times.back() - times.front();
  double sum = 0.0;
  if (!(span > 0.0)) {
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  for (std::size_t i = 1; i < times.size(); ++i)
    sum += 0.5 * (values[i] + values[i - 1]) * (times[i] - times[i - 1]);
  return sum / span;
}

double taken(std::span<const double> times, std::span<const double> values, Take take) {
  switch (take) {
    case Take::first:
      return values.front();
    case Take::max:
      return *std::max_element(values.begin(), values.end());
    case Take::min:
      return *std::min_element(values.begin(), values.end());
    case Take::mean:
      return mean_over_time(times, values);
    case Take::change:
      return values.back() - values.front();
    case Take::last:
      break;
  }
  return values.back();
}

/// Rows of a history with a value.
struct Rows {
  std::vector<double> times;  ///< s
  std::vector<double> values;
};

/// Those of some rows whose value is a number: measures have none before there are contacts.
Rows rows_with_value(std::span<const double> times, std::span<const double> values) {
  Rows rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isnan(values[i])) continue;
    rows.times.push_back(times[i]);
    rows.values.push_back(values[i]);
  }
  return rows;
}

double history_value(const RecordedHistory& history, const ResultSettings& result) {
  const std::vector<double>& times = history.columns.front().values;
  const std::vector<double>& values = column_of(history, result).values;
  if (times.empty()) refuse(result, result.file + " has no rows");
  if (result.at) return value_at_time(times, values, result);
  const auto begin =
      result.from ? std::lower_bound(times.begin(), times.end(), within_rows(times, *result.from))
                  : times.begin();
  const auto end =
      result.to ? std::upper_bound(times.begin(), times.end(), *result.to) : times.end();
  if (begin >= end)
    refuse(result,
           fmt::format("{} has no row from {} s to {} s", result.file,
                       result.from.value_or(times.front()), result.to.value_or(times.back())));
  const auto first = static_cast<std::size_t>(begin - times.begin());
  const auto count = static_cast<std::size_t>(end - begin);
  const Rows rows = rows_with_value(std::span(times).subspan(first, count),
                                    std::span(values).subspan(first, count));
  if (rows.times.empty())
    refuse(result, fmt::format("{} has no value of \"{}\" from {} s to {} s: it is nan in all rows",
                               result.file, result.column, times[first], times[first + count - 1]));
  return taken(rows.times, rows.values, result.take);
}

/// The files of a run, each read once, when it is asked for.
class RunReader {
 public:
  explicit RunReader(fs::path folder) : folder_(std::move(folder)) {}

  RunResult read(const ResultSettings& result) {
    if (!result.report.empty()) return {report_value(report(result), result), ""};
    const RecordedHistory& history = history_of(result);
    return {fmt::format("{}", history_value(history, result)), column_of(history, result).unit};
  }

 private:
  const Json& report(const ResultSettings& result) {
    if (!report_.is_null()) return report_;
    try {
      report_ = Json::parse(
          geometry::read_regular_file(folder_ / "run.json", "the report of a run"), nullptr, false);
    } catch (const geometry::UnreadableFile& error) {
      refuse(result, error.what());
    }
    return report_;
  }

  const RecordedHistory& history_of(const ResultSettings& result) {
    const auto [found, is_new] = histories_.try_emplace(result.file);
    try {
      if (is_new) found->second = read_history(folder_ / result.file);
      found->second.file = result.file;
    } catch (const ViewError& error) {
      std::error_code ignored;
      refuse(result, fs::exists(folder_ / result.file, ignored)
                         ? error.what()
                         : fmt::format("the run has written no {}", result.file));
    }
    return found->second;
  }

  fs::path folder_;
  Json report_;
  std::map<std::string, RecordedHistory> histories_;
};

}  // namespace

std::string problem_with_report(std::string_view path) {
  return value_at(sketch_of_report(), path, true).problem;
}

std::string problem_with_column(const std::string& file, const std::string& column) {
  std::vector<std::string_view> names;
  if (file == kHistoryFile)
    for (const dynamics::OutputField& field : history_fields()) names.push_back(field.name);
  if (is_of_measure(file))
    for (const dynamics::OutputField& field : measure_fields()) names.push_back(field.name);
  if (names.empty()) return "";
  return std::find(names.begin(), names.end(), column) == names.end()
             ? no_column(file, column, names)
             : "";
}

std::string problem_with_file(const std::string& file) {
  std::vector<std::string_view> names(kHistories.begin(), kHistories.end());
  names.push_back(kContactsFile);
  if (is_of_measure(file) || std::find(names.begin(), names.end(), file) != names.end()) return "";
  // No measure has the name of a folder: what has is a way out of that of the run.
  if (fs::path(file).filename() != file || !file.ends_with(".csv"))
    return fmt::format(
        "got \"{}\"; expected a CSV file of the run, as in \"reactions.csv\" or "
        "\"{}/NAME.csv\", of a measure",
        file, kMeasuresFolder);
  return fmt::format("no run writes \"{}\"{}", file, did_you_mean(file, names));
}

std::vector<RunResult> results_of(const fs::path& folder,
                                  std::span<const ResultSettings> settings) {
  RunReader reader(folder);
  std::vector<RunResult> results;
  for (const ResultSettings& result : settings) results.push_back(reader.read(result));
  return results;
}

}  // namespace plekton::apps

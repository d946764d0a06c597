// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/study.hpp"

#include "apps/scenario/section.hpp"
#include "apps/scenario/toml_file.hpp"
#include "apps/study/run_results.hpp"
#include "apps/study/sobol.hpp"
#include "apps/study/value_text.hpp"
#include "apps/viewer/csv_text.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/base/regular_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>

namespace plekton::apps {
namespace {

/// Whether a text may be the path of a key in a scenario: the name of a table, in lower case, and
/// more behind a dot.
bool is_path(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) return false;
  const std::string_view table = text.substr(0, dot);
  return std::all_of(table.begin(), table.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; }) &&
         std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; });
}

/// Of a file that is no table of a study nothing is to be told.
bool has_paths(const std::vector<CsvRow>& rows) {
  return !rows.empty() && rows[0].problem.empty() &&
         std::all_of(rows[0].cells.begin(), rows[0].cells.end(), is_path);
}

namespace fs = std::filesystem;

constexpr std::size_t kMostRuns = 100'000;

/// A key with what it holds, its path put together of the keys above it.
struct Leaf {
  std::string path;
  const Value* value;
};

bool is_table(const Value& value) {
  return std::holds_alternative<Table>(value.data);
}

/// In a grid and in what is set everywhere a table only leads to further keys.
bool leads_further(const Value& value) {
  return is_table(value);
}

/// The range of a Sobol parameter is a table too.
bool leads_further_in_sobol(const Value& value) {
  const auto* table = std::get_if<Table>(&value.data);
  return table != nullptr && table->find("from") == nullptr && table->find("to") == nullptr;
}

/// `a.b = 1`, `"a.b" = 1` and `[x.a] b = 1` all name the path a.b.
std::vector<Leaf> leaves_of(const Table& table, const std::string& above,
                            bool (*leads)(const Value&)) {
  std::vector<Leaf> leaves;
  for (const Entry& entry : table.entries) {
    const std::string path = above.empty() ? entry.key : above + '.' + entry.key;
    if (!leads(entry.value)) {
      leaves.push_back({path, &entry.value});
      continue;
    }
    const auto below = leaves_of(std::get<Table>(entry.value.data), path, leads);
    leaves.insert(leaves.end(), below.begin(), below.end());
  }
  return leaves;
}

/// Reads a file of a study from its beginning to its end.
class StudyReader {
 public:
  StudyReader(const Table& table, const fs::path& file)
      : table_(table), root_(table, {file.string(), 1, 1}, "", problems_) {
    study_.file = file;
  }

  Study read() {
    refuse_scenario();
    study_.scenario = named_file(root_.text("scenario"), "scenario", "a scenario (.toml)");
    study_.jobs = static_cast<int>(root_.integer("jobs", 1, 1024, 0));
    study_.threads = static_cast<int>(root_.integer("threads", 1, 1024, 1));
    read_common();
    read_points();
    read_results();
    root_.finish();
    problems_.throw_if_any();
    return std::move(study_);
  }

 private:
  void refuse_scenario() {
    const auto* const simulation = table_.find("simulation");
    if (simulation == nullptr || table_.find("scenario") != nullptr) return;
    problems_.add(simulation->place,
                  "simulation: this file is a scenario; expected a study, which names one, or run "
                  "the scenario by `plekton run`");
    problems_.throw_if_any();
  }

  /// Relative to the folder of the study.
  fs::path named_file(const std::string& name, std::string_view key, std::string_view what) {
    if (name.empty()) return {};
    const fs::path path = study_.file.parent_path() / name;
    if (std::error_code ignored; !fs::is_regular_file(path, ignored))
      root_.complain(key, fmt::format("\"{}\" is no file; expected {}, its path from the folder of "
                                      "the study",
                                      name, what));
    return path;
  }

  void read_common() {
    if (!root_.table("set")) return;
    const Table& set = std::get<Table>(table_.find("set")->value.data);
    for (const Leaf& leaf : leaves_of(set, "", leads_further))
      study_.common.push_back(leaf.path + '=' + text_of_value(leaf));
  }

  std::string text_of_value(const Leaf& leaf) {
    if (std::holds_alternative<OtherKind>(leaf.value->data))
      problems_.add(leaf.value->place, fmt::format("{}: got {}; no key of a scenario takes that",
                                                   leaf.path, shown(*leaf.value)));
    return override_text(*leaf.value);
  }

  void read_points() {
    constexpr std::array<std::string_view, 3> kWays = {"grid", "sobol", "table"};
    const auto given =
        std::count_if(kWays.begin(), kWays.end(), [&](auto way) { return root_.has(way); });
    if (given != 1) {
      problems_.add(root_.place(), fmt::format("got {} of [grid], [sobol] and table; expected "
                                               "exactly one of them: it says which runs there are",
                                               given == 0 ? "none" : std::to_string(given)));
      return;
    }
    if (table_.find("grid") != nullptr) read_grid();
    if (table_.find("sobol") != nullptr) read_sobol();
    if (table_.find("table") != nullptr) read_table();
  }

  void add_parameter(const std::string& path, const Place& place) {
    const auto& known = study_.parameters;
    if (std::find(known.begin(), known.end(), path) != known.end())
      problems_.add(place, fmt::format("{}: is there twice; expected each path once", path));
    study_.parameters.push_back(path);
  }

  void refuse_count(const Place& place, const std::string& what) {
    problems_.add(place, fmt::format("{}; expected at most {} runs", what, kMostRuns));
  }

  /// Every combination, the last parameter changing fastest.
  void read_grid() {
    if (!root_.table("grid")) return;
    const Entry& grid = *table_.find("grid");
    study_.points = {{grid.place, {}}};
    for (const Leaf& leaf : leaves_of(std::get<Table>(grid.value.data), "", leads_further)) {
      add_parameter(leaf.path, leaf.value->place);
      const auto* values = std::get_if<Array>(&leaf.value->data);
      if (values == nullptr || values->empty()) {
        problems_.add(leaf.value->place, fmt::format("grid.{}: got {}; expected a list of values",
                                                     leaf.path, shown(*leaf.value)));
        continue;
      }
      if (study_.points.size() * values->size() > kMostRuns) {
        refuse_count(leaf.value->place, "grid: has too many combinations");
        return;
      }
      multiply(leaf.path, *values);
    }
    if (study_.parameters.empty())
      problems_.add(grid.place, "grid: is empty; expected paths with lists of values");
  }

  void multiply(const std::string& path, const Array& values) {
    std::vector<StudyPoint> points;
    for (const StudyPoint& before : study_.points) {
      for (const Value& value : values) {
        points.push_back(before);
        points.back().values.push_back(text_of_value({path, &value}));
      }
    }
    study_.points = std::move(points);
  }

  struct SobolRange {
    double from = 0.0;
    double to = 1.0;
    std::string unit;
    bool is_logarithmic = false;
    bool is_whole = false;

    /// @param u  in [0, 1)
    std::string at(double u) const {
      const double last = is_whole ? to + 1.0 : to;
      const double value =
          is_logarithmic ? from * elementary::pow(last / from, u) : from + u * (last - from);
      return is_whole ? whole_text_of({std::floor(value), unit}) : text_of({value, unit});
    }
  };

  void read_sobol() {
    auto sobol = root_.table("sobol");
    if (!sobol) return;
    const auto runs =
        static_cast<std::size_t>(sobol->integer("runs", 1, static_cast<std::int64_t>(kMostRuns)));
    std::vector<SobolRange> ranges;
    if (!sobol->has("parameters")) {
      problems_.add(sobol->place(),
                    "sobol.parameters: missing; expected a table of paths with "
                    "ranges, { from = ..., to = ... }");
    } else if (sobol->table("parameters")) {
      const Table& table = std::get<Table>(table_.find("sobol")->value.data);
      const Entry& parameters = *table.find("parameters");
      for (const Leaf& leaf :
           leaves_of(std::get<Table>(parameters.value.data), "", leads_further_in_sobol)) {
        add_parameter(leaf.path, leaf.value->place);
        ranges.push_back(read_range(leaf));
      }
      if (ranges.empty() || ranges.size() > kMostSobolParameters)
        problems_.add(parameters.place,
                      fmt::format("sobol.parameters: got {}; expected 1 to {} paths", ranges.size(),
                                  kMostSobolParameters));
    }
    sobol->finish();
    if (problems_.empty()) sample(ranges, runs, sobol->place());
  }

  void sample(const std::vector<SobolRange>& ranges, std::size_t runs, const Place& place) {
    for (const std::vector<double>& u : sobol_points(runs, ranges.size())) {
      StudyPoint point{place, {}};
      for (std::size_t i = 0; i < ranges.size(); ++i) point.values.push_back(ranges[i].at(u[i]));
      study_.points.push_back(std::move(point));
    }
  }

  SobolRange read_range(const Leaf& leaf) {
    const std::string path = "sobol.parameters." + leaf.path;
    const auto* table = std::get_if<Table>(&leaf.value->data);
    if (table == nullptr) {
      problems_.add(
          leaf.value->place,
          fmt::format("{}: got {}; expected {{ from = ..., to = ... }}", path, shown(*leaf.value)));
      return {};
    }
    Section section(*table, leaf.value->place, path, problems_);
    constexpr std::array<std::string_view, 2> kScales = {"linear", "log"};
    SobolRange range;
    range.is_logarithmic = section.choice("scale", kScales, std::size_t{0}) == 1;
    range.is_whole = section.truth("whole", false);
    const NumberWithUnit from = end_of_range(section, *table, "from");
    const NumberWithUnit to = end_of_range(section, *table, "to");
    section.finish();
    range.from = from.number;
    range.to = to.number;
    range.unit = from.unit;
    if (from.unit != to.unit)
      section.complain("to", fmt::format("is in \"{}\", but from in \"{}\"; expected the same unit",
                                         to.unit, from.unit));
    if (!(from.number < to.number)) section.complain("to", "expected more than from");
    if (range.is_logarithmic && !(from.number > 0.0))
      section.complain("from", "expected more than 0, since the scale is logarithmic");
    if (range.is_whole &&
        (from.number != std::floor(from.number) || to.number != std::floor(to.number)))
      section.complain("whole", "expected whole numbers for from and to");
    return range;
  }

  NumberWithUnit end_of_range(Section& section, const Table& table, std::string_view key) {
    const Entry* entry = section.has(key) ? table.find(key) : nullptr;
    if (entry == nullptr) {
      section.complain(key, "missing; expected a number, with its unit");
    } else if (const auto number = number_with_unit(entry->value)) {
      return *number;
    } else {
      section.complain(key,
                       fmt::format("got {}; expected a number, with its unit, as in \"20 deg\"",
                                   shown(entry->value)));
    }
    return key == "from" ? NumberWithUnit{1.0, ""} : NumberWithUnit{2.0, ""};
  }

  void read_table() {
    const fs::path path = named_file(root_.text("table"), "table", "a table (.csv)");
    if (!problems_.empty() || path.empty()) return;
    std::vector<CsvRow> rows;
    try {
      rows = parse_csv(geometry::read_regular_file(path, "a table (.csv)"));
    } catch (const geometry::UnreadableFile& error) {
      root_.complain("table", error.what());
      return;
    }
    if (!has_paths(rows)) {
      root_.complain("table", fmt::format("the first row of {} is not one of paths, as in "
                                          "simulation.duration,grains.sand.count",
                                          path.string()));
      return;
    }
    // What is wrong with a quote may have changed how many rows and cells there are.
    for (const CsvRow& row : rows)
      if (!row.problem.empty()) problems_.add({path.string(), row.line, 1}, row.problem);
    if (!problems_.empty()) return;
    if (rows.size() < 2 || rows.size() - 1 > kMostRuns) {
      root_.complain("table", fmt::format("{} has {} rows; expected a row of paths, and below it a "
                                          "row for each of at most {} runs",
                                          path.string(), rows.size(), kMostRuns));
      return;
    }
    for (const std::string& head : rows[0].cells)
      add_parameter(head, {path.string(), rows[0].line, 1});
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const Place place{path.string(), rows[i].line, 1};
      if (rows[i].cells.size() != study_.parameters.size())
        problems_.add(place, fmt::format("got {} cells; expected {}, as many as there are paths in "
                                         "the first row",
                                         rows[i].cells.size(), study_.parameters.size()));
      study_.points.push_back({place, std::move(rows[i].cells)});
    }
  }

  void read_results() {
    auto results = root_.table("results");
    if (!results) {
      if (!root_.has("results"))
        problems_.add(root_.place(),
                      "results: missing; expected a table [results] that says what "
                      "is wanted of each run");
      return;
    }
    for (auto& [name, section] : results->all_tables()) {
      if (const std::string problem = problem_with_name(name); !problem.empty())
        problems_.add(section.place(), fmt::format("results.{}: {}", name, problem));
      refuse_second_column(name, section.place());
      study_.results.push_back(read_result(name, section));
    }
    if (study_.results.empty() && problems_.empty())
      problems_.add(results->place(),
                    "results: is empty; expected what is wanted of each run, as "
                    "in steps = { report = \"timing.steps\" }");
  }

  /// No two columns of results.csv have one name.
  void refuse_second_column(const std::string& name, const Place& place) {
    constexpr std::array<std::string_view, 4> kOfEveryStudy = {"run", "status", "problem", "key"};
    const auto is_among = [&](const auto& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const std::string_view taken_by = is_among(kOfEveryStudy)       ? "every results.csv has"
                                      : is_among(study_.parameters) ? "is of a parameter"
                                                                    : "";
    if (!taken_by.empty())
      problems_.add(place, fmt::format("results.{}: got the name of a column that {}; expected "
                                       "another one",
                                       name, taken_by));
  }

  static void complain_if(Section& section, std::string_view key, const std::string& problem) {
    if (!problem.empty()) section.complain(key, problem);
  }

  ResultSettings read_result(const std::string& name, Section& section) {
    constexpr std::array<std::string_view, 6> kTakes = {"last", "first", "max",
                                                        "min",  "mean",  "change"};
    constexpr Quantity kMoment{kTime, kNotNegative};
    ResultSettings result;
    result.name = name;
    result.place = section.place();
    if (section.has("report")) {
      result.report = section.text("report");
      complain_if(section, "report", problem_with_report(result.report));
      section.finish();
      return result;
    }
    result.file = section.text("file", "energy.csv");
    complain_if(section, "file", problem_with_file(result.file));
    result.column = section.text("column");
    if (!result.column.empty())
      complain_if(section, "column", problem_with_column(result.file, result.column));
    result.take = static_cast<Take>(section.choice("take", kTakes, std::size_t{0}));
    if (section.has("at")) result.at = section.quantity("at", kMoment);
    if (section.has("from")) result.from = section.quantity("from", kMoment);
    if (section.has("to")) result.to = section.quantity("to", kMoment);
    if (result.at && (result.from || result.to || section.has("take")))
      section.complain("at", "is a value at one time; take, from and to do not go with it");
    if (result.from && result.to && !(*result.from <= *result.to))
      section.complain("to", "expected a time that is not before from");
    section.finish();
    return result;
  }

  const Table& table_;
  Problems problems_;
  Section root_;
  Study study_;
};

}  // namespace

std::vector<std::string> overrides_of(const Study& study, std::size_t point) {
  std::vector<std::string> overrides = study.common;
  const std::vector<std::string>& values = study.points[point].values;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].empty()) overrides.push_back(study.parameters[i] + '=' + values[i]);
  return overrides;
}

Study read_study(const fs::path& file) {
  std::string text;
  try {
    text = geometry::read_regular_file(file, "a study (.toml)");
  } catch (const geometry::UnreadableFile& error) {
    throw InputError(error.what());
  }
  const Table table = parse_toml(text, file.string());
  return StudyReader(table, file).read();
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/plot.hpp"

#include "apps/pictures/drawn_rows.hpp"
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plekton::apps {
namespace {

bool is_whole(double value) {
  return !std::isfinite(value) || value == std::floor(value);
}

/// What the axis of a column without a unit says: the end of its name without the component, so that
/// "top.fabric_xx" and "top.fabric_xy" share one.
std::string quantity_without_unit(const RecordedHistory::Column& column) {
  if (std::all_of(column.values.begin(), column.values.end(), is_whole)) return "number";
  std::string name = column.name.substr(column.name.rfind('.') + 1);
  const std::size_t component = name.find_last_not_of("xyz");
  if (component != std::string::npos && component > 0 && component + 1 < name.size() &&
      name[component] == '_')
    name.resize(component);
  return name;
}

/// What columns of a unit tell whose names have a word; an empty word is in every name.
struct Quantity {
  std::string_view unit;
  std::string_view word;
  std::string_view name;
};

/// What a column of a history tells, with its unit.
std::string quantity_of(const RecordedHistory::Column& column) {
  constexpr std::array<Quantity, 12> kQuantities = {{{"J", "", "energy"},
                                                     {"N", "", "force"},
                                                     {"N m", "", "moment"},
                                                     {"m", "slip", "slip"},
                                                     {"m", "radius", "radius"},
                                                     {"m", "", "position"},
                                                     {"m/s", "", "velocity"},
                                                     {"rad/s", "", "angular velocity"},
                                                     {"s", "", "time"},
                                                     {"Pa", "stress", "stress"},
                                                     {"Pa", "", "pressure"},
                                                     {"m3", "", "volume"}}};
  const std::string& unit = column.unit;
  if (unit.empty()) return quantity_without_unit(column);
  // What is before the dot is a name of the user's.
  const std::string_view name = std::string_view(column.name).substr(column.name.rfind('.') + 1);
  for (const Quantity& quantity : kQuantities)
    if (quantity.unit == unit && name.find(quantity.word) != std::string_view::npos)
      return fmt::format("{} ({})", quantity.name, unit);
  return fmt::format("value ({})", unit);
}

/// Most planes stand where they are.
bool is_drawn_unasked(const RecordedHistory& history, const RecordedHistory::Column& column) {
  if (column.name == "time_step") return false;
  const bool is_of_planes = history.file == kPlanesFile;
  const auto& values = column.values;
  const auto first =
      std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  return std::any_of(first, values.end(), [&](double value) {
    return std::isfinite(value) && value != (is_of_planes ? *first : 0.0);
  });
}

/// All columns but the time.
std::span<const RecordedHistory::Column> columns_of(const RecordedHistory& history) {
  return std::span(history.columns).subspan(1);
}

std::string head_of(const RecordedHistory::Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{} ({})", column.name, column.unit);
}

std::vector<std::string_view> known_names(const std::vector<RecordedHistory>& histories) {
  std::vector<std::string_view> known;
  for (const RecordedHistory& history : histories)
    for (const RecordedHistory::Column& column : columns_of(history)) known.push_back(column.name);
  return known;
}

/// The first of the names in a text, with commas between them.
std::string_view first_name(std::string_view text, const std::vector<std::string_view>& known) {
  std::string_view longest;
  for (const std::string_view name : known) {
    if (!text.starts_with(name) || name.size() <= longest.size()) continue;
    if (name.size() == text.size() || text[name.size()] == ',') longest = name;
  }
  return longest.empty() ? text.substr(0, text.find(',')) : longest;
}

void require_known(const std::vector<RecordedHistory>& histories, std::string_view option,
                   std::span<const std::string> names) {
  const std::vector<std::string_view> known = known_names(histories);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string hint = did_you_mean(name, known);
    throw InputError(
        fmt::format("{}: no history of the run has a column \"{}\"{}", option, name,
                    hint.empty() ? fmt::format("; there are {}", fmt::join(known, ", ")) : hint));
  }
}

const RecordedHistory::Column* find_column(const RecordedHistory& history,
                                           const std::string& name) {
  const auto columns = columns_of(history);
  const auto found = std::ranges::find(columns, name, &RecordedHistory::Column::name);
  return found == columns.end() ? nullptr : &*found;
}

/// Whether there is anything to draw: gnuplot fails on a panel without a point.
bool has_point(const std::vector<double>& x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < y.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) return true;
  return false;
}

PlotPanel& panel_of(std::vector<PlotPanel>& panels, const RecordedHistory& history,
                    const std::string& quantity, const RecordedHistory::Column& x) {
  const auto found = std::find_if(panels.begin(), panels.end(), [&](const PlotPanel& panel) {
    return panel.file == history.file && panel.quantity == quantity;
  });
  if (found != panels.end()) return *found;
  return panels.emplace_back(PlotPanel{quantity, history.file, head_of(x), x.values, {}});
}

/// As gnuplot reads it as it is. Column heads and names of folders have no line breaks in them but
/// could come to have.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '\'';
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN";
}

std::string data_block(const std::string& name, const PlotPanel& panel,
                       const std::vector<double>& values) {
  constexpr std::size_t kMost = 4000;  // four times the pixels of a picture
  std::string text = fmt::format("${} << END\n", name);
  for (const std::size_t row : drawn_rows(panel.x, values, kMost))
    text += fmt::format("{} {}\n", number(panel.x[row]), number(values[row]));
  return text + "END\n";
}

std::string panel_commands(const PlotPanel& panel, std::size_t number) {
  constexpr std::size_t kColours = 8;  // of gnuplot; more curves are told apart by their dashes
  std::string data;
  std::string curves;
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    const std::string name = fmt::format("curve_{}_{}", number, i);
    data += data_block(name, panel, panel.columns[i]->values);
    curves +=
        fmt::format("{}${} using 1:2 with lines linewidth 1.5 dashtype {} title {}",
                    i > 0 ? ", " : "", name, 1 + i / kColours, quoted(panel.columns[i]->name));
  }
  return fmt::format("{}set title {}\nset xlabel {}\nset ylabel {}\nplot {}\n", data,
                     quoted(panel.file), quoted(panel.x_head), quoted(panel.quantity), curves);
}

bool is_in(const PlotPanel& panel, const std::string& name) {
  return std::ranges::any_of(panel.columns,
                             [&](const auto* column) { return column->name == name; });
}

const std::string& file_with(const std::vector<RecordedHistory>& histories,
                             const std::string& name) {
  return std::ranges::find_if(
             histories,
             [&](const RecordedHistory& history) { return find_column(history, name) != nullptr; })
      ->file;
}

/// Why a column is in no panel: rows of different files are of different times.
/// @param x  as panels_of() has it; one that some history has
std::string problem_with(const std::string& name, const std::string& x,
                         const std::vector<RecordedHistory>& histories) {
  const bool is_beside =
      x.empty() || std::ranges::any_of(histories, [&](const auto& history) {
        return find_column(history, name) != nullptr && find_column(history, x) != nullptr;
      });
  if (is_beside) return fmt::format("\"{}\" has no finite value to draw; leave it out", name);
  return fmt::format(
      "\"{}\" is in {} and cannot be drawn over \"{}\" (--x), which is in {}; name columns of one "
      "file",
      name, file_with(histories, name), x, file_with(histories, x));
}

}  // namespace

std::vector<std::string> column_names_in(std::span<const std::string> texts,
                                         const std::vector<RecordedHistory>& histories) {
  const std::vector<std::string_view> known = known_names(histories);
  std::vector<std::string> names;
  for (std::string_view text : texts) {
    while (!text.empty()) {
      const std::string_view name = first_name(text, known);
      names.emplace_back(name);
      text.remove_prefix(std::min(name.size() + 1, text.size()));
    }
  }
  return names;
}

std::vector<PlotPanel> panels_of(const std::vector<RecordedHistory>& histories,
                                 std::span<const std::string> names, const std::string& x) {
  require_known(histories, "--columns", names);
  if (!x.empty()) require_known(histories, "--x", std::span(&x, 1));
  std::vector<PlotPanel> panels;
  for (const RecordedHistory& history : histories) {
    const RecordedHistory::Column* const along =
        x.empty() ? &history.columns.front() : find_column(history, x);
    if (along == nullptr) continue;
    for (const RecordedHistory::Column& column : columns_of(history)) {
      const bool is_drawn = names.empty()
                                ? is_drawn_unasked(history, column) && &column != along
                                : std::find(names.begin(), names.end(), column.name) != names.end();
      if (!is_drawn || !has_point(along->values, column.values)) continue;
      panel_of(panels, history, quantity_of(column), *along).columns.push_back(&column);
    }
  }
  for (const std::string& name : names)
    if (std::ranges::none_of(panels, [&](const PlotPanel& panel) { return is_in(panel, name); }))
      throw InputError("--columns: " + problem_with(name, x, histories));
  if (panels.empty())
    throw InputError(
        "plot: the run has no history with a value that is not 0; see [output] "
        "history_interval, or name columns with --columns");
  return panels;
}

std::string gnuplot_script(const std::vector<PlotPanel>& panels, const std::string& title,
                           PictureKind kind, const std::string& output) {
  constexpr int kWidth = 900;        // pixels
  constexpr int kPanelHeight = 340;  // pixels
  constexpr int kHighest = 32'000;   // pixels; cairo draws no picture of 32768
  const int height = std::min(kPanelHeight * static_cast<int>(panels.size()) + 40, kHighest);
  const std::string size = fmt::format("size {},{}", kWidth, height);
  std::string script = "set encoding utf8\n";
  script +=
      kind == PictureKind::svg
          ? fmt::format("set terminal svg {} noenhanced font 'sans,12' background 'white'\n", size)
          : fmt::format("set terminal pngcairo {} noenhanced font 'sans,11' background 'white'\n",
                        size);
  script += fmt::format(
      "set output {}\n"
      "set multiplot layout {},1 title {} noenhanced\n"
      "set grid\n"
      "set key outside right top noenhanced\n",
      quoted(output), panels.size(), quoted(title));
  for (std::size_t i = 0; i < panels.size(); ++i) script += panel_commands(panels[i], i);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace plekton::apps

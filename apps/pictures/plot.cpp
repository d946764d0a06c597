// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/plot.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plekton::apps {
namespace {

/// What is measured in a unit, in the histories of a run.
std::string quantity_in(const std::string& unit) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kQuantities = {
      {{"J", "energy"},
       {"N", "force"},
       {"N m", "moment"},
       {"m", "position"},
       {"s", "time"},
       {"Pa", "pressure"},
       {"m3", "volume"}}};
  if (unit.empty()) return "number";
  for (const auto& [symbol, name] : kQuantities)
    if (symbol == unit) return fmt::format("{} ({})", name, unit);
  return fmt::format("value ({})", unit);
}

bool is_drawn_unasked(const History::Column& column) {
  return !column.unit.empty() && column.name != "time_step" &&
         std::any_of(column.values.begin(), column.values.end(),
                     [](double value) { return std::isfinite(value) && value != 0.0; });
}

/// All columns but the time.
std::span<const History::Column> columns_of(const History& history) {
  return std::span(history.columns).subspan(1);
}

void require_known(const std::vector<History>& histories, std::span<const std::string> names) {
  std::vector<std::string_view> known;
  for (const History& history : histories)
    for (const History::Column& column : columns_of(history)) known.push_back(column.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string hint = did_you_mean(name, known);
    throw InputError(
        fmt::format("--columns: no history of the run has a column \"{}\"{}", name,
                    hint.empty() ? fmt::format("; there are {}", fmt::join(known, ", ")) : hint));
  }
}

PlotPanel& panel_of(std::vector<PlotPanel>& panels, const History& history,
                    const std::string& quantity) {
  const auto found = std::find_if(panels.begin(), panels.end(), [&](const PlotPanel& panel) {
    return panel.file == history.file && panel.quantity == quantity;
  });
  if (found != panels.end()) return *found;
  return panels.emplace_back(PlotPanel{quantity, history.file, history.columns.front().values, {}});
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

/// The rows that are drawn: all, or of many the least and the greatest of every few, so that no peak
/// is lost.
std::vector<std::size_t> rows_drawn(const std::vector<double>& values) {
  constexpr std::size_t kMost = 4000;  // twice the pixels of a wide picture
  std::vector<std::size_t> rows;
  const std::size_t few = std::max<std::size_t>(1, 2 * values.size() / kMost);
  for (std::size_t begin = 0; begin < values.size(); begin += few) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        values.begin() + static_cast<std::ptrdiff_t>(std::min(begin + few, values.size()));
    const auto [low, high] = std::minmax_element(first, last);
    auto a = static_cast<std::size_t>(low - values.begin());
    auto b = static_cast<std::size_t>(high - values.begin());
    if (a > b) std::swap(a, b);
    rows.push_back(a);
    if (a != b) rows.push_back(b);
  }
  return rows;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN";
}

std::string data_block(const std::string& name, const PlotPanel& panel,
                       const std::vector<double>& values) {
  std::string text = fmt::format("${} << END\n", name);
  for (const std::size_t row : rows_drawn(values))
    text += fmt::format("{} {}\n", number(panel.times[row]), number(values[row]));
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
  return fmt::format("{}set title {}\nset ylabel {}\nplot {}\n", data, quoted(panel.file),
                     quoted(panel.quantity), curves);
}

}  // namespace

std::vector<PlotPanel> panels_of(const std::vector<History>& histories,
                                 std::span<const std::string> names) {
  require_known(histories, names);
  std::vector<PlotPanel> panels;
  for (const History& history : histories) {
    for (const History::Column& column : columns_of(history)) {
      const bool is_drawn = names.empty()
                                ? is_drawn_unasked(column)
                                : std::find(names.begin(), names.end(), column.name) != names.end();
      if (is_drawn) panel_of(panels, history, quantity_in(column.unit)).columns.push_back(&column);
    }
  }
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
  const std::string size =
      fmt::format("size {},{}", kWidth, kPanelHeight * static_cast<int>(panels.size()) + 40);
  std::string script = "set encoding utf8\n";
  script +=
      kind == PictureKind::svg
          ? fmt::format("set terminal svg {} noenhanced font 'sans,12' background 'white'\n", size)
          : fmt::format("set terminal pngcairo {} noenhanced font 'sans,11' background 'white'\n",
                        size);
  script += fmt::format(
      "set output {}\n"
      "set multiplot layout {},1 title {} noenhanced\n"
      "set xlabel 'time (s)'\n"
      "set grid\n"
      "set key outside right top noenhanced\n",
      quoted(output), panels.size(), quoted(title));
  for (std::size_t i = 0; i < panels.size(); ++i) script += panel_commands(panels[i], i);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace plekton::apps

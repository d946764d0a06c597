// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/grain_table.hpp"

#include "apps/scenario/byte_order_mark.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/units.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/regular_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace plekton::apps {
namespace {

constexpr std::size_t kColumns = 4;
constexpr std::array<std::string_view, kColumns> kNames = {"x", "y", "z", "r"};
constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();

std::string_view bare(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\"";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view row) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = row.find(',');
    cells.push_back(bare(row.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    row.remove_prefix(comma + 1);
  }
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Where a quantity stands in a row, and what one of it is in m.
struct Column {
  std::size_t place = kMissing;
  double unit = 1.0;
};
using Columns = std::array<Column, kColumns>;

/// What a message shows of a file: the beginning of the word at fault.
std::string shown_cell(std::string_view cell) {
  constexpr std::size_t kMost = 24;
  return geometry::printable(std::string(cell.substr(0, kMost)));
}

/// @throws InputError
Columns columns_of(const std::vector<std::string_view>& head, const std::string& where) {
  Columns columns;
  for (std::size_t place = 0; place < head.size(); ++place) {
    const std::size_t bracket = head[place].find('(');
    std::string_view name = bare(head[place].substr(0, bracket));
    if (name == "radius") name = "r";
    for (std::size_t k = 0; k < kColumns; ++k) {
      if (name != kNames[k]) continue;
      if (columns[k].place != kMissing)
        throw InputError(fmt::format("{}: two columns are called {}; expected one", where, name));
      columns[k].place = place;
      if (bracket == std::string_view::npos) continue;
      const std::string_view unit =
          head[place].substr(bracket + 1, head[place].find(')') - bracket - 1);
      try {
        columns[k].unit = parse_quantity("1 " + std::string(unit), kLength);
      } catch (const UnitError& error) {
        throw InputError(fmt::format("{}: column {}: {}", where, name, error.what()));
      }
    }
  }
  for (std::size_t k = 0; k < kColumns; ++k) {
    if (columns[k].place == kMissing)
      throw InputError(
          fmt::format("{}: no column is called {}; expected a head row with x, y, z and r, as in "
                      "\"x (mm),y (mm),z (mm),r (mm)\", or rows of four numbers in m",
                      where, kNames[k]));
  }
  return columns;
}

/// @throws InputError
std::array<double, kColumns> numbers_in(const std::vector<std::string_view>& cells,
                                        const Columns& columns, const std::string& where) {
  std::array<double, kColumns> numbers{};
  for (std::size_t k = 0; k < kColumns; ++k) {
    const std::size_t place = columns[k].place;
    if (place >= cells.size())
      throw InputError(fmt::format("{}: got {} columns; expected {}, with {} in the last of them",
                                   where, cells.size(), place + 1, kNames[k]));
    const auto number = number_in(cells[place]);
    if (!number)
      throw InputError(fmt::format("{}: {} is \"{}\"; expected a number", where, kNames[k],
                                   shown_cell(cells[place])));
    numbers[k] = *number * columns[k].unit;
  }
  if (!(numbers[3] > 0.0))
    throw InputError(fmt::format("{}: r is {} m; expected a radius above 0", where, numbers[3]));
  return numbers;
}

}  // namespace

GrainTable parse_grain_table(std::string_view text, const std::string& source) {
  text = without_byte_order_mark(text);
  GrainTable table;
  std::optional<Columns> columns;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (bare(row).empty() || bare(row)[0] == '#') continue;
    const std::string where = fmt::format("{}: row {}", source, line);
    const std::vector<std::string_view> cells = cells_of(row);
    if (!columns && !number_in(cells[0])) {
      columns = columns_of(cells, where);
      continue;
    }
    if (!columns) {
      columns.emplace();
      for (std::size_t k = 0; k < kColumns; ++k) (*columns)[k].place = k;
    }
    const auto numbers = numbers_in(cells, *columns, where);
    table.centres.emplace_back(numbers[0], numbers[1], numbers[2]);
    table.radii.push_back(numbers[3]);
  }
  if (table.centres.empty())
    throw InputError(
        fmt::format("{}: has no row of numbers; expected x,y,z,r of each grain", source));
  return table;
}

GrainTable read_grain_table(const std::filesystem::path& file) {
  try {
    return parse_grain_table(geometry::read_regular_file(file, "grains (.csv)"), file.string());
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace plekton::apps

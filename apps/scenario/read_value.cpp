// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_value.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace plekton::apps {
namespace {

/// The number of a value that is one, without its unit.
std::optional<double> plain_number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&value.data)) return *number;
  return std::nullopt;
}

/// As in "[0, 1, 1]", of a short list.
std::string items_shown(const Value& value) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr || array->size() > 4) return shown(value);
  std::string text;
  for (const Value& item : *array) text += (text.empty() ? "" : ", ") + shown(item);
  return fmt::format("[{}]", text);
}

}  // namespace

double read_quantity(const Value& value, const std::string& path, const Quantity& expected,
                     Problems& problems) {
  const auto problem = [&](const std::string& what) {
    problems.add(value.place, fmt::format("{}: {}", path, what));
    return kUnread;
  };
  const Dimension& dimension = expected.dimension;
  const std::optional<double> plain = plain_number(value);
  double number = plain.value_or(kUnread);
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    try {
      number = parse_quantity(*text, dimension);
    } catch (const UnitError& error) {
      return problem(error.what());
    }
  } else if (!plain) {
    return problem(
        fmt::format("got {}; expected {} ({})", shown(value), dimension.name, dimension.units));
  }
  if (!std::isfinite(number))
    return problem(fmt::format("got {}; expected {}, finite", shown(value), dimension.name));
  if (expected.range.holds(number)) return number;
  const bool degrees =
      plain &&
      dimension.powers == kAngle.powers;  // a number alone is in rad, seldom what was meant
  return problem(fmt::format("got {}{}; expected {}{}{}", shown(value), degrees ? " rad" : "",
                             dimension.name, expected.range.text,
                             degrees ? fmt::format("; did you mean \"{} deg\"?", number) : ""));
}

std::vector<double> read_quantities(const Value& value, const std::string& path,
                                    const Quantity& expected, std::optional<std::size_t> count,
                                    Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  const std::size_t before = problems.count();
  if (array == nullptr || (count && array->size() != *count))
    problems.add(value.place, fmt::format("{}: got {}; expected a list{}", path, shown(value),
                                          count ? fmt::format(" of {}", *count) : ""));
  std::vector<double> numbers;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    numbers.push_back(
        read_quantity((*array)[i], fmt::format("{}[{}]", path, i), expected, problems));
  return problems.count() == before ? numbers : std::vector<double>{};
}

geometry::Vec3 read_vector(const Value& value, const std::string& path, const Quantity& expected,
                           Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr || array->size() != 3) {
    problems.add(value.place,
                 fmt::format("{}: got {}; expected a list of three components, x, y and z", path,
                             shown(value)));
    return geometry::Vec3::Constant(kUnread);
  }
  geometry::Vec3 vector;
  for (std::size_t i = 0; i < 3; ++i) {
    vector[static_cast<Eigen::Index>(i)] =
        read_quantity((*array)[i], fmt::format("{}[{}]", path, i), expected, problems);
  }
  return vector;
}

std::vector<geometry::Vec3> read_vectors(const Value& value, const std::string& path,
                                         const Quantity& expected, std::size_t least,
                                         Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  const std::size_t before = problems.count();
  if (array == nullptr || array->size() < least)
    problems.add(value.place,
                 fmt::format("{}: got {}; expected a list of at least {} vectors, [[x, y, z], ...]",
                             path, shown(value), least));
  std::vector<geometry::Vec3> vectors;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    vectors.push_back(read_vector((*array)[i], fmt::format("{}[{}]", path, i), expected, problems));
  return problems.count() == before ? vectors : std::vector<geometry::Vec3>{};
}

std::vector<std::array<double, 2>> read_rising_rows(const Value& value, const std::string& path,
                                                    const Quantity& first, const Quantity& second,
                                                    Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  const std::size_t before = problems.count();
  if (array == nullptr || array->empty())
    problems.add(value.place, fmt::format("{}: got {}; expected a list of pairs, [[..., ...], ...]",
                                          path, shown(value)));
  std::vector<std::array<double, 2>> rows;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const Value& row = (*array)[i];
    const std::string row_path = fmt::format("{}[{}]", path, i);
    const auto* pair = std::get_if<Array>(&row.data);
    if (pair == nullptr || pair->size() != 2) {
      problems.add(row.place, fmt::format("{}: got {}; expected a pair, [{}, {}]", row_path,
                                          shown(row), first.dimension.name, second.dimension.name));
      continue;
    }
    rows.push_back({read_quantity((*pair)[0], row_path + "[0]", first, problems),
                    read_quantity((*pair)[1], row_path + "[1]", second, problems)});
    if (rows.size() < 2 || !(rows.back()[0] <= rows[rows.size() - 2][0])) continue;
    const std::string unit =
        first.dimension.si_unit.empty() ? "" : fmt::format(" {}", first.dimension.si_unit);
    problems.add(row.place,
                 fmt::format("{}: {}{} is not above {}{} of the row before; list the rows by "
                             "increasing {}",
                             row_path, rows.back()[0], unit, rows[rows.size() - 2][0], unit,
                             first.dimension.name.substr(first.dimension.name.find(' ') + 1)));
  }
  return problems.count() == before ? rows : std::vector<std::array<double, 2>>{};
}

std::optional<std::int64_t> read_whole_number(const Value& value, const std::string& path,
                                              std::int64_t low, std::int64_t high,
                                              Problems& problems) {
  const auto* number = std::get_if<std::int64_t>(&value.data);
  if (number && *number >= low && *number <= high) return *number;
  const auto* real = std::get_if<double>(&value.data);
  const bool is_whole = real != nullptr && std::floor(*real) == *real;
  problems.add(
      value.place,
      fmt::format("{}: got {}{}; expected a whole number from {} to {}", path, shown(value),
                  is_whole ? " with a decimal point or an exponent" : "", low, high));
  return std::nullopt;
}

std::vector<int> read_whole_numbers(const Value& value, const std::string& path,
                                    const std::vector<int>& least, int most, Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr || array->size() != least.size()) {
    problems.add(value.place, fmt::format("{}: got {}; expected a list of {} whole numbers", path,
                                          shown(value), least.size()));
    return least;
  }
  std::vector<int> numbers = least;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Value& item = (*array)[i];
    const auto* number = std::get_if<std::int64_t>(&item.data);
    if (number && *number >= least[i] && *number <= most)
      numbers[i] = static_cast<int>(*number);
    else
      problems.add(item.place, fmt::format("{}[{}]: got {}; expected a whole number from {} to {}",
                                           path, i, shown(item), least[i], most));
  }
  return numbers;
}

std::vector<std::int32_t> read_places(const Value& value, const std::string& path,
                                      std::size_t columns, std::size_t size, Problems& problems) {
  const auto* rows = std::get_if<Array>(&value.data);
  const std::size_t before = problems.count();
  if (rows == nullptr || rows->empty())
    problems.add(value.place,
                 fmt::format("{}: got {}; expected a list of lists of {} whole numbers", path,
                             shown(value), columns));
  std::vector<std::int32_t> places;
  for (std::size_t i = 0; rows != nullptr && i < rows->size(); ++i) {
    const Value& row = (*rows)[i];
    const auto* array = std::get_if<Array>(&row.data);
    bool fits = array != nullptr && array->size() == columns;
    for (std::size_t k = 0; fits && k < columns; ++k) {
      const auto* place = std::get_if<std::int64_t>(&(*array)[k].data);
      fits = place != nullptr && *place >= 0 && static_cast<std::size_t>(*place) < size;
      for (std::size_t other = 0; fits && other < k; ++other)
        fits = places[places.size() - 1 - other] != *place;
      if (fits) places.push_back(static_cast<std::int32_t>(*place));
    }
    if (!fits)
      problems.add(row.place, fmt::format("{}[{}]: got {}; expected {} different whole numbers "
                                          "from 0 to {}",
                                          path, i, items_shown(row), columns,
                                          static_cast<std::int64_t>(size) - 1));
  }
  return problems.count() == before ? places : std::vector<std::int32_t>{};
}

std::optional<bool> read_truth(const Value& value, const std::string& path, Problems& problems) {
  if (const auto* truth = std::get_if<bool>(&value.data)) return *truth;
  problems.add(value.place, fmt::format("{}: got {}; expected true or false", path, shown(value)));
  return std::nullopt;
}

std::string read_text(const Value& value, const std::string& path, Problems& problems) {
  const auto* text = std::get_if<std::string>(&value.data);
  if (text && !text->empty()) return *text;
  problems.add(value.place,
               fmt::format("{}: got {}; expected a text in quotes, not empty", path, shown(value)));
  return "";
}

std::vector<std::string> read_texts(const Value& value, const std::string& path,
                                    Problems& problems) {
  const auto* array = std::get_if<Array>(&value.data);
  std::vector<std::string> texts;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const auto* text = std::get_if<std::string>(&(*array)[i].data);
    if (text != nullptr && !text->empty()) texts.push_back(*text);
  }
  if (array != nullptr && texts.size() == array->size() && !texts.empty()) return texts;
  problems.add(value.place,
               fmt::format("{}: got {}; expected a list of texts in quotes", path, shown(value)));
  return {};
}

std::optional<std::size_t> read_word(const Value& value, const std::string& path,
                                     std::span<const std::string_view> words, Problems& problems) {
  const auto* text = std::get_if<std::string>(&value.data);
  const auto found = text ? std::find(words.begin(), words.end(), *text) : words.end();
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  problems.add(value.place, fmt::format("{}: got {}; expected one of {}{}", path, shown(value),
                                        listed(words), text ? did_you_mean(*text, words) : ""));
  return std::nullopt;
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace plekton::apps {
namespace {

using Kind = ValueType::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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

double Section::read_quantity(const Value& value, const std::string& path,
                              const Quantity& expected) {
  const auto problem = [&](const std::string& what) {
    problems_->add(value.place, fmt::format("{}: {}", path, what));
    return kNaN;
  };
  const Dimension& dimension = expected.dimension;
  const std::optional<double> plain = plain_number(value);
  double number = plain.value_or(kNaN);
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
double Section::quantity(std::string_view key, const Quantity& expected) {
  if (records(key, ValueType::of(Kind::quantity, expected), {})) return kNaN;
  const Value* value = require(key);
  return value ? read_quantity(*value, path_of(key), expected) : kNaN;
}

double Section::quantity(std::string_view key, const Quantity& expected, double fallback) {
  const std::string standard = expected.range.holds(fallback) ? standard_text(fallback) : "none";
  if (records(key, ValueType::of(Kind::quantity, expected), standard)) return fallback;
  const Value* value = find(key);
  return value ? read_quantity(*value, path_of(key), expected) : fallback;
}

std::optional<double> Section::quantity_unless(std::string_view key, std::string_view word,
                                               const Quantity& expected) {
  ValueType type = ValueType::of(Kind::quantity, expected);
  type.words.emplace_back(word);
  if (records(key, type, fmt::format("\"{}\"", word))) return std::nullopt;
  const Value* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* text = std::get_if<std::string>(&value->data);
  if (text && *text == word) return std::nullopt;
  return read_quantity(*value, path_of(key), expected);
}

geometry::Vec3 Section::read_vector(const Value& value, const std::string& path,
                                    const Quantity& expected) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr || array->size() != 3) {
    problems_->add(value.place,
                   fmt::format("{}: got {}; expected a list of three components, x, y and z", path,
                               shown(value)));
    return geometry::Vec3::Constant(kNaN);
  }
  geometry::Vec3 vector;
  for (std::size_t i = 0; i < 3; ++i) {
    vector[static_cast<Eigen::Index>(i)] =
        read_quantity((*array)[i], fmt::format("{}[{}]", path, i), expected);
  }
  return vector;
}

geometry::Vec3 Section::vector(std::string_view key, const Quantity& expected) {
  if (records(key, ValueType::of(Kind::vector, expected), {}))
    return geometry::Vec3::Constant(kNaN);
  const Value* value = require(key);
  return value ? read_vector(*value, path_of(key), expected) : geometry::Vec3::Constant(kNaN);
}

geometry::Vec3 Section::vector(std::string_view key, const Quantity& expected,
                               const geometry::Vec3& fallback) {
  if (records(key, ValueType::of(Kind::vector, expected),
              fmt::format("[{:g}, {:g}, {:g}]", fallback[0], fallback[1], fallback[2])))
    return fallback;
  const Value* value = find(key);
  return value ? read_vector(*value, path_of(key), expected) : fallback;
}

std::vector<geometry::Vec3> Section::vectors(std::string_view key, const Quantity& expected,
                                             std::size_t least) {
  ValueType type = ValueType::of(Kind::vectors, expected);
  type.least = least;
  if (records(key, type, {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  const std::size_t problems = problems_->count();
  if (array == nullptr || array->size() < least)
    complain(key, fmt::format("got {}; expected a list of at least {} vectors, [[x, y, z], ...]",
                              shown(*value), least));
  std::vector<geometry::Vec3> vectors;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    vectors.push_back(read_vector((*array)[i], fmt::format("{}[{}]", path_of(key), i), expected));
  return problems_->count() == problems ? vectors : std::vector<geometry::Vec3>{};
}

std::vector<double> Section::quantities(std::string_view key, const Quantity& expected,
                                        std::optional<std::size_t> count) {
  if (records(key, ValueType::of(Kind::quantities, expected), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  const std::size_t problems = problems_->count();
  if (array == nullptr || (count && array->size() != *count))
    complain(key, fmt::format("got {}; expected a list{}", shown(*value),
                              count ? fmt::format(" of {}", *count) : ""));
  std::vector<double> numbers;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    numbers.push_back(read_quantity((*array)[i], fmt::format("{}[{}]", path_of(key), i), expected));
  return problems_->count() == problems ? numbers : std::vector<double>{};
}

std::vector<std::int32_t> Section::places(std::string_view key, std::size_t columns,
                                          std::size_t size) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  if (records(key,
              ValueType::whole_from(Kind::whole_rows, std::vector<std::int64_t>(columns, 0), kMost),
              {}))
    return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* rows = std::get_if<Array>(&value->data);
  const std::size_t problems = problems_->count();
  if (rows == nullptr || rows->empty())
    complain(key, fmt::format("got {}; expected a list of lists of {} whole numbers", shown(*value),
                              columns));
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
      problems_->add(row.place, fmt::format("{}[{}]: got {}; expected {} different whole numbers "
                                            "from 0 to {}",
                                            path_of(key), i, items_shown(row), columns,
                                            static_cast<std::int64_t>(size) - 1));
  }
  return problems_->count() == problems ? places : std::vector<std::int32_t>{};
}

std::int64_t Section::integer(std::string_view key, std::int64_t low, std::int64_t high,
                              std::optional<std::int64_t> fallback) {
  if (records(key, ValueType::whole_from(Kind::whole_number, {low}, high),
              fallback ? std::optional(std::to_string(*fallback)) : std::nullopt))
    return fallback.value_or(low);
  const Value* value = fallback ? find(key) : require(key);
  if (value == nullptr) return fallback.value_or(0);
  const auto* number = std::get_if<std::int64_t>(&value->data);
  if (number && *number >= low && *number <= high) return *number;
  const auto* real = std::get_if<double>(&value->data);
  const bool is_whole = real != nullptr && std::floor(*real) == *real;
  complain(key, fmt::format("got {}{}; expected a whole number from {} to {}", shown(*value),
                            is_whole ? " with a decimal point or an exponent" : "", low, high));
  return fallback.value_or(0);
}

std::vector<int> Section::integers(std::string_view key, std::vector<int> least, int most) {
  if (records(key, ValueType::whole_from(Kind::whole_numbers, {least.begin(), least.end()}, most),
              {}))
    return least;
  const Value* value = require(key);
  if (value == nullptr) return least;
  const auto* array = std::get_if<Array>(&value->data);
  if (array == nullptr || array->size() != least.size()) {
    complain(key, fmt::format("got {}; expected a list of {} whole numbers", shown(*value),
                              least.size()));
    return least;
  }
  std::vector<int> numbers = least;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Value& item = (*array)[i];
    const auto* number = std::get_if<std::int64_t>(&item.data);
    if (number && *number >= least[i] && *number <= most)
      numbers[i] = static_cast<int>(*number);
    else
      problems_->add(item.place,
                     fmt::format("{}[{}]: got {}; expected a whole number from {} to {}",
                                 path_of(key), i, shown(item), least[i], most));
  }
  return numbers;
}

std::vector<std::array<double, 2>> Section::rising_rows(std::string_view key, const Quantity& first,
                                                        const Quantity& second) {
  if (records(key, ValueType::of(Kind::pairs, first, second), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  const std::size_t problems = problems_->count();
  if (array == nullptr || array->empty())
    complain(key,
             fmt::format("got {}; expected a list of pairs, [[..., ...], ...]", shown(*value)));
  std::vector<std::array<double, 2>> rows;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const Value& row = (*array)[i];
    const std::string path = fmt::format("{}[{}]", path_of(key), i);
    const auto* pair = std::get_if<Array>(&row.data);
    if (pair == nullptr || pair->size() != 2) {
      problems_->add(row.place,
                     fmt::format("{}: got {}; expected a pair, [{}, {}]", path, shown(row),
                                 first.dimension.name, second.dimension.name));
      continue;
    }
    rows.push_back({read_quantity((*pair)[0], path + "[0]", first),
                    read_quantity((*pair)[1], path + "[1]", second)});
    if (rows.size() < 2 || !(rows.back()[0] <= rows[rows.size() - 2][0])) continue;
    const std::string unit =
        first.dimension.si_unit.empty() ? "" : fmt::format(" {}", first.dimension.si_unit);
    problems_->add(row.place,
                   fmt::format("{}: {}{} is not above {}{} of the row before; list the rows by "
                               "increasing {}",
                               path, rows.back()[0], unit, rows[rows.size() - 2][0], unit,
                               first.dimension.name.substr(first.dimension.name.find(' ') + 1)));
  }
  return problems_->count() == problems ? rows : std::vector<std::array<double, 2>>{};
}
}  // namespace plekton::apps

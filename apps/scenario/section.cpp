// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/section.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plekton::apps {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string suggestion(std::string_view written, std::span<const std::string_view> known) {
  const std::string closest = closest_word(written, known);
  return closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest);
}

/// The number of a value that is one, without its unit.
std::optional<double> plain_number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&value.data)) return *number;
  return std::nullopt;
}

}  // namespace

std::string listed(std::span<const std::string_view> words) {
  return words.empty() ? "" : fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

Section::Section(const Table& table, Place place, std::string path, Problems& problems,
                 KeyRecorder* recorder)
    : table_(&table),
      place_(std::move(place)),
      path_(std::move(path)),
      problems_(&problems),
      recorder_(recorder) {}

bool Section::records(std::string_view key, const std::string& kind,
                      const std::optional<std::string>& standard,
                      std::span<const std::string_view> words) const {
  if (recorder_) recorder_->add(path_of(key), kind, standard, words);
  return recorder_ != nullptr;
}

const Place& Section::place_of(std::string_view key) const {
  const Entry* entry = table_->find(key);
  return entry ? entry->value.place : place_;
}

std::string Section::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool Section::has(std::string_view key) {
  if (recorder_) return recorder_->ask(path_of(key));
  return find(key) != nullptr;
}

bool Section::is_table(std::string_view key, std::string_view what) const {
  if (recorder_) recorder_->add_alternative(path_of(key), std::string(what));
  const Entry* entry = table_->find(key);
  return entry && std::holds_alternative<Table>(entry->value.data);
}

bool Section::is_list(std::string_view key) const {
  const Entry* entry = table_->find(key);
  return entry && std::holds_alternative<Array>(entry->value.data);
}

const Value* Section::find(std::string_view key) {
  if (std::find(announced_.begin(), announced_.end(), key) == announced_.end())
    announced_.emplace_back(key);
  const Entry* entry = table_->find(key);
  return entry ? &entry->value : nullptr;
}

const Value* Section::require(std::string_view key) {
  const Value* value = find(key);
  if (value == nullptr)
    problems_->add(place_, fmt::format("{}: missing; this key is required", path_of(key)));
  return value;
}

void Section::complain(std::string_view key, const std::string& what) {
  problems_->add(place_of(key), fmt::format("{}: {}", path_of(key), what));
}

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

void Section::tell_default(std::string_view key, std::string_view text) {
  if (recorder_) recorder_->set_standard(path_of(key), std::string(text));
}

double Section::quantity(std::string_view key, const Quantity& expected) {
  if (records(key, kind_text(expected), {})) return kNaN;
  const Value* value = require(key);
  return value ? read_quantity(*value, path_of(key), expected) : kNaN;
}

double Section::quantity(std::string_view key, const Quantity& expected, double fallback) {
  if (records(key, kind_text(expected), standard_text(fallback))) return fallback;
  const Value* value = find(key);
  return value ? read_quantity(*value, path_of(key), expected) : fallback;
}

std::optional<double> Section::quantity_unless(std::string_view key, std::string_view word,
                                               const Quantity& expected) {
  const std::string standard = fmt::format("\"{}\"", word);
  if (records(key, fmt::format("{}, or {}", kind_text(expected), standard), standard))
    return std::nullopt;
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
  if (records(key, "3 x " + kind_text(expected), {})) return geometry::Vec3::Constant(kNaN);
  const Value* value = require(key);
  return value ? read_vector(*value, path_of(key), expected) : geometry::Vec3::Constant(kNaN);
}

geometry::Vec3 Section::vector(std::string_view key, const Quantity& expected,
                               const geometry::Vec3& fallback) {
  if (records(key, "3 x " + kind_text(expected),
              fmt::format("[{:g}, {:g}, {:g}]", fallback[0], fallback[1], fallback[2])))
    return fallback;
  const Value* value = find(key);
  return value ? read_vector(*value, path_of(key), expected) : fallback;
}

std::int64_t Section::integer(std::string_view key, std::int64_t low, std::int64_t high,
                              std::optional<std::int64_t> fallback) {
  if (records(key, fmt::format("whole number from {}", low),
              fallback ? std::optional(std::to_string(*fallback)) : std::nullopt))
    return fallback.value_or(low);
  const Value* value = fallback ? find(key) : require(key);
  if (value == nullptr) return fallback.value_or(0);
  const auto* number = std::get_if<std::int64_t>(&value->data);
  if (number && *number >= low && *number <= high) return *number;
  complain(key,
           fmt::format("got {}; expected a whole number from {} to {}", shown(*value), low, high));
  return fallback.value_or(0);
}

std::vector<int> Section::integers(std::string_view key, std::vector<int> least, int most) {
  const bool is_same = std::count(least.begin(), least.end(), least[0]) == std::ssize(least);
  const std::string lowest =
      is_same ? std::to_string(least[0]) : fmt::format("{}", fmt::join(least, " and "));
  if (records(key, fmt::format("{} x whole number from {}", least.size(), lowest), {}))
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
  if (records(key, fmt::format("pairs of {} and {}", kind_text(first), kind_text(second)), {}))
    return {};
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

std::vector<std::string> Section::texts(std::string_view key) {
  if (records(key, "texts", {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  std::vector<std::string> texts;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const auto* text = std::get_if<std::string>(&(*array)[i].data);
    if (text != nullptr && !text->empty()) texts.push_back(*text);
  }
  if (array != nullptr && texts.size() == array->size() && !texts.empty()) return texts;
  complain(key, fmt::format("got {}; expected a list of texts in quotes", shown(*value)));
  return {};
}

bool Section::truth(std::string_view key, bool fallback) {
  if (records(key, "true or false", fallback ? "true" : "false")) return fallback;
  const Value* value = find(key);
  if (value == nullptr) return fallback;
  if (const auto* truth = std::get_if<bool>(&value->data)) return *truth;
  complain(key, fmt::format("got {}; expected true or false", shown(*value)));
  return fallback;
}

std::string Section::text(std::string_view key, const std::optional<std::string>& fallback) {
  if (records(key, "text", fallback == "" ? "none" : fallback)) return fallback.value_or("");
  const Value* value = fallback ? find(key) : require(key);
  if (value == nullptr) return fallback.value_or("");
  const auto* text = std::get_if<std::string>(&value->data);
  if (text && !text->empty()) return *text;
  complain(key, fmt::format("got {}; expected a text in quotes, not empty", shown(*value)));
  return "";
}

std::string Section::name(std::string_view key, const std::optional<std::string>& fallback) {
  const std::string name = text(key, fallback);
  const bool is_one_line = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == 127;
  });
  if (is_one_line) return name;
  complain(key, "has a line break or another control character; expected a name on one line");
  return "";
}

std::optional<std::size_t> Section::position_of(const Value& value, std::string_view key,
                                                std::span<const std::string_view> words) {
  const auto* text = std::get_if<std::string>(&value.data);
  const auto found = text ? std::find(words.begin(), words.end(), *text) : words.end();
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  complain(key, fmt::format("got {}; expected one of {}{}", shown(value), listed(words),
                            text ? suggestion(*text, words) : ""));
  return std::nullopt;
}

std::size_t Section::choice(std::string_view key, std::span<const std::string_view> words,
                            std::optional<std::size_t> fallback) {
  if (!recorder_ && !fallback && require(key) == nullptr) return 0;
  return known_choice(key, words, fallback).value_or(0);
}

std::optional<std::size_t> Section::known_choice(std::string_view key,
                                                 std::span<const std::string_view> words,
                                                 std::optional<std::size_t> fallback) {
  if (records(key, listed(words),
              fallback ? std::optional(fmt::format("\"{}\"", words[*fallback])) : std::nullopt,
              words))
    return recorder_->choice(path_of(key), words).value_or(fallback.value_or(0));
  const Value* value = find(key);
  if (value) return position_of(*value, key, words);
  if (fallback) return fallback;
  problems_->add(place_,
                 fmt::format("{}: missing; expected one of {}", path_of(key), listed(words)));
  return std::nullopt;
}

std::optional<Section> Section::table(std::string_view key) {
  if (recorder_ && !recorder_->ask(path_of(key))) return std::nullopt;
  if (recorder_) return within(*table_, place_, path_of(key));
  const Value* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (const auto* table = std::get_if<Table>(&value->data))
    return within(*table, value->place, path_of(key));
  complain(key, fmt::format("got {}; expected a table", shown(*value)));
  return std::nullopt;
}

std::optional<Section> Section::optional_table(std::string_view key) {
  if (recorder_) recorder_->add_optional_table(path_of(key));
  return table(key);
}

std::vector<Section> Section::tables(std::string_view key) {
  if (recorder_) return {within(*table_, place_, path_of(key) + "[]")};
  const Value* value = find(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  if (array == nullptr) {
    complain(key, fmt::format("got {}; expected a list of tables, each under [[{}]]", shown(*value),
                              path_of(key)));
    return {};
  }
  std::vector<Section> sections;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const Value& item = (*array)[i];
    std::string path = fmt::format("{}[{}]", path_of(key), i);
    const auto* table = std::get_if<Table>(&item.data);
    if (table == nullptr) {
      problems_->add(item.place, fmt::format("{}: got {}; expected a table", path, shown(item)));
      continue;
    }
    const Entry* name = table->find("name");
    const auto* text = name ? std::get_if<std::string>(&name->value.data) : nullptr;
    if (text) path = fmt::format("{}.{}", path_of(key), *text);
    sections.push_back(within(*table, item.place, std::move(path)));
  }
  return sections;
}

std::vector<std::pair<std::string, Section>> Section::all_tables() {
  if (recorder_) return {{"NAME", within(*table_, place_, path_of("NAME"))}};
  std::vector<std::pair<std::string, Section>> sections;
  for (const Entry& entry : table_->entries) {
    if (auto section = table(entry.key)) sections.emplace_back(entry.key, *section);
  }
  return sections;
}

void Section::finish() {
  const std::vector<std::string_view> known(announced_.begin(), announced_.end());
  for (const Entry& entry : table_->entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string closest = suggestion(entry.key, known);
    problems_->add(entry.place,
                   fmt::format("{}: unknown key{}", path_of(entry.key),
                               closest.empty() ? "; known here: " + listed(known) : closest));
  }
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/section.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace plekton::apps {
namespace {

using Kind = ValueType::Kind;

}  // namespace

std::string problem_with_name(const std::string& name) {
  const bool is_one_line = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == 127;
  });
  if (!is_one_line)
    return "has a line break or another control character; expected a name on one line";
  // A spreadsheet would carry out what stands there, also behind blanks.
  const std::size_t first = name.find_first_not_of(' ');
  if (first == std::string::npos || name.find_first_of("=+-@", first) != first) return "";
  return fmt::format(
      "got \"{}\"; expected a name that does not begin with = + - or @, also behind blanks, which "
      "a spreadsheet takes for a formula",
      name);
}

Section::Section(const Table& table, Place place, std::string path, Problems& problems,
                 KeyRecorder* recorder)
    : table_(&table),
      place_(std::move(place)),
      path_(std::move(path)),
      problems_(&problems),
      recorder_(recorder) {}

bool Section::records(std::string_view key, const ValueType& type,
                      const std::optional<std::string>& standard) const {
  if (recorder_) recorder_->add(path_of(key), type, standard);
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

bool Section::is_table(std::string_view key, const ValueType& table) const {
  if (recorder_) recorder_->add_alternative(path_of(key), table);
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

void Section::tell_default(std::string_view key, std::string_view text) {
  if (recorder_) recorder_->set_standard(path_of(key), std::string(text));
}

double Section::quantity(std::string_view key, const Quantity& expected) {
  if (records(key, ValueType::of(Kind::quantity, expected), {})) return kUnread;
  const Value* value = require(key);
  return value ? read_quantity(*value, path_of(key), expected, *problems_) : kUnread;
}

double Section::quantity(std::string_view key, const Quantity& expected, double fallback) {
  const std::string standard = expected.range.holds(fallback) ? standard_text(fallback) : "none";
  if (records(key, ValueType::of(Kind::quantity, expected), standard)) return fallback;
  const Value* value = find(key);
  return value ? read_quantity(*value, path_of(key), expected, *problems_) : fallback;
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
  return read_quantity(*value, path_of(key), expected, *problems_);
}

geometry::Vec3 Section::vector(std::string_view key, const Quantity& expected) {
  if (records(key, ValueType::of(Kind::vector, expected), {}))
    return geometry::Vec3::Constant(kUnread);
  const Value* value = require(key);
  return value ? read_vector(*value, path_of(key), expected, *problems_)
               : geometry::Vec3::Constant(kUnread);
}

geometry::Vec3 Section::vector(std::string_view key, const Quantity& expected,
                               const geometry::Vec3& fallback) {
  if (records(key, ValueType::of(Kind::vector, expected),
              fmt::format("[{:g}, {:g}, {:g}]", fallback[0], fallback[1], fallback[2])))
    return fallback;
  const Value* value = find(key);
  return value ? read_vector(*value, path_of(key), expected, *problems_) : fallback;
}

std::vector<geometry::Vec3> Section::vectors(std::string_view key, const Quantity& expected,
                                             std::size_t least) {
  ValueType type = ValueType::of(Kind::vectors, expected);
  type.least = least;
  if (records(key, type, {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  return read_vectors(*value, path_of(key), expected, least, *problems_);
}

std::vector<double> Section::quantities(std::string_view key, const Quantity& expected,
                                        std::optional<std::size_t> count) {
  if (records(key, ValueType::of(Kind::quantities, expected), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  return read_quantities(*value, path_of(key), expected, count, *problems_);
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
  return read_places(*value, path_of(key), columns, size, *problems_);
}

std::int64_t Section::integer(std::string_view key, std::int64_t low, std::int64_t high,
                              std::optional<std::int64_t> fallback) {
  if (records(key, ValueType::whole_from(Kind::whole_number, {low}, high),
              fallback ? std::optional(std::to_string(*fallback)) : std::nullopt))
    return fallback.value_or(low);
  const std::int64_t otherwise = fallback.value_or(0);
  const Value* value = fallback ? find(key) : require(key);
  if (value == nullptr) return otherwise;
  return read_whole_number(*value, path_of(key), low, high, *problems_).value_or(otherwise);
}

std::vector<int> Section::integers(std::string_view key, std::vector<int> least, int most) {
  if (records(key, ValueType::whole_from(Kind::whole_numbers, {least.begin(), least.end()}, most),
              {}))
    return least;
  const Value* value = require(key);
  return value ? read_whole_numbers(*value, path_of(key), least, most, *problems_) : least;
}

std::vector<std::array<double, 2>> Section::rising_rows(std::string_view key, const Quantity& first,
                                                        const Quantity& second) {
  if (records(key, ValueType::of(Kind::pairs, first, second), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  return read_rising_rows(*value, path_of(key), first, second, *problems_);
}

bool Section::truth(std::string_view key, bool fallback) {
  if (records(key, ValueType::of(Kind::truth), fallback ? "true" : "false")) return fallback;
  const Value* value = find(key);
  return value ? read_truth(*value, path_of(key), *problems_).value_or(fallback) : fallback;
}

std::string Section::text(std::string_view key, const std::optional<std::string>& fallback) {
  if (records(key, ValueType::of(Kind::text), fallback == "" ? "none" : fallback))
    return fallback.value_or("");
  const Value* value = fallback ? find(key) : require(key);
  return value ? read_text(*value, path_of(key), *problems_) : fallback.value_or("");
}

std::string Section::name(std::string_view key, const std::optional<std::string>& fallback) {
  const std::string name = text(key, fallback);
  const std::string problem = problem_with_name(name);
  if (problem.empty()) return name;
  complain(key, problem);
  return "";
}

std::vector<std::string> Section::texts(std::string_view key) {
  if (records(key, ValueType::of(Kind::texts), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  return read_texts(*value, path_of(key), *problems_);
}

std::size_t Section::choice(std::string_view key, std::span<const std::string_view> words,
                            std::optional<std::size_t> fallback) {
  if (!recorder_ && !fallback && require(key) == nullptr) return 0;
  return known_choice(key, words, fallback).value_or(0);
}

std::optional<std::size_t> Section::known_choice(std::string_view key,
                                                 std::span<const std::string_view> words,
                                                 std::optional<std::size_t> fallback) {
  if (records(key, ValueType::word_of(words),
              fallback ? std::optional(fmt::format("\"{}\"", words[*fallback])) : std::nullopt))
    return recorder_->choice(path_of(key), words).value_or(fallback.value_or(0));
  const Value* value = find(key);
  if (value) return read_word(*value, path_of(key), words, *problems_);
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
    const std::string path = path_of(entry.key);
    if (const auto* table = std::get_if<Table>(&entry.value.data)) {
      sections.emplace_back(entry.key, within(*table, entry.value.place, path));
    } else {
      problems_->add(entry.value.place,
                     fmt::format("{}: got {}; expected a table", path, shown(entry.value)));
    }
  }
  return sections;
}

void Section::finish() {
  const std::vector<std::string_view> known(announced_.begin(), announced_.end());
  for (const Entry& entry : table_->entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string closest = did_you_mean(entry.key, known);
    problems_->add(entry.place,
                   fmt::format("{}: unknown key{}", path_of(entry.key),
                               closest.empty() ? "; known here: " + listed(known) : closest));
  }
}

}  // namespace plekton::apps

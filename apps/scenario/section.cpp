// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/section.hpp"

#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {

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

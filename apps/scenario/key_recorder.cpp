// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/key_recorder.hpp"

#include "apps/scenario/key_meanings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {

bool KeyRecorder::ask(const std::string& path) {
  asked_.insert(path);
  return !absent_.contains(path);
}

void KeyRecorder::add(const std::string& path, const ValueType& type,
                      const std::optional<std::string>& standard) {
  const bool is_known =
      std::any_of(keys_.begin(), keys_.end(), [&](const auto& key) { return key.path == path; });
  if (is_known) return;
  std::vector<ValueType> types{type};
  const auto other = alternatives_.find(path);
  if (other != alternatives_.end()) types.push_back(other->second);
  const auto told = standards_.find(path);
  keys_.push_back({path, std::move(types),
                   told != standards_.end() ? told->second : standard.value_or(without(path)),
                   meaning_of_key(path)});
}

std::string KeyRecorder::without(const std::string& path) const {
  if (asked_.contains(path)) return "-";
  const std::string table = path.substr(0, path.rfind('.'));
  if (!optional_tables_.contains(table)) return std::string(ListedKey::kRequired);
  return std::string(ListedKey::kRequiredIn) + table.substr(table.rfind('.') + 1);
}

void KeyRecorder::set_standard(const std::string& path, const std::string& text) {
  standards_[path] = text;
}

void KeyRecorder::add_optional_table(const std::string& path) {
  optional_tables_.insert(path);
}

void KeyRecorder::add_alternative(const std::string& path, const ValueType& type) {
  alternatives_[path] = type;
}

std::optional<std::size_t> KeyRecorder::choice(const std::string& path,
                                               std::span<const std::string_view> words) const {
  const auto chosen = chosen_.find(path);
  if (chosen == chosen_.end()) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), chosen->second);
  if (found == words.end()) return std::nullopt;
  return static_cast<std::size_t>(found - words.begin());
}

std::string kind_text(const ListedKey& key) {
  std::string text;
  for (const ValueType& type : key.types) text += (text.empty() ? "" : ", or ") + text_of(type);
  return text;
}

std::string standard_text(double value) {
  return std::isinf(value) ? "none" : fmt::format("{:g}", value);
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/overrides.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace plekton::apps {
namespace {

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys;
  while (true) {
    const std::size_t dot = path.find('.');
    keys.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos) return keys;
    path.remove_prefix(dot + 1);
  }
}

bool is_named(const Value& value, const std::string& name) {
  const auto* table = std::get_if<Table>(&value.data);
  const Entry* entry = table ? table->find("name") : nullptr;
  const auto* text = entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
  return text && *text == name;
}

/// Entry of a list by name or number; null if there is none.
Value* item_of(Array& array, const std::string& key) {
  const auto named =
      std::find_if(array.begin(), array.end(), [&](const Value& v) { return is_named(v, key); });
  if (named != array.end()) return &*named;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  const bool is_number = error == std::errc() && end == key.data() + key.size();
  return is_number && number < array.size() ? &array[number] : nullptr;
}

/// What the entries of a list are called; empty if nobody has a name.
std::string names_in(const Array& array, const std::string& asked) {
  std::vector<std::string_view> names;
  for (const Value& item : array) {
    const auto* table = std::get_if<Table>(&item.data);
    const Entry* const name = table ? table->find("name") : nullptr;
    const auto* text = name ? std::get_if<std::string>(&name->value.data) : nullptr;
    if (text != nullptr) names.push_back(*text);
  }
  if (names.empty()) return {};
  const std::string closest = closest_word(asked, names);
  return closest.empty() ? "; there are " + listed(names)
                         : fmt::format("; did you mean \"{}\"?", closest);
}

/// The value of a key, made as an empty table where it is missing.
Value& value_of(Table& table, const std::string& key, const Place& place) {
  if (Entry* entry = table.find(key)) return entry->value;
  table.entries.push_back({key, place, Value{place, Table{}}});
  return table.entries.back().value;
}

/// Goes one key down. @returns null where that is impossible, with the reason
Value* descend(Value& value, const std::string& key, const Place& place, std::string& reason) {
  if (auto* table = std::get_if<Table>(&value.data)) return &value_of(*table, key, place);
  if (auto* array = std::get_if<Array>(&value.data)) {
    if (Value* item = item_of(*array, key)) return item;
    reason =
        fmt::format("the list has {} entries, none of them named or numbered (from 0) \"{}\"{}",
                    array->size(), key, names_in(*array, key));
    return nullptr;
  }
  reason = fmt::format("there is no \"{}\" in {}", key, shown(value));
  return nullptr;
}

void apply_override(Value& root, const std::string& option, Problems& problems) {
  const Place place{fmt::format("--set {}", option), 0, 0};
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == option.size()) {
    problems.add(place, "expected path=value, such as simulation.duration=\"2 s\"");
    return;
  }
  const std::vector<std::string> keys = split_path(std::string_view(option).substr(0, equals));
  if (std::any_of(keys.begin(), keys.end(), [](const std::string& key) { return key.empty(); })) {
    problems.add(place, "the path has an empty part; expected keys with a dot between them");
    return;
  }
  if (keys.size() > static_cast<std::size_t>(kDeepest)) {
    problems.add(place, fmt::format("the path has {} parts; no key is more than {} deep",
                                    keys.size(), kDeepest));
    return;
  }
  Value* value = &root;
  std::string reason;
  for (const std::string& key : keys) {
    value = descend(*value, key, place, reason);
    if (value == nullptr) {
      problems.add(place, reason);
      return;
    }
  }
  *value = parse_toml_value(std::string_view(option).substr(equals + 1), place);
}

}  // namespace

void apply_overrides(Table& root, std::span<const std::string> options) {
  Problems problems;
  Value value{{}, std::move(root)};
  for (const std::string& option : options) apply_override(value, option, problems);
  root = std::move(std::get<Table>(value.data));
  problems.throw_if_any();
}

}  // namespace plekton::apps

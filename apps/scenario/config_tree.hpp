// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/problems.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// A configuration file as nested tables, each key and value with the place it comes from.
namespace plekton::apps {

/// Deepest nesting of tables and lists that is read; no scenario comes near it.
inline constexpr int kDeepest = 32;

struct Value;
struct Entry;

using Array = std::vector<Value>;

/// Keys in the order of their places.
struct Table {
  std::vector<Entry> entries;

  /// Null if there is none.
  const Entry* find(std::string_view key) const;
  Entry* find(std::string_view key);
};

/// A value of a kind that no scenario uses: a date or a time of day.
struct OtherKind {
  std::string text;
};

struct Value {
  Place place;
  std::variant<std::string, std::int64_t, double, bool, Array, Table, OtherKind> data;
};

struct Entry {
  std::string key;
  Place place;  ///< of the key
  Value value;
};

/// @throws InputError for what is nested deeper than kDeepest
[[noreturn]] void refuse_depth(const Place& place);

/// A value as a message shows it: as it is written for a text or number, its kind for what is
/// longer.
std::string shown(const Value& value);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"
#include "apps/scenario/key_recorder.hpp"
#include "apps/scenario/value_type.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// Reads the keys of one table and collects what is wrong with them: missing keys, wrong kinds,
/// values out of range, and, in finish(), keys that nobody asked for. After a problem a reading
/// function returns a value that makes no further problem.
class Section {
 public:
  /// @param path  What messages call it, as in "membranes.hammock"; empty for the whole file.
  /// @param place  Of the table, for missing keys.
  /// @param recorder  If given, nothing is read: it is told of every key, as if all were there.
  Section(const Table& table, Place place, std::string path, Problems& problems,
          KeyRecorder* recorder = nullptr);

  const Place& place() const noexcept { return place_; }
  const std::string& path() const noexcept { return path_; }
  /// Of the value of a key, or of the table if there is no such key.
  const Place& place_of(std::string_view key) const;
  /// "membranes.hammock.thickness"
  std::string path_of(std::string_view key) const;

  /// Also announces the key, so that it is not unknown.
  bool has(std::string_view key);
  /// @param table  what it would be, for a list of keys
  bool is_table(std::string_view key,
                const ValueType& table = ValueType::of(ValueType::Kind::table)) const;
  bool is_list(std::string_view key) const;

  /// For the list of keys: the default where it is no plain value of the key. Before it is read.
  void tell_default(std::string_view key, std::string_view text);

  /// NaN after a problem.
  double quantity(std::string_view key, const Quantity& expected);
  double quantity(std::string_view key, const Quantity& expected, double fallback);
  /// Nothing if the key is missing or a text of its own, such as "auto".
  std::optional<double> quantity_unless(std::string_view key, std::string_view word,
                                        const Quantity& expected);
  geometry::Vec3 vector(std::string_view key, const Quantity& expected);
  geometry::Vec3 vector(std::string_view key, const Quantity& expected,
                        const geometry::Vec3& fallback);
  /// A list of vectors. Empty after a problem.
  std::vector<geometry::Vec3> vectors(std::string_view key, const Quantity& expected,
                                      std::size_t least);
  /// A list of so many quantities, or of any number. Empty after a problem.
  std::vector<double> quantities(std::string_view key, const Quantity& expected,
                                 std::optional<std::size_t> count);
  /// A list of rows of so many different places in a table, numbered from 0, one row after the
  /// other; at least one row. Empty after a problem.
  std::vector<std::int32_t> places(std::string_view key, std::size_t columns, std::size_t size);
  /// 0 or the fallback after a problem. Limits included.
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {});
  /// A list of whole numbers, each from its least to most. The least ones after a problem.
  std::vector<int> integers(std::string_view key, std::vector<int> least, int most);
  /// A list of pairs, [[first, second], ...], at least one, whose first numbers increase. Empty
  /// after a problem.
  std::vector<std::array<double, 2>> rising_rows(std::string_view key, const Quantity& first,
                                                 const Quantity& second);
  bool truth(std::string_view key, bool fallback);
  /// Empty after a problem.
  std::string text(std::string_view key, const std::optional<std::string>& fallback = {});
  /// A text of one line: no control characters. Empty after a problem.
  std::string name(std::string_view key, const std::optional<std::string>& fallback = {});
  /// A list of texts, none of them empty; empty after a problem.
  std::vector<std::string> texts(std::string_view key);
  /// Position among the words; 0 after a problem. Without a fallback the key is required.
  std::size_t choice(std::string_view key, std::span<const std::string_view> words,
                     std::optional<std::size_t> fallback = {});

  /// Position among the words; nothing after a problem. Without a fallback the key is required.
  std::optional<std::size_t> known_choice(std::string_view key,
                                          std::span<const std::string_view> words,
                                          std::optional<std::size_t> fallback = {});

  /// A table in this one.
  std::optional<Section> table(std::string_view key);
  /// One that may be left out.
  std::optional<Section> optional_table(std::string_view key);
  /// The tables [[key]], each called by its key `name` or its number.
  std::vector<Section> tables(std::string_view key);
  /// All keys with the tables they hold, such as [materials.sand]; of a table of which finish() is
  /// not asked.
  std::vector<std::pair<std::string, Section>> all_tables();

  /// Adds a problem of a key: "path: what".
  void complain(std::string_view key, const std::string& what);

  /// Adds a problem for each key that was not asked for, with the closest one that was.
  void finish();

 private:
  Section within(const Table& table, const Place& place, std::string path) const {
    return Section(table, place, std::move(path), *problems_, recorder_);
  }
  /// Tells the recorder of a key. @returns whether there is one
  bool records(std::string_view key, const ValueType& type,
               const std::optional<std::string>& standard) const;
  const Value* find(std::string_view key);
  const Value* require(std::string_view key);

  const Table* table_;
  Place place_;
  std::string path_;
  Problems* problems_;
  KeyRecorder* recorder_;
  std::vector<std::string> announced_;
};

/// What is wrong with a name, which becomes the head of a column; empty: nothing.
std::string problem_with_name(const std::string& name);

}  // namespace plekton::apps

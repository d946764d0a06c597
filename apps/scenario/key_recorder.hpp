// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/value_type.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// A key that a scenario may have.
struct ListedKey {
  std::string path;              ///< as in "membranes.shape.radius"
  std::vector<ValueType> types;  ///< what its value is; mostly one
  std::string standard;   ///< SI, if nothing is said; "required", or "-" where it may be left out
  std::string_view what;  ///< its meaning

  bool is_required() const { return standard == kRequired || standard.starts_with(kRequiredIn); }

  static constexpr std::string_view kRequired = "required";
  static constexpr std::string_view kRequiredIn = "required in ";  ///< a table that is there
};

/// Writes down which keys the reader asks for, instead of reading a file: so what is listed is what
/// is read. The reader sees every key as present, but for those that are to be absent.
class KeyRecorder {
 public:
  /// @param absent  paths of keys that are not there
  /// @param chosen  word of a choice, by the path of its key; the first or the default elsewhere
  KeyRecorder(std::set<std::string> absent, std::map<std::string, std::string> chosen)
      : absent_(std::move(absent)), chosen_(std::move(chosen)) {}

  /// A question whether a key is there. @returns whether it is
  bool ask(const std::string& path);
  /// A key whose value is read.
  /// @param standard  nothing where the key is required, unless it was asked for before
  void add(const std::string& path, const ValueType& type,
           const std::optional<std::string>& standard);
  /// What the list says of a default that is no plain value. Before the key is read.
  void set_standard(const std::string& path, const std::string& text);
  /// A table that may be left out: what is required in it is not required without it.
  void add_optional_table(const std::string& path);
  /// A value that may also be something else.
  void add_alternative(const std::string& path, const ValueType& type);

  /// Position of the chosen word.
  std::optional<std::size_t> choice(const std::string& path,
                                    std::span<const std::string_view> words) const;

  /// In the order in which they were read, each once.
  const std::vector<ListedKey>& keys() const noexcept { return keys_; }

 private:
  /// What the list says of a key without a default.
  std::string without(const std::string& path) const;

  std::set<std::string> absent_;
  std::map<std::string, std::string> chosen_;
  std::set<std::string> asked_;
  std::map<std::string, ValueType> alternatives_;
  std::map<std::string, std::string> standards_;
  std::set<std::string> optional_tables_;
  std::vector<ListedKey> keys_;
};

/// What a key takes, as in "length (m) above 0".
std::string kind_text(const ListedKey& key);
/// A default: "none" if infinite.
std::string standard_text(double value);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// What a run is known by: two runs with the same key have the same results, bit by bit. A key is a
/// hash (16 hexadecimal digits) of
/// - the scenario with what --set replaces in it, without comments and simulation.threads;
/// - the bytes of every file that a text in it names, relative to its folder: its meshes;
/// - the build: version, revision, compiler, and, where the revision does not tell the sources (they
///   were changed, or there is no repository), the program and its libraries.
class RunKeys {
 public:
  /// @param scenario  Files are relative to its folder.
  explicit RunKeys(std::filesystem::path scenario);

  /// @param text  Of the scenario. @throws InputError
  std::string key_of(std::string_view text, std::span<const std::string> overrides);

 private:
  void add_files(const Value& value, std::string& description);
  /// Hash of what is in a file of the scenario; empty where there is none. Read once.
  const std::string& hash_of_file(const std::string& name);

  std::filesystem::path scenario_;
  std::string build_;
  std::map<std::string, std::string> files_;  ///< hashes by name
};

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Random scenes and what is checked of each.
namespace plekton::stress {

/// A table of a scenario file: its head, as in "[[grains]]", and its keys with their values as they
/// are written.
struct TextTable {
  std::string head;
  std::vector<std::pair<std::string, std::string>> keys;
};

/// A scenario file that can be taken apart: tables and keys, not what they mean.
struct SceneText {
  std::vector<TextTable> tables;

  /// As a file. @param note  comment lines at its beginning, without their signs
  std::string text(std::string_view note = {}) const;
};

/// From a file; comments are lost. A value may go on over lines as long as a bracket of it is open.
SceneText taken_apart(std::string_view text);

/// The value of a key of the first table with that head; nullptr if there is none.
std::string* find_value(SceneText& scene, std::string_view head, std::string_view key);

}  // namespace plekton::stress

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/key_recorder.hpp"

#include <map>
#include <string>
#include <vector>

namespace plekton::apps {

/// Keys that belong together: those of a table, or of one kind of a table.
struct KeyGroup {
  std::string table;            ///< as in "[[loads]]" or "[[membranes]] shape"
  std::string kind;             ///< as in "pressure"; empty where a table has no kinds
  std::vector<ListedKey> keys;  ///< their paths within the table
};

/// Every key that a scenario may have, from the reader itself (key_recorder.hpp), in the order in
/// which it reads them.
std::vector<KeyGroup> scenario_keys();

/// The same keys with their whole paths, as in "membranes[].shape.radius", in one list.
/// @param chosen  words of choices that other keys go by, by the path of their keys; the first or the
///                default elsewhere
std::vector<ListedKey> listed_keys(const std::map<std::string, std::string>& chosen = {});

}  // namespace plekton::apps

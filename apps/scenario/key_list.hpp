// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/key_recorder.hpp"

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

}  // namespace plekton::apps

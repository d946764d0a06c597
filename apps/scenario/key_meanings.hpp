// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace plekton::apps {

struct KeyMeaning {
  std::string_view path;  ///< as in "membranes[].shape.radius" and "materials.NAME.density"
  std::string_view what;  ///< a few words
};

/// Of all keys but the parameters of contact laws, which have theirs with the law.
std::vector<KeyMeaning> key_meanings();

/// What a key says, for the list of keys; empty if it is not known.
std::string_view meaning_of_key(std::string_view path);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/broad_phase.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// Moves a list of things with keys to a new list of keys; both sorted, linear time.
/// @param make  (place in new_keys, old thing of that key or nullptr) -> thing
/// @param drop  (old thing whose key is not in the new list)
template <class Thing, class Make, class Drop>
void rekey(std::vector<geometry::IndexPair>& keys, std::vector<Thing>& things,
           std::span<const geometry::IndexPair> new_keys, Make make, Drop drop) {
  std::vector<Thing> moved;
  moved.reserve(new_keys.size());
  std::size_t old = 0;
  for (std::size_t i = 0; i < new_keys.size(); ++i) {
    for (; old < keys.size() && keys[old] < new_keys[i]; ++old) drop(things[old]);
    const bool known = old < keys.size() && keys[old] == new_keys[i];
    moved.push_back(make(i, known ? &things[old] : nullptr));
    old += known;
  }
  for (; old < keys.size(); ++old) drop(things[old]);
  keys.assign(new_keys.begin(), new_keys.end());
  things.swap(moved);
}

}  // namespace plekton::contact

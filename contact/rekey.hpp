// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/broad_phase.hpp"

#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Makes room for a number of things, and for a quarter more if there is less: a list whose length
/// varies a little soon has the room it needs.
template <class Thing>
void make_room(std::vector<Thing>& list, std::size_t count) {
  if (count > list.capacity()) list.reserve(count + count / 4);
}

/// Moves a list of things with keys to a new list of keys, again and again; both sorted, linear
/// time. Keeps its room: a list that is not much longer than any before does not allocate.
template <class Thing>
class Rekey {
 public:
  /// @param things  by the keys of the last call, empty at first; afterwards by new_keys
  /// @param make    (place in new_keys, old thing of that key or nullptr) -> thing
  /// @param drop    (old thing whose key is not in the new list)
  template <class Make, class Drop>
  void operator()(std::vector<Thing>& things, std::span<const geometry::IndexPair> new_keys,
                  Make make, Drop drop) {
    moved_.clear();
    make_room(moved_, new_keys.size());
    std::size_t old = 0;
    for (std::size_t i = 0; i < new_keys.size(); ++i) {
      for (; old < keys_.size() && keys_[old] < new_keys[i]; ++old) drop(things[old]);
      const bool known = old < keys_.size() && keys_[old] == new_keys[i];
      moved_.push_back(make(i, known ? &things[old] : nullptr));
      old += known;
    }
    for (; old < keys_.size(); ++old) drop(things[old]);
    make_room(keys_, new_keys.size());
    keys_.assign(new_keys.begin(), new_keys.end());
    things.swap(moved_);
  }

 private:
  std::vector<geometry::IndexPair> keys_;
  std::vector<Thing> moved_;
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/neighbor/broad_phase.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Makes room for a number of things, and for a quarter more if there is less: a list whose length
/// varies a little soon has the room it needs.
template <class List>
void make_room(List& list, std::size_t count) {
  if (count > list.capacity()) list.reserve(count + count / 4);
}

/// Finds the keys of one list in another; both sorted, linear time.
/// @param match  (place in new_keys, whether it is in old_keys, place in old_keys if it is)
/// @param drop   (place in old_keys of a key that is not in new_keys)
template <class Match, class Drop>
void match_keys(std::span<const geometry::IndexPair> old_keys,
                std::span<const geometry::IndexPair> new_keys, Match match, Drop drop) {
  std::size_t old = 0;
  for (std::size_t i = 0; i < new_keys.size(); ++i) {
    for (; old < old_keys.size() && old_keys[old] < new_keys[i]; ++old) drop(old);
    const bool is_known = old < old_keys.size() && old_keys[old] == new_keys[i];
    match(i, is_known, old);
    old += is_known;
  }
  for (; old < old_keys.size(); ++old) drop(old);
}

/// Moves a list of things with keys to a new list of keys, again and again; both sorted, linear
/// time. Keeps its room: a list that is not much longer than any before does not allocate.
template <class Thing>
class Rekey {
 public:
  /// Of the thing at a place.
  const geometry::IndexPair& key(std::size_t place) const noexcept { return keys_[place]; }
  std::span<const geometry::IndexPair> keys() const noexcept { return keys_; }

  /// @param things  by the keys of the last call, empty at first; afterwards by new_keys
  /// @param make    (place in new_keys, old thing of that key or nullptr) -> thing
  /// @param drop    (old thing whose key is not in the new list)
  template <class Make, class Drop>
  void operator()(std::vector<Thing>& things, std::span<const geometry::IndexPair> new_keys,
                  Make make, Drop drop) {
    // First those that go on move up, then all to their places, from the last one on: no thing is
    // there twice.
    make_room(places_, things.size());
    places_.clear();
    match_keys(
        keys_, new_keys,
        [&](std::size_t i, bool is_known, std::size_t old) {
          if (!is_known) return;
          if (places_.size() != old) things[places_.size()] = std::move(things[old]);
          places_.push_back(i);
        },
        [&](std::size_t old) { drop(things[old]); });
    make_room(things, new_keys.size());
    things.resize(new_keys.size());
    for (std::size_t i = new_keys.size(); i-- > 0;) {
      const bool is_known = !places_.empty() && places_.back() == i;
      if (is_known) places_.pop_back();
      things[i] = make(i, is_known ? &things[places_.size()] : nullptr);
    }
    make_room(keys_, new_keys.size());
    keys_.assign(new_keys.begin(), new_keys.end());
  }

 private:
  std::vector<geometry::IndexPair> keys_;
  std::vector<std::size_t> places_;  ///< in the new list, of the things that go on
};

}  // namespace plekton::contact

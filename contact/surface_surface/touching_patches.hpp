// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::contact::structure {

/// Which pairs of cells hang together, and which of their two sides belong together: disjoint sets
/// with a side for each member (union-find with parity). Keeps its room.
class TouchingPatches {
 public:
  struct Place {
    std::uint32_t root;
    bool is_turned;  ///< its first cell is on the other side than the root's first cell
  };

  /// Every pair alone.
  void reset(std::size_t count) {
    parents_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) parents_[i] = {i, false};
  }

  Place find(std::uint32_t pair) {
    Place place{pair, false};
    while (parents_[place.root].root != place.root) {
      const Place up = parents_[place.root];
      const Place above = parents_[up.root];
      parents_[place.root] = {above.root, up.is_turned != above.is_turned};
      place = {up.root, place.is_turned != up.is_turned};
    }
    return place;
  }

  /// @param is_turned  whether the first cell of one is on the other side than the first of the
  /// other. The lower root stays one, so the result does not depend on the order of calls.
  void unite(std::uint32_t a, std::uint32_t b, bool is_turned) {
    const Place place_a = find(a);
    const Place place_b = find(b);
    if (place_a.root == place_b.root) return;
    const bool turned = (place_a.is_turned != place_b.is_turned) != is_turned;
    if (place_a.root < place_b.root) {
      parents_[place_b.root] = {place_a.root, turned};
    } else {
      parents_[place_a.root] = {place_b.root, turned};
    }
  }

 private:
  std::vector<Place> parents_;
};

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/sides.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plekton::contact::structure {

/// Which pairs of cells hang together, and which of their two sides belong together: disjoint sets
/// with a side for each member (union-find with parity). Keeps its room.
class TouchingPatches {
 public:
  struct Place {
    std::uint32_t root;
    Sides sides;  ///< how its cells go with the root's
  };

  /// Every pair alone.
  void reset(std::size_t count) {
    parents_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) parents_[i] = {i, {}};
  }

  Place find(std::uint32_t pair) {
    Place place{pair, {}};
    while (parents_[place.root].root != place.root) {
      const Place up = parents_[place.root];
      const Place above = parents_[up.root];
      parents_[place.root] = {above.root, up.sides.with(above.sides)};
      place = {up.root, place.sides.with(up.sides)};
    }
    return place;
  }

  /// @param sides  how the cells of one go with those of the other. The lower root stays one, so
  ///               the result does not depend on the order of calls.
  void unite(std::uint32_t a, std::uint32_t b, Sides sides) {
    const Place place_a = find(a);
    const Place place_b = find(b);
    if (place_a.root == place_b.root) return;
    const Sides of_roots = place_a.sides.with(place_b.sides).with(sides);
    if (place_a.root < place_b.root) {
      parents_[place_b.root] = {place_a.root, of_roots};
    } else {
      parents_[place_a.root] = {place_b.root, of_roots};
    }
  }

 private:
  std::vector<Place> parents_;
};

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh.hpp"

#include <cstddef>
#include <vector>

namespace plekton::geometry {

/// Which facets to turn over so that neighbours agree.
struct Orientation {
  std::vector<bool> flip;   ///< of every facet
  std::size_t flipped = 0;  ///< facets to turn over
  std::size_t patches = 0;  ///< parts connected through edges with exactly two facets
  std::size_t non_orientable_patches =
      0;  ///< of these, parts like a Moebius band; they keep the sides they came with
};

/// Makes the two facets of every ordinary edge run along it in opposite directions. Where more than
/// two facets meet, a patch ends and the next one is free. A patch keeps the side that most of its
/// facets came with, and on a tie that of its first facet; but one that is closed by itself and
/// faces inward is turned over, unless it is a cavity (inside an odd number of other closed
/// patches). No node is touched. n log n, and for every closed patch that faces inward the facets
/// of those closed patches whose boxes hold its box.
Orientation find_orientation(const Mesh& mesh, const EdgeTable& edges);

}  // namespace plekton::geometry

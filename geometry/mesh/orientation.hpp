// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// Which facets to turn over so that neighbours agree.
struct Orientation {
  std::vector<bool> flip;                  ///< of every facet
  std::size_t flipped = 0;                 ///< facets to turn over
  std::size_t patches = 0;                 ///< parts connected through edges with exactly two facets
  std::size_t non_orientable_patches = 0;  ///< of these, parts like a Moebius band; they keep the sides they came with
};

/// Makes the two facets of every ordinary edge run along it in opposite directions. Where more than two facets meet, a
/// patch ends and the next one is free. A patch that is closed by itself gets the outside that makes its volume
/// positive; any other keeps the side that most of its facets already have, and on a tie that of its first facet.
/// No node is touched. n log n.
Orientation find_orientation(const Mesh& mesh, const EdgeTable& edges);

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/primitive_pairs.hpp"
#include "geometry/query/box_tree.hpp"

namespace plekton::geometry {

/// The cell of a surface that is nearest to something, and how.
struct NearestCell {
  CellId cell;
  Proximity proximity;  ///< a: what was asked with; b: the cell
};

/// The two cells at which two surfaces are nearest.
struct NearestCells {
  CellId a;
  CellId b;
  Proximity proximity;
};

/// A surface where it is now, under a tree of its cells' cores; the items are the cells.
struct SearchedSurface {
  PlacedSurface placed;
  const BoxTree& tree;
};

/// The cell with the smallest computed gap to a probe, the lowest of several. Goes down the tree
/// nearest first and leaves out what is certainly further away: boxes by their distance, cells by
/// the plane across the way to the nearest one so far.
/// @param on  with a cell at least
NearestCell nearest_cell(const Probe& probe, const SearchedSurface& on);

/// A cell whose core is nearest, whatever the radii.
struct NearestCore {
  NearestCell nearest;
  double distance;  ///< m, of the cores
};
NearestCore nearest_core(const Probe& probe, const SearchedSurface& on);

/// The two cells with the smallest computed gap, the lowest of several, those of a first. Goes down
/// both trees, the larger box first. Of two pairs as near as each other to rounding (32 ulps of
/// what their positions relative to each other measure) the higher one is not looked at if a plane
/// shows it: two parallel sheets have as many such pairs as facets.
/// @param a, b  with a cell at least
NearestCells nearest_cells(const SearchedSurface& a, const SearchedSurface& b);

}  // namespace plekton::geometry

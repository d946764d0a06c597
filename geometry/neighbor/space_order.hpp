// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Brings things into an order in which those near each other in the list are near each other in
/// space: along Hilbert's curve, each cube of it split at the medians, so that any distribution
/// gives parts of equal numbers. (Hilbert, Mathematische Annalen 38 (1891) 459; CGAL's
/// hilbert_sort.)
///
/// The result depends on the positions and on nothing else, unless positions coincide in a
/// component: then the smaller index is first. NaN counts as 0. O(n log n); does not allocate.
/// @param nodes  of each thing, where it is
/// @param order  indices of nodes; rearranged
void order_along_curve(Positions x, std::span<const NodeId> nodes,
                       std::vector<std::int32_t>& order);

/// The same order of points, as indices of them. For things that are to be numbered so that those
/// near each other lie near each other in memory: a processor then waits less for them, and two
/// hand less to each other.
std::vector<std::int32_t> order_along_curve(Positions points);

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <vector>

namespace plekton::apps::yade {

/// Boxes that together hold chosen points and no others.
struct NodeBoxes {
  std::vector<geometry::Box> boxes;
  bool hold_all = true;  ///< false where points at the place of one that is not chosen stay out
};

/// Few boxes where the chosen points lie in blocks, rows or planes. n log n in the points where these
/// are spread evenly, n² at most.
/// @param chosen  By point.
NodeBoxes boxes_around(const std::vector<geometry::Vec3>& points, const std::vector<bool>& chosen);

}  // namespace plekton::apps::yade

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <vector>

namespace plekton::apps::yade {

/// Boxes that together hold the chosen points and no others: few where these lie in blocks, rows or
/// planes. Points at the place of one that is not chosen stay out.
/// @param chosen  By point.
std::vector<geometry::Box> boxes_around(const std::vector<geometry::Vec3>& points,
                                        const std::vector<bool>& chosen);

}  // namespace plekton::apps::yade

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/primitives/elements.hpp"

#include <array>
#include <span>

namespace plekton::contact {

/// By side of a facet: 1 where it may be in range, but is known not to touch by itself; else -1.
/// The last number says nothing.
using SideFlags = std::array<double, 4>;
constexpr SideFlags kNoSides{-1.0, -1.0, -1.0, -1.0};

/// Whether all cells in range of a sphere over the inside of a facet, but that facet, are facets
/// beside it, over which the sphere is not: their feet are certainly across the side that they
/// share with it, and their other sides out of range. Such a side and what is beyond it do not
/// touch: from its nearest point on, the surface comes nearer towards the inside of the facet, and
/// goes away on the other side.
/// @param face   if it is none of the cells, this is false
/// @param cells  all that may be in range
/// @param sides  kNoSides; 1 is written for every side that is shared with one of the cells
bool are_beside(const geometry::Surface& surface, geometry::FaceId face,
                std::span<const geometry::CellId> cells, const Vec3& centre, double range,
                Positions x, SideFlags& sides) noexcept;

}  // namespace plekton::contact

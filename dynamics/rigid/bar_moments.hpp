// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/rigid/mass_properties.hpp"

namespace plekton::dynamics {

/// Moments of solid round bars along edges, without their round ends, exact but for rounding. What
/// bars that meet have in common counts with each of them, and the wedge on the other side of a
/// joint with none, as in the mass of beams.
/// @param edges   both nodes of each
/// @param radius  m, of all
/// @param origin  m, about which the moments are, near the bars
VolumeMoments bar_moments(geometry::Positions points,
                          std::span<const std::array<geometry::NodeId, 2>> edges, double radius,
                          const Vec3& origin) noexcept;

}  // namespace plekton::dynamics

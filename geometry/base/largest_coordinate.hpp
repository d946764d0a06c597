// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::geometry {

/// Coordinates and lengths (m) at or above this are refused: exact signs take products of three
/// lengths, and those of this size still fit a double.
inline constexpr double kLargestCoordinate = 1e75;

}  // namespace plekton::geometry

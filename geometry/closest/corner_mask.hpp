// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>

namespace plekton::geometry::closest {

/// First and last corner of a side given by its corners, one bit each; there is at least one of at most three.
inline std::size_t first_of(unsigned corners) noexcept {
  return static_cast<std::size_t>(std::countr_zero(corners)) & 3U;  // never 32: there is a corner
}
inline std::size_t last_of(unsigned corners) noexcept {
  return static_cast<std::size_t>(std::bit_width(corners)) - 1;
}

}  // namespace plekton::geometry::closest

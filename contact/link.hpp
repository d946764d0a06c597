// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace plekton::contact {

/// A link between two vertices of a graph.
struct Link {
  std::uint32_t a;
  std::uint32_t b;
  double resistance;  ///< >= 0, in any unit
};

/// Resistance (1/m^2) of the way down from a pass to a feature: upper overlap^-2 - lower
/// overlap^-2.
/// @param upper  m, > 0, overlap of the pass
/// @param drop   m, >= 0, by how much the lower end is nearer
inline double link_resistance(double upper, double drop) noexcept {
  const double lower = upper + drop;
  return drop * (upper + lower) / (upper * upper * lower * lower);
}

}  // namespace plekton::contact

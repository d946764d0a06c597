// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace plekton::contact {

/// A link between two vertices of a graph.
struct Link {
  std::uint32_t a;
  std::uint32_t b;
  double resistance = 0.0;  ///< >= 0, in any unit
};

}  // namespace plekton::contact

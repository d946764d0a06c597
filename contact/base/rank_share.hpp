// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace plekton::contact {

/// What one of several ranks does alone; all else all of them do.
struct RankShare {
  std::size_t blocks = 0;   ///< of spheres, whose contacts it computes
  std::size_t spheres = 0;  ///< with nothing but spheres and planes near them, which it moves
};

}  // namespace plekton::contact

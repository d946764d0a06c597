// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// What a scene takes over from one that it goes on from (Simulation::go_on_from).
namespace plekton::dynamics {

/// Calls visit(before, now) for all that is in both scenes.
/// @param places  among what is there now, by what there was before; -1: gone
template <class Visit>
void for_each_kept(const std::vector<std::int32_t>& places, Visit&& visit) {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= 0) visit(i, static_cast<std::size_t>(places[i]));
}

}  // namespace plekton::dynamics

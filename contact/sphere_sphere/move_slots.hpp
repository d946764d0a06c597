// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::contact {

/// The slot that nothing comes from.
constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};

/// Moves things between slots in place, in linear time. A slot to which nothing comes gets a new
/// thing.
/// @param sources  by slot: the slot where its thing comes from, or kNoSlot; none twice. Afterwards
///                 all are kNoSlot
/// @param is_source  working space
/// @param get  (slot) -> thing
/// @param set  (slot, thing)
template <class Get, class Set>
void move_slots(std::vector<std::uint32_t>& sources, std::vector<bool>& is_source, const Get& get,
                const Set& set) {
  is_source.assign(sources.size(), false);
  for (const std::uint32_t source : sources)
    if (source != kNoSlot) is_source[source] = true;
  // Things follow each other from a slot on whose own thing may be lost; @returns the last slot.
  const auto move_up = [&](std::uint32_t slot, std::uint32_t end) {
    while (sources[slot] != end) {
      const std::uint32_t source = std::exchange(sources[slot], kNoSlot);
      set(slot, get(source));
      slot = source;
    }
    return slot;
  };
  const auto count = static_cast<std::uint32_t>(sources.size());
  for (std::uint32_t slot = 0; slot < count; ++slot)
    if (!is_source[slot]) set(move_up(slot, kNoSlot), {});
  // What remains runs in rings.
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    if (sources[slot] == kNoSlot) continue;
    const auto first = get(slot);
    const std::uint32_t last = move_up(slot, slot);
    sources[last] = kNoSlot;
    set(last, first);
  }
}

}  // namespace plekton::contact

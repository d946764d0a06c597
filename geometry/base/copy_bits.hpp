// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>

namespace plekton::geometry {

/// Writes the bytes of a thing of plain numbers. Those that belong to none of its members, as after
/// a bool before a double, are 0, whatever is there in memory: equal things have equal bytes. With a
/// compiler that cannot tell them (clang below 20) they are what is there.
/// @param to  room for sizeof thing
template <class Thing>
inline void copy_bits(const Thing& thing, void* to) noexcept {
  Thing copy = thing;
#if __has_builtin(__builtin_clear_padding)
  __builtin_clear_padding(&copy);
#endif
  std::memcpy(to, static_cast<const void*>(&copy), sizeof copy);
}

}  // namespace plekton::geometry

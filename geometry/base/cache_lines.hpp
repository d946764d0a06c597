// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace plekton::geometry {

/// Allocates at the beginning of a line of the cache.
template <class Thing>
struct LineAllocator {
  using value_type = Thing;
  static constexpr std::align_val_t kLine{64};

  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>&) noexcept {}  // NOLINT: as allocators convert

  Thing* allocate(std::size_t count) {
    return static_cast<Thing*>(::operator new(count * sizeof(Thing), kLine));
  }
  void deallocate(Thing* things, std::size_t) noexcept { ::operator delete(things, kLine); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) noexcept { return true; }
};

/// Numbers of which every eighth begins a line of the cache.
using LineNumbers = std::vector<double, LineAllocator<double>>;

}  // namespace plekton::geometry

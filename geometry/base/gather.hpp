// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/lanes.hpp"
#include "geometry/base/types.hpp"

#include <algorithm>
#include <cstring>

/// Things that lie anywhere in memory, brought side by side and back.
namespace plekton::geometry {

namespace detail {

/// A vector with a fourth number that nobody reads, without touching what lies behind it.
template <class Part>
PLEKTON_INLINE auto part_of_vector(const double* v, const Part&) noexcept {
  if constexpr (sizeof(typename Part::Pack) == 4 * sizeof(double))
    return geometry::side_by_side(Pack<2>::load(v), Pack<2>(v[2]));
  else if constexpr (Part::first == 0)
    return Pack<2>::load(v);
  else
    return Pack<2>(v[2]);
}

}  // namespace detail

/// @param at  (lane) -> const Vec3&
template <int W, class At>
PLEKTON_INLINE PackVec3<Pack<W>> gather_vectors(const At& at) noexcept {
  const auto [x, y, z, unused] =
      gather_things<W, 4>([&](std::size_t lane, auto part) __attribute__((always_inline)) {
        return detail::part_of_vector(at(lane).data(), part);
      });
  return {x, y, z};
}

/// How many numbers gather_numbers and scatter_numbers touch of a thing of some.
constexpr int touched_numbers(int count) noexcept {
  return (count + 7) / 8 * 8;
}

/// @tparam Image  consists of packs of W numbers: number n of all things is its pack n
/// @param at  (lane) -> where the thing's numbers start; touched_numbers() of them are read
template <class Image, int W, class At>
PLEKTON_INLINE Image gather_numbers(const At& at) noexcept {
  constexpr int kCount = sizeof(Image) / sizeof(Pack<W>);
  Image image;
  detail::each<touched_numbers(kCount) / 8>([&](auto chunk) __attribute__((always_inline)) {
    constexpr int kFirst = 8 * chunk;
    const auto packs =
        gather_things<W, 8>([&](std::size_t lane, auto part) __attribute__((always_inline)) {
          using Part = typename decltype(part)::Pack;
          return Part::load(at(lane) + kFirst + part.first);
        });
    std::memcpy(reinterpret_cast<char*>(&image) + kFirst * sizeof(Pack<W>), packs.data(),
                std::min(8, kCount - kFirst) * sizeof(Pack<W>));
    return 0;
  });
  return image;
}

/// @param at  (lane) -> where the thing's numbers start; touched_numbers() of them are written
template <int W, class Image, class At>
PLEKTON_INLINE void scatter_numbers(const Image& image, const At& at) noexcept {
  constexpr int kCount = sizeof(Image) / sizeof(Pack<W>);
  detail::each<touched_numbers(kCount) / 8>([&](auto chunk) __attribute__((always_inline)) {
    constexpr int kFirst = 8 * chunk;
    Packs<W, 8> packs;
    if constexpr (kCount - kFirst < 8) packs.fill(Pack<W>(0.0));
    std::memcpy(packs.data(), reinterpret_cast<const char*>(&image) + kFirst * sizeof(Pack<W>),
                std::min(8, kCount - kFirst) * sizeof(Pack<W>));
    scatter_things<W, 8>(
        packs, [&](std::size_t lane) __attribute__((always_inline)) { return at(lane) + kFirst; });
    return 0;
  });
}

}  // namespace plekton::geometry

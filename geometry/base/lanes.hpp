// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

/// Things of some numbers each, brought from memory into the lanes of packs and back: number n of
/// thing l is lane l of pack n. By shuffles of whole vectors, several times faster than number by
/// number.
namespace plekton::geometry {

/// N packs. Indices are constants everywhere here: a loop would leave the packs in memory.
template <int W, int N>
using Packs = std::array<Pack<W>, std::size_t{N}>;

namespace detail {

template <int i>
using Index = std::integral_constant<int, i>;

template <class Make, int... i>
PLEKTON_INLINE auto each(const Make& make, std::integer_sequence<int, i...>) noexcept {
  return std::array<decltype(make(Index<0>{})), sizeof...(i)>{make(Index<i>{})...};
}
/// The results of make(Index<0>), ..., make(Index<N - 1>).
template <int N, class Make>
PLEKTON_INLINE auto each(const Make& make) noexcept {
  return each(make, std::make_integer_sequence<int, N>());
}

template <auto kPlace, int W, int... kLane>
PLEKTON_INLINE Pack<W> pick(const Pack<W>& p, const Pack<W>& q,
                            std::integer_sequence<int, kLane...>) noexcept {
  return Pack<W>(__builtin_shufflevector(p.lanes, q.lanes, kPlace(kLane)...));
}

}  // namespace detail

/// Lane l of the result is number kPlace(l) of the 2 W lanes of p and q.
template <auto kPlace, int W>
PLEKTON_INLINE Pack<W> pick(const Pack<W>& p, const Pack<W>& q) noexcept {
  return detail::pick<kPlace>(p, q, std::make_integer_sequence<int, W>());
}

namespace detail {

/// Exchanges the off-diagonal halves of all 2 S x 2 S squares of a matrix of which each pack is a
/// row.
template <int S, int W, int M>
PLEKTON_INLINE Packs<W, M> swap_halves(const Packs<W, M>& rows) noexcept {
  return each<M>([&](auto i) __attribute__((always_inline)) {
    constexpr auto kUpper = [](int l) { return (l & S) == 0 ? l : W + l - S; };
    constexpr auto kLower = [](int l) { return (l & S) == 0 ? l + S : W + l; };
    constexpr std::size_t kOther = i ^ S;
    if constexpr ((i & S) == 0)
      return pick<kUpper>(rows[i], rows[kOther]);
    else
      return pick<kLower>(rows[kOther], rows[i]);
  });
}

/// Transposes the M x M squares that lie side by side in M packs; M is 1, 2, 4 or 8.
template <int M, int S = 1, int W>
PLEKTON_INLINE Packs<W, M> transpose(const Packs<W, M>& rows) noexcept {
  if constexpr (S < M)
    return transpose<M, 2 * S, W>(swap_halves<S, W, M>(rows));
  else
    return rows;
}

template <int W, int... kLane>
PLEKTON_INLINE Pack<2 * W> side_by_side(const Pack<W>& p, const Pack<W>& q,
                                        std::integer_sequence<int, kLane...>) noexcept {
  return Pack<2 * W>(__builtin_shufflevector(p.lanes, q.lanes, kLane...));
}

}  // namespace detail

/// The lanes of p, then those of q.
template <int W>
PLEKTON_INLINE Pack<2 * W> side_by_side(const Pack<W>& p, const Pack<W>& q) noexcept {
  return detail::side_by_side(p, q, std::make_integer_sequence<int, 2 * W>());
}

/// Numbers [first, first + W) of a thing, to be loaded as one pack.
template <int W, int kFirst>
struct PartOfThing {
  using Pack = geometry::Pack<W>;
  static constexpr int first = kFirst;
};

/// Gathers W things of N numbers each, which lie anywhere; N is 4 or 8.
/// @param load  (lane, PartOfThing<V, first>) -> Pack<V> of that part of that thing, V <= W
template <int W, int N, class Load>
PLEKTON_INLINE Packs<W, N> gather_things(const Load& load) noexcept {
  using namespace detail;
  if constexpr (W <= N) {
    const auto parts = each<N / W>([&](auto part) __attribute__((always_inline)) {
      return transpose<W>(each<W>([&](auto lane) __attribute__((always_inline)) {
        return load(std::size_t{lane}, PartOfThing<W, part * W>{});
      }));
    });
    return each<N>([&](auto n) __attribute__((always_inline)) { return parts[n / W][n % W]; });
  } else {
    static_assert(W == 8 && N == 4);
    return transpose<N>(each<N>([&](auto lane) __attribute__((always_inline)) {
      return geometry::side_by_side(load(std::size_t{lane}, PartOfThing<4, 0>{}),
                                    load(std::size_t{lane + 4}, PartOfThing<4, 0>{}));
    }));
  }
}

/// Scatters W things of N >= W numbers each, in the order of the lanes; N is 4 or 8.
/// @param at  (lane) -> where the thing's numbers start
template <int W, int N, class At>
PLEKTON_INLINE void scatter_things(const Packs<W, N>& numbers, const At& at) noexcept {
  using namespace detail;
  static_assert(W <= N && N % W == 0);
  each<N / W>([&](auto part) __attribute__((always_inline)) {
    const auto things = transpose<W>(
        each<W>([&](auto n) __attribute__((always_inline)) { return numbers[part * W + n]; }));
    return each<W>([&](auto lane) __attribute__((always_inline)) {
      things[lane].store(at(std::size_t{lane}) + part * W);
      return 0;
    });
  });
}

/// Adds pairs of things, p and q, of N >= W numbers each to sums: lane by lane, of each first p and
/// then q, so that several may go to the same sum; N is 4 or 8.
/// @param sum  (0 for p or 1 for q, lane) -> where the sum's numbers start
template <int W, int N, class Sum>
PLEKTON_INLINE void add_things(const Packs<W, N>& p, const Packs<W, N>& q,
                               const Sum& sum) noexcept {
  using namespace detail;
  static_assert(W <= N && N % W == 0);
  const auto add = [](const Pack<W>& numbers, double* to) __attribute__((always_inline)) {
    (Pack<W>::load(to) + numbers).store(to);
  };
  each<N / W>([&](auto part) __attribute__((always_inline)) {
    constexpr std::size_t kFirst = part * W;
    const auto p_things =
        transpose<W>(each<W>([&](auto n) __attribute__((always_inline)) { return p[kFirst + n]; }));
    const auto q_things =
        transpose<W>(each<W>([&](auto n) __attribute__((always_inline)) { return q[kFirst + n]; }));
    return each<W>([&](auto lane) __attribute__((always_inline)) {
      add(p_things[lane], sum(std::size_t{0}, std::size_t{lane}) + kFirst);
      add(q_things[lane], sum(std::size_t{1}, std::size_t{lane}) + kFirst);
      return 0;
    });
  });
}

namespace detail {

/// Number n of W things that fill N packs one after the other; so_far has it of the packs before
/// kKnown.
template <int n, int kKnown, int W, int N>
PLEKTON_INLINE Pack<W> number_of_things(const Packs<W, N>& packs, const Pack<W>& so_far) noexcept {
  if constexpr (kKnown == N) {
    return so_far;
  } else {
    constexpr auto kPlace = [](int l) {
      const int place = l * N + n;
      if (place / W == kKnown) return W + place % W;
      return kKnown > 1 ? l : place % W;
    };
    return number_of_things<n, kKnown + 1, W, N>(packs, pick<kPlace>(so_far, packs[kKnown]));
  }
}

/// Pack k of the N packs that W things fill one after the other; so_far has the numbers before
/// kKnown.
template <int k, int kKnown, int W, int N>
PLEKTON_INLINE Pack<W> things_in_pack(const Packs<W, N>& numbers, const Pack<W>& so_far) noexcept {
  if constexpr (kKnown == N) {
    return so_far;
  } else {
    constexpr auto kPlace = [](int l) {
      const int thing = (k * W + l) / N;
      if ((k * W + l) % N == kKnown) return W + thing;
      return kKnown > 1 ? l : thing;
    };
    return things_in_pack<k, kKnown + 1, W, N>(numbers, pick<kPlace>(so_far, numbers[kKnown]));
  }
}

/// Of things that are numbers one after the other.
template <int N, class Thing>
PLEKTON_INLINE auto* bytes_of(Thing* things) noexcept {
  static_assert(sizeof(Thing) == N * sizeof(double));
  using Byte = std::conditional_t<std::is_const_v<Thing>, const std::byte, std::byte>;
  return reinterpret_cast<Byte*>(things);
}

}  // namespace detail

/// Loads W things of N > 1 numbers each, which lie one after the other.
template <int W, int N, class Thing>
PLEKTON_INLINE Packs<W, N> load_things(const Thing* from) noexcept {
  const std::byte* const bytes = detail::bytes_of<N>(from);
  const auto packs = detail::each<N>([&](auto k) __attribute__((always_inline)) {
    return Pack<W>::load_bytes(bytes + k * sizeof(Pack<W>));
  });
  if constexpr (W == 1)
    return packs;
  else
    return detail::each<N>([&](auto n) __attribute__((always_inline)) {
      return detail::number_of_things<n, 1, W, N>(packs, packs[0]);
    });
}

/// Stores W things of N > 1 numbers each, one after the other.
template <int W, int N, class Thing>
PLEKTON_INLINE void store_things(const Packs<W, N>& numbers, Thing* to) noexcept {
  std::byte* const bytes = detail::bytes_of<N>(to);
  detail::each<N>([&](auto k) __attribute__((always_inline)) {
    std::byte* const of_pack = bytes + k * sizeof(Pack<W>);
    if constexpr (W == 1)
      numbers[k].store_bytes(of_pack);
    else
      detail::things_in_pack<k, 1, W, N>(numbers, numbers[0]).store_bytes(of_pack);
    return 0;
  });
}

}  // namespace plekton::geometry

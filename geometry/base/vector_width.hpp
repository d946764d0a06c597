// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

#include <type_traits>

/// Runs a kernel with the widest vectors that the processor has, in a program compiled for any
/// x86-64.
namespace plekton::geometry {

template <int W>
using Width = std::integral_constant<int, W>;

#if defined(__x86_64__)
namespace detail {

// The target is named by features, not by arch=: GCC inlines only across features.
template <class Kernel>
[[gnu::target("avx512f,avx512dq,avx512vl")]] void run_512(const Kernel& kernel) {
  kernel(Width<8>{});
}
template <class Kernel>
[[gnu::target("avx2")]] void run_256(const Kernel& kernel) {
  kernel(Width<4>{});
}

}  // namespace detail
#endif

/// Calls kernel(Width<W>{}), compiled for vectors of W numbers. The kernel has to be always_inline
/// with all it calls.
template <class Kernel>
void with_widest_vectors(const Kernel& kernel) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return detail::run_512(kernel);
  if (__builtin_cpu_supports("avx2")) return detail::run_256(kernel);
#endif
  kernel(Width<2>{});
}

}  // namespace plekton::geometry

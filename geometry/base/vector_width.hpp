// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"

#include <optional>
#include <string>
#include <type_traits>

/// Runs a kernel with the widest vectors that the processor has, in a program compiled for any
/// x86-64; or with narrower ones where the environment asks for them. The bits are the same.
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

/// The environment variable that sets the width of vectors: 2, 4 or 8 numbers.
constexpr const char* kVectorWidthVariable = "PLEKTON_VECTOR_WIDTH";

/// Numbers in the widest vectors of this processor for which kernels are compiled: 2, 4 or 8.
int widest_vectors() noexcept;

/// What an asked width comes to.
/// @param asked   text of kVectorWidthVariable, if it is set; an empty one asks for nothing
/// @param widest  numbers in a vector of the processor
/// @throws std::invalid_argument for a width that is not known, or that the processor lacks
int chosen_vector_width(const std::optional<std::string>& asked, int widest);

/// Numbers in the vectors of this program: as the environment said when it was first called, else
/// the widest. @throws std::invalid_argument, as chosen_vector_width does
int vector_width();

/// From now on vectors have so many numbers: to compare widths within one program. Not while
/// kernels run. @param width  2, 4 or 8, at most widest_vectors()
/// @throws std::invalid_argument, as chosen_vector_width does
void set_vector_width(int width);

/// Calls kernel(Width<W>{}), compiled for vectors of W = vector_width() numbers. The kernel has to
/// be always_inline with all it calls. @throws std::invalid_argument, as vector_width does
template <class Kernel>
void with_widest_vectors(const Kernel& kernel) {
#if defined(__x86_64__)
  const int width = vector_width();
  if (width == 8) return detail::run_512(kernel);
  if (width == 4) return detail::run_256(kernel);
#endif
  kernel(Width<2>{});
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// Several numbers at once: a formula written for a type Real runs with Real = double for one
/// thing, or with Real = Pack<W> for W things side by side, in vector instructions. Every lane has
/// the same bits as the formula for double, for any W, because each operation is rounded alone
/// (contraction is off).
///
/// No loop is left to the compiler to vectorise: that silently fails as soon as a formula has a
/// branch or copies a struct.
namespace plekton::geometry {

// Everything here disappears into its caller, also into one compiled for other instructions than
// the rest of the file.
#define PLEKTON_INLINE [[gnu::always_inline]] inline

/// Answers of a comparison, lane by lane. For select and bits_of only: anything else that is done
/// with them is taken apart by GCC 12.
template <int W>
struct PackMask {
  using Vector [[gnu::vector_size(W * sizeof(double))]] = std::int64_t;
  Vector lanes;
};

/// W numbers. Only +, -, *, /, comparisons, select, sqrt.
template <int W>
struct Pack {
  using Vector [[gnu::vector_size(W * sizeof(double))]] = double;
  Vector lanes;

  Pack() = default;
  PLEKTON_INLINE explicit Pack(const Vector& v) noexcept : lanes(v) {}
  /// The same number in every lane.
  PLEKTON_INLINE Pack(double x) noexcept
      : lanes(x - Vector{}) {}  // NOLINT: a number is a pack, as in a formula

  /// From W numbers in a row, aligned or not.
  PLEKTON_INLINE static Pack load(const double* from) noexcept {
    Pack pack;
    std::memcpy(&pack.lanes, from, sizeof(pack.lanes));
    return pack;
  }
  PLEKTON_INLINE void store(double* to) const noexcept { std::memcpy(to, &lanes, sizeof(lanes)); }
  /// From the bytes of W numbers in a row, whatever things they are part of.
  PLEKTON_INLINE static Pack load_bytes(const std::byte* from) noexcept {
    Pack pack;
    std::memcpy(&pack.lanes, from, sizeof(pack.lanes));
    return pack;
  }
  PLEKTON_INLINE void store_bytes(std::byte* to) const noexcept {
    std::memcpy(to, &lanes, sizeof(lanes));
  }

  PLEKTON_INLINE friend Pack operator+(const Pack& x, const Pack& y) noexcept {
    return Pack(x.lanes + y.lanes);
  }
  PLEKTON_INLINE friend Pack operator-(const Pack& x, const Pack& y) noexcept {
    return Pack(x.lanes - y.lanes);
  }
  PLEKTON_INLINE friend Pack operator*(const Pack& x, const Pack& y) noexcept {
    return Pack(x.lanes * y.lanes);
  }
  PLEKTON_INLINE friend Pack operator/(const Pack& x, const Pack& y) noexcept {
    return Pack(x.lanes / y.lanes);
  }
  PLEKTON_INLINE friend Pack operator-(const Pack& x) noexcept { return Pack(-x.lanes); }
  PLEKTON_INLINE friend PackMask<W> operator>(const Pack& x, const Pack& y) noexcept {
    return PackMask<W>{x.lanes > y.lanes};
  }
  PLEKTON_INLINE friend PackMask<W> operator>=(const Pack& x, const Pack& y) noexcept {
    return PackMask<W>{x.lanes >= y.lanes};
  }
  PLEKTON_INLINE friend PackMask<W> operator==(const Pack& x, const Pack& y) noexcept {
    return PackMask<W>{x.lanes == y.lanes};
  }
};

/// Lane by lane: x where the condition holds, otherwise y. Both are evaluated.
template <int W>
PLEKTON_INLINE Pack<W> select(const PackMask<W>& condition, const Pack<W>& x,
                              const std::type_identity_t<Pack<W>>& y) noexcept {
  return Pack<W>(condition.lanes ? x.lanes : y.lanes);
}
PLEKTON_INLINE double select(bool condition, double x, double y) noexcept {
  return condition ? x : y;
}

namespace detail {

template <int W, int... kLane>
PLEKTON_INLINE double sum_of_lanes(const Pack<W>& x,
                                   std::integer_sequence<int, kLane...>) noexcept {
  if constexpr (W == 1) {
    return x.lanes[0];
  } else {
    using Half = Pack<W / 2>;
    const Half sum = Half(__builtin_shufflevector(x.lanes, x.lanes, kLane...)) +
                     Half(__builtin_shufflevector(x.lanes, x.lanes, (W / 2 + kLane)...));
    return sum_of_lanes(sum, std::make_integer_sequence<int, W / 4>());
  }
}

}  // namespace detail

/// 1 where a comparison holds, else 0.
template <int W>
PLEKTON_INLINE Pack<W> flag(const PackMask<W>& condition) noexcept {
  return select(condition, Pack<W>(1.0), 0.0);
}
PLEKTON_INLINE double flag(bool condition) noexcept {
  return condition ? 1.0 : 0.0;
}

/// Bit l is the flag of lane l.
template <int W>
PLEKTON_INLINE unsigned bits_of(const Pack<W>& flags) noexcept {
  constexpr double kBits[] = {1, 2, 4, 8, 16, 32, 64, 128};
  const Pack<W> bits = flags * Pack<W>::load(kBits);
  return static_cast<unsigned>(
      static_cast<int>(detail::sum_of_lanes(bits, std::make_integer_sequence<int, W / 2>())));
}
/// bits_of flags that are all 1.
template <int W>
constexpr unsigned kAllBits = (1U << W) - 1U;

/// The smaller of two numbers; y if they cannot be compared.
template <class Real>
PLEKTON_INLINE Real smaller_of(const Real& x, const Real& y) noexcept {
  return select(y > x, x, y);
}

/// The larger of two numbers; y if they cannot be compared.
template <class Real>
PLEKTON_INLINE Real larger_of(const Real& x, const Real& y) noexcept {
  return select(x > y, x, y);
}

/// x if it is positive, otherwise (also for NaN) 0.
template <class Real>
PLEKTON_INLINE Real positive_part(const Real& x) noexcept {
  return select(x > Real(0.0), x, Real(0.0));
}

template <int W>
PLEKTON_INLINE Pack<W> square_root(const Pack<W>& x) noexcept {
  Pack<W> root;
  for (int lane = 0; lane < W; ++lane) root.lanes[lane] = std::sqrt(x.lanes[lane]);
  return root;
}
PLEKTON_INLINE double square_root(double x) noexcept {
  return std::sqrt(x);
}

/// A vector of packs, with the names of Vec3.
template <class Real>
struct PackVec3 {
  Real x, y, z;

  PLEKTON_INLINE static PackVec3 Zero() noexcept { return {0.0, 0.0, 0.0}; }

  /// Added in the order in which Eigen adds the components of a Vec3 where it does not vectorise
  /// (types.hpp).
  PLEKTON_INLINE Real dot(const PackVec3& v) const noexcept {
    return x * v.x + (y * v.y + z * v.z);
  }
  PLEKTON_INLINE PackVec3 cross(const PackVec3& v) const noexcept {
    return {y * v.z - z * v.y, z * v.x - x * v.z, x * v.y - y * v.x};
  }
  PLEKTON_INLINE Real squaredNorm() const noexcept { return dot(*this); }
  PLEKTON_INLINE Real norm() const noexcept { return square_root(squaredNorm()); }

  PLEKTON_INLINE friend PackVec3 operator+(const PackVec3& u, const PackVec3& v) noexcept {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
  }
  PLEKTON_INLINE friend PackVec3 operator-(const PackVec3& u, const PackVec3& v) noexcept {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
  }
  PLEKTON_INLINE friend PackVec3 operator*(const Real& s, const PackVec3& v) noexcept {
    return {s * v.x, s * v.y, s * v.z};
  }
};

/// The vector of a formula written for Real.
template <class Real>
using Vec3Of = std::conditional_t<std::is_same_v<Real, double>, Vec3, PackVec3<Real>>;

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/elementary.hpp"
#include "geometry/base/pack.hpp"

#include <cmath>

namespace plekton::geometry {

/// cos(x) and sin(x) / x, the latter 1 at 0.
template <class Real>
struct CosineAndSincOf {
  Real cosine;
  Real sinc;
};
using CosineAndSinc = CosineAndSincOf<double>;

/// Largest x² (rad²) that the series are made for.
constexpr double kSmallAngleSquared = 0.01;

/// The series to x^10 and x^8 from x²: exact to 1e-17 up to kSmallAngleSquared.
template <class Real>
PLEKTON_INLINE CosineAndSincOf<Real> cosine_and_sinc_of_small(const Real& y) noexcept {
  const Real one = 1.0;
  return {one - y * Real(1.0 / 2) *
                    (one - y * Real(1.0 / 12) *
                               (one - y * Real(1.0 / 30) *
                                          (one - y * Real(1.0 / 56) * (one - y * Real(1.0 / 90))))),
          one - y * Real(1.0 / 6) *
                    (one -
                     y * Real(1.0 / 20) * (one - y * Real(1.0 / 42) * (one - y * Real(1.0 / 72))))};
}

/// From x² (rad²), so that no square root is needed for the small angles of a time step: for larger
/// ones the elementary functions.
inline CosineAndSinc cosine_and_sinc(double x_squared) noexcept {
  if (x_squared < kSmallAngleSquared) return cosine_and_sinc_of_small(x_squared);
  const double x = std::sqrt(x_squared);
  return {elementary::cos(x), elementary::sin(x) / x};
}

/// Side by side, for small angles only.
template <int W>
PLEKTON_INLINE CosineAndSincOf<Pack<W>> cosine_and_sinc(const Pack<W>& x_squared) noexcept {
  return cosine_and_sinc_of_small(x_squared);
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/types.hpp"

#include <cmath>
#include <cstdint>

/// Exact signs: every decision of the contact rule rests on these two, and on nothing else.
///
/// Each is decided in three stages: a double with a proven error bound, then interval arithmetic,
/// then exact multi-precision arithmetic. The sign is that of the real number defined by the stored
/// doubles, so it is the same for any compiler, machine and thread, and in any rounding mode, which
/// is left as it was. Coordinates must be finite and below 1e75 in magnitude.
namespace plekton::geometry {

/// How often each stage decided a sign, since the start of the thread. For reports and tests.
struct SignCounters {
  std::uint64_t interval = 0;  ///< the double filter could not tell
  std::uint64_t exact = 0;     ///< nor could the interval
};
SignCounters& sign_counters() noexcept;

namespace detail {

int past_vertex_exact(const Vec3& a, const Vec3& b, const Vec3& p) noexcept;
int inside_edge_exact(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) noexcept;

/// Half an ulp of 1.
constexpr double kRoundoff = 0x1p-53;
/// Below this an underflow in one product (5e-324, times other factors up to 1e150) could outweigh
/// the error bounds.
constexpr double kUnderflow = 1e-150;

}  // namespace detail

/// Sign of (p - a).(b - a): +1 if p lies on b's side of the plane through a that is perpendicular
/// to the edge ab. Zero on that plane, and for an edge without length. Error: three products of two
/// rounded differences, each with relative error at most 3 roundoff, and two additions: |error| <=
/// 5 roundoff sum |terms| to first order. In a directed rounding mode each error doubles, but a sum
/// that could have the wrong sign is nearly zero and the sum before it at most half of all
/// terms: 7. 8 covers the higher orders.
inline int sign_past_vertex(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  const Vec3 terms = (p - a).cwiseProduct(b - a);
  const double sum = terms[0] + terms[1] + terms[2];
  const double magnitude = std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]);
  if (std::abs(sum) > 8.0 * detail::kRoundoff * magnitude && magnitude > detail::kUnderflow) {
    return sum > 0.0 ? 1 : -1;
  }
  return detail::past_vertex_exact(a, b, p);
}

/// Sign of ((b - a) x (o - a)).((b - a) x (p - a)): +1 if, seen along the edge ab, p lies less than
/// 90 degrees off the half-plane from the edge towards the opposite corner o. Zero at 90 degrees,
/// on the line of the edge, and for a triangle without area. Error: a component of a cross product
/// of rounded differences has error at most 4 roundoff times the sum of its two products'
/// magnitudes, the product of two such 9, the sum of three 11 to first order, and 22 in a directed
/// rounding mode; 24 covers the higher orders.
inline int sign_inside_edge(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) noexcept {
  const Vec3 u = b - a;
  const Vec3 v = o - a;
  const Vec3 w = p - a;
  double sum = 0.0;
  double magnitude = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double v_left = u[j] * v[k];
    const double v_right = u[k] * v[j];
    const double w_left = u[j] * w[k];
    const double w_right = u[k] * w[j];
    sum += (v_left - v_right) * (w_left - w_right);
    magnitude += (std::abs(v_left) + std::abs(v_right)) * (std::abs(w_left) + std::abs(w_right));
  }
  if (std::abs(sum) > 24.0 * detail::kRoundoff * magnitude && magnitude > detail::kUnderflow) {
    return sum > 0.0 ? 1 : -1;
  }
  return detail::inside_edge_exact(a, b, o, p);
}

}  // namespace plekton::geometry

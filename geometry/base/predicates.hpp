// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cmath>
#include <cstdint>

/// Exact signs: every decision of the contact rule and of the nearest points of two primitives
/// rests on these, and on nothing else.
///
/// Each is decided in stages: a double with a proven error bound, a pair of doubles with one,
/// interval arithmetic (which tells zeros of small whole numbers), and exact multi-precision
/// arithmetic. The sign is that of the real number defined by the stored
/// doubles, so it is the same for any compiler, machine and thread, and in any rounding mode, which
/// is left as it was. Coordinates must be finite and below 1e75 in magnitude.
namespace plekton::geometry {

/// How often each stage decided a sign, since the start of the thread. For reports and tests.
struct SignCounters {
  std::uint64_t double_double = 0;  ///< the double filter could not tell
  std::uint64_t interval = 0;       ///< nor could twice the precision
  std::uint64_t exact = 0;          ///< nor could an interval
};
SignCounters& sign_counters() noexcept;

/// The difference of two positions, not yet rounded.
struct Difference {
  const Vec3& from;
  const Vec3& to;

  Vec3 rounded() const noexcept { return to - from; }
};

namespace detail {

/// @param magnitude  the sum of the magnitudes of all terms, rounded
int past_vertex_exact(const Vec3& a, const Vec3& b, const Vec3& p, double magnitude) noexcept;
int crosses_exact(const Difference& u, const Difference& v, const Difference& w,
                  double magnitude) noexcept;
int volume_exact(const Difference& u, const Difference& v, const Difference& w,
                 double magnitude) noexcept;

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
  return detail::past_vertex_exact(a, b, p, magnitude);
}

/// Sign of (u x v).(u x w): +1 if, seen along u, the directions v and w are less than 90 degrees
/// apart. Zero at 90 degrees, and if u is parallel to v or w or any of them has no length. Error: a
/// component of a cross product of rounded differences has error at most 4 roundoff times the sum
/// of its two products' magnitudes, the product of two such 9, the sum of three 11 to first order,
/// and 22 in a directed rounding mode; 24 covers the higher orders.
inline int sign_of_crosses(const Difference& u, const Difference& v, const Difference& w) noexcept {
  const Vec3 along = u.rounded();
  const Vec3 left = v.rounded();
  const Vec3 right = w.rounded();
  double sum = 0.0;
  double magnitude = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double v_left = along[j] * left[k];
    const double v_right = along[k] * left[j];
    const double w_left = along[j] * right[k];
    const double w_right = along[k] * right[j];
    sum += (v_left - v_right) * (w_left - w_right);
    magnitude += (std::abs(v_left) + std::abs(v_right)) * (std::abs(w_left) + std::abs(w_right));
  }
  if (std::abs(sum) > 24.0 * detail::kRoundoff * magnitude && magnitude > detail::kUnderflow) {
    return sum > 0.0 ? 1 : -1;
  }
  return detail::crosses_exact(u, v, w, magnitude);
}

/// Sign of det(u, v, w) = (u x v).w: on which side of the plane of u and v the direction w leads.
/// Zero if the three lie in one plane. Error: a component of the cross product as above 4 roundoff,
/// its product with a rounded difference 6, the sum of three 8 to first order and 16 in a directed
/// rounding mode; 18 covers the higher orders.
inline int sign_of_volume(const Difference& u, const Difference& v, const Difference& w) noexcept {
  const Vec3 first = u.rounded();
  const Vec3 second = v.rounded();
  const Vec3 third = w.rounded();
  double sum = 0.0;
  double magnitude = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double left = first[j] * second[k];
    const double right = first[k] * second[j];
    sum += (left - right) * third[i];
    magnitude += (std::abs(left) + std::abs(right)) * std::abs(third[i]);
  }
  if (std::abs(sum) > 18.0 * detail::kRoundoff * magnitude && magnitude > detail::kUnderflow) {
    return sum > 0.0 ? 1 : -1;
  }
  return detail::volume_exact(u, v, w, magnitude);
}

/// Lengths that no cancellation spoils, for where the double result is not good enough: slow (a
/// microsecond or two) where it takes exact arithmetic. Each component is rounded once or twice, or
/// within 2^-42 of the length.
///
/// The part of w perpendicular to u, which has a length (m).
Vec3 exact_part_across(const Difference& w, const Difference& u) noexcept;
/// The part of w along the common perpendicular of u and v, which are not parallel (m).
Vec3 exact_part_along_normal(const Difference& w, const Difference& u,
                             const Difference& v) noexcept;
/// Shares of the start, the end of u and the end of v in the foot of w's end on the plane that u
/// and v, which are not parallel, span from their common start with w. They add up to 1.
Vec3 exact_shares(const Difference& w, const Difference& u, const Difference& v) noexcept;

/// det(u, v, w) (m³).
double exact_volume(const Difference& u, const Difference& v, const Difference& w) noexcept;

/// Sign of ((b - a) x (o - a)).((b - a) x (p - a)): +1 if, seen along the edge ab, p lies less than
/// 90 degrees off the half-plane from the edge towards the opposite corner o. Zero at 90 degrees,
/// on the line of the edge, and for a triangle without area.
inline int sign_inside_edge(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) noexcept {
  return sign_of_crosses({a, b}, {a, o}, {a, p});
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/predicates.hpp"

#include "geometry/base/double_double.hpp"
#include "geometry/base/sign_totals.hpp"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <optional>

namespace plekton::geometry {
namespace {

using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// The polynomials, for any ring of numbers.
template <class Number>
struct DifferenceOf {
  std::array<Number, 3> v;
  DifferenceOf(const Vec3& to, const Vec3& from)
      : v{Number(to[0]) - Number(from[0]), Number(to[1]) - Number(from[1]),
          Number(to[2]) - Number(from[2])} {}
  explicit DifferenceOf(const Difference& of) : DifferenceOf(of.to, of.from) {}
};

/// Of two doubles that is one exact sum.
template <>
DifferenceOf<DoubleDouble>::DifferenceOf(const Vec3& to, const Vec3& from)
    : v{DoubleDouble::difference(to[0], from[0]), DoubleDouble::difference(to[1], from[1]),
        DoubleDouble::difference(to[2], from[2])} {}

template <class Number>
using Triple = std::array<Number, 3>;

template <class Number>
Number dot(const Triple<Number>& u, const Triple<Number>& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

template <class Number>
Triple<Number> cross(const Triple<Number>& u, const Triple<Number>& v) {
  return {Number(u[1] * v[2] - u[2] * v[1]), Number(u[2] * v[0] - u[0] * v[2]),
          Number(u[0] * v[1] - u[1] * v[0])};
}

template <class Number>
Number past_vertex(const Vec3& a, const Vec3& b, const Vec3& p) {
  return dot(DifferenceOf<Number>(b, a).v, DifferenceOf<Number>(p, a).v);
}

template <class Number>
Number product_of_crosses(const Difference& u, const Difference& v, const Difference& w) {
  const DifferenceOf<Number> along(u);
  return dot(cross(along.v, DifferenceOf<Number>(v).v), cross(along.v, DifferenceOf<Number>(w).v));
}

template <class Number>
Number volume(const Difference& u, const Difference& v, const Difference& w) {
  return dot(cross(DifferenceOf<Number>(u).v, DifferenceOf<Number>(v).v),
             DifferenceOf<Number>(w).v);
}

/// Sign of an interval, or 2 if it holds both signs.
int sign_if_certain(const Interval& value) noexcept {
  if (value.inf() > 0.0) return 1;
  if (value.sup() < 0.0) return -1;
  return value.inf() == 0.0 && value.sup() == 0.0 ? 0 : 2;
}

int sign_of(const Exact& value) {
  return static_cast<int>(CGAL::sign(value));
}

/// Evaluates a polynomial in interval arithmetic with the rounding mode it needs, and restores the
/// mode.
template <class Polynomial>
int interval_sign(Polynomial polynomial) noexcept {
  count_sign(sign_counters().interval);
  const CGAL::Protect_FPU_rounding<true> rounding;
  return sign_if_certain(polynomial());
}

/// Sign of a polynomial in twice the precision of a double, or 2 if that does not tell.
///
/// Error: of a sum of products of differences as in the filters of predicates.hpp, with 3 u² for a
/// sum and 7 u² for a product: 13 u² (past a vertex), 23 u² (volume) and 33 u² (crosses) of the sum
/// of magnitudes that the filter has; 64 covers the higher orders and the rounding of that sum.
/// Magnitudes above kUnderflow keep what underflows, 5e-324 times other factors up to 1e150, far
/// below that.
template <class Polynomial>
int double_double_sign(double magnitude, Polynomial polynomial) noexcept {
  constexpr double kError = 64.0 * detail::kRoundoff * detail::kRoundoff;
  constexpr double kSmallest = 1e-130;
  if (!(magnitude > kSmallest) || std::fegetround() != FE_TONEAREST) return 2;
  count_sign(sign_counters().double_double);
  const double value = polynomial().high();
  if (std::abs(value) > kError * magnitude) return value > 0.0 ? 1 : -1;
  return 2;
}

/// A number as mantissa * 2^exponent: what a double alone may be too short for.
struct Scaled {
  double mantissa;
  int exponent;
};

/// Rounded to a double or next to it.
Scaled scaled(Exact number) {
  constexpr int kStep = 600;
  int exponent = 0;
  while (true) {
    const double value = CGAL::to_double(number);
    const bool is_small = std::abs(value) < 0x1p-600 && CGAL::sign(number) != CGAL::ZERO;
    if (!is_small && std::abs(value) < 0x1p600) return {value, exponent};
    number = number * Exact(is_small ? 0x1p600 : 0x1p-600);
    exponent += is_small ? -kStep : kStep;
  }
}

Vec3 quotient(const Triple<Exact>& numerator, const Exact& denominator) {
  const Scaled below = scaled(denominator);
  Vec3 result;
  for (int i = 0; i < 3; ++i) {
    const Scaled above = scaled(numerator[static_cast<std::size_t>(i)]);
    result[i] = std::ldexp(above.mantissa / below.mantissa, above.exponent - below.exponent);
  }
  return result;
}

/// The part of w across u in twice the precision, if that is enough. With cross products within 10
/// u² and 20 u² of the magnitudes of their terms, at most 2 and 4 times the lengths, the error is
/// below 2^-99 |w|, which is 2^-43 of a result of 2^-56 |w|.
std::optional<Vec3> part_across(const Difference& w, const Difference& u) noexcept {
  constexpr double kSmallest = 1e-60;
  const double length_w = w.rounded().cwiseAbs().maxCoeff();
  const double length_u = u.rounded().cwiseAbs().maxCoeff();
  if (!(std::min(length_w, length_u) > kSmallest) || std::fegetround() != FE_TONEAREST)
    return std::nullopt;
  const Triple<DoubleDouble> along = DifferenceOf<DoubleDouble>(u).v;
  const Triple<DoubleDouble> part = cross(cross(along, DifferenceOf<DoubleDouble>(w).v), along);
  const double square = dot(along, along).high();
  const Vec3 result(part[0].high() / square, part[1].high() / square, part[2].high() / square);
  if (!(result.cwiseAbs().maxCoeff() > 0x1p-56 * length_w)) return std::nullopt;
  return result;
}

}  // namespace

namespace detail {

int past_vertex_exact(const Vec3& a, const Vec3& b, const Vec3& p, double magnitude) noexcept {
  const int quick =
      double_double_sign(magnitude, [&] { return past_vertex<DoubleDouble>(a, b, p); });
  if (quick != 2) return quick;
  const int sign = interval_sign([&] { return past_vertex<Interval>(a, b, p); });
  if (sign != 2) return sign;
  count_sign(sign_counters().exact);
  return sign_of(past_vertex<Exact>(a, b, p));
}

int crosses_exact(const Difference& u, const Difference& v, const Difference& w,
                  double magnitude) noexcept {
  const int quick =
      double_double_sign(magnitude, [&] { return product_of_crosses<DoubleDouble>(u, v, w); });
  if (quick != 2) return quick;
  const int sign = interval_sign([&] { return product_of_crosses<Interval>(u, v, w); });
  if (sign != 2) return sign;
  count_sign(sign_counters().exact);
  return sign_of(product_of_crosses<Exact>(u, v, w));
}

int volume_exact(const Difference& u, const Difference& v, const Difference& w,
                 double magnitude) noexcept {
  const int quick = double_double_sign(magnitude, [&] { return volume<DoubleDouble>(u, v, w); });
  if (quick != 2) return quick;
  const int sign = interval_sign([&] { return volume<Interval>(u, v, w); });
  if (sign != 2) return sign;
  count_sign(sign_counters().exact);
  return sign_of(volume<Exact>(u, v, w));
}

}  // namespace detail

Vec3 exact_part_across(const Difference& w, const Difference& u) noexcept {
  if (const auto part = part_across(w, u)) return *part;
  const Triple<Exact> along = DifferenceOf<Exact>(u).v;
  const Triple<Exact> part = cross(cross(along, DifferenceOf<Exact>(w).v), along);
  return quotient(part, dot(along, along));
}

Vec3 exact_part_along_normal(const Difference& w, const Difference& u,
                             const Difference& v) noexcept {
  const Triple<Exact> normal = cross(DifferenceOf<Exact>(u).v, DifferenceOf<Exact>(v).v);
  const Exact height = dot(normal, DifferenceOf<Exact>(w).v);
  return quotient({Exact(normal[0] * height), Exact(normal[1] * height), Exact(normal[2] * height)},
                  dot(normal, normal));
}

Vec3 exact_shares(const Difference& w, const Difference& u, const Difference& v) noexcept {
  const Triple<Exact> along_u = DifferenceOf<Exact>(u).v;
  const Triple<Exact> along_v = DifferenceOf<Exact>(v).v;
  const Triple<Exact> to_point = DifferenceOf<Exact>(w).v;
  const Triple<Exact> normal = cross(along_u, along_v);
  const Exact of_u = dot(cross(to_point, along_v), normal);
  const Exact of_v = dot(cross(along_u, to_point), normal);
  const Exact square = dot(normal, normal);
  return quotient({Exact(square - of_u - of_v), of_u, of_v}, square);
}

double exact_volume(const Difference& u, const Difference& v, const Difference& w) noexcept {
  return CGAL::to_double(volume<Exact>(u, v, w));
}

}  // namespace plekton::geometry

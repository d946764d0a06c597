// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/predicates.hpp"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <array>

namespace plekton::geometry {
namespace {

using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// The polynomials, for any ring of numbers.
template <class Number>
struct Difference {
  std::array<Number, 3> v;
  Difference(const Vec3& to, const Vec3& from)
      : v{Number(to[0]) - Number(from[0]), Number(to[1]) - Number(from[1]),
          Number(to[2]) - Number(from[2])} {}
  explicit Difference(const Arrow& arrow) : Difference(arrow.to, arrow.from) {}
};

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
  return dot(Difference<Number>(b, a).v, Difference<Number>(p, a).v);
}

template <class Number>
Number product_of_crosses(const Arrow& u, const Arrow& v, const Arrow& w) {
  const Difference<Number> along(u);
  return dot(cross(along.v, Difference<Number>(v).v), cross(along.v, Difference<Number>(w).v));
}

template <class Number>
Number volume(const Arrow& u, const Arrow& v, const Arrow& w) {
  return dot(cross(Difference<Number>(u).v, Difference<Number>(v).v), Difference<Number>(w).v);
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
  ++sign_counters().interval;
  const CGAL::Protect_FPU_rounding<true> rounding;
  return sign_if_certain(polynomial());
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

}  // namespace

SignCounters& sign_counters() noexcept {
  thread_local SignCounters counters;
  return counters;
}

namespace detail {

int past_vertex_exact(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  const int sign = interval_sign([&] { return past_vertex<Interval>(a, b, p); });
  if (sign != 2) return sign;
  ++sign_counters().exact;
  return sign_of(past_vertex<Exact>(a, b, p));
}

int crosses_exact(const Arrow& u, const Arrow& v, const Arrow& w) noexcept {
  const int sign = interval_sign([&] { return product_of_crosses<Interval>(u, v, w); });
  if (sign != 2) return sign;
  ++sign_counters().exact;
  return sign_of(product_of_crosses<Exact>(u, v, w));
}

int volume_exact(const Arrow& u, const Arrow& v, const Arrow& w) noexcept {
  const int sign = interval_sign([&] { return volume<Interval>(u, v, w); });
  if (sign != 2) return sign;
  ++sign_counters().exact;
  return sign_of(volume<Exact>(u, v, w));
}

}  // namespace detail

Vec3 exact_part_across(const Arrow& w, const Arrow& u) noexcept {
  const Triple<Exact> along = Difference<Exact>(u).v;
  const Triple<Exact> part = cross(cross(along, Difference<Exact>(w).v), along);
  return quotient(part, dot(along, along));
}

Vec3 exact_part_along_normal(const Arrow& w, const Arrow& u, const Arrow& v) noexcept {
  const Triple<Exact> normal = cross(Difference<Exact>(u).v, Difference<Exact>(v).v);
  const Exact height = dot(normal, Difference<Exact>(w).v);
  return quotient({Exact(normal[0] * height), Exact(normal[1] * height), Exact(normal[2] * height)},
                  dot(normal, normal));
}

Vec3 exact_shares(const Arrow& w, const Arrow& u, const Arrow& v) noexcept {
  const Triple<Exact> along_u = Difference<Exact>(u).v;
  const Triple<Exact> along_v = Difference<Exact>(v).v;
  const Triple<Exact> to_point = Difference<Exact>(w).v;
  const Triple<Exact> normal = cross(along_u, along_v);
  const Exact of_u = dot(cross(to_point, along_v), normal);
  const Exact of_v = dot(cross(along_u, to_point), normal);
  const Exact square = dot(normal, normal);
  return quotient({Exact(square - of_u - of_v), of_u, of_v}, square);
}

double exact_volume(const Arrow& u, const Arrow& v, const Arrow& w) noexcept {
  return CGAL::to_double(volume<Exact>(u, v, w));
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/predicates.hpp"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <array>

namespace plekton::geometry {
namespace {

using Interval = CGAL::Interval_nt<false>;

/// The two polynomials, for any ring of numbers.
template <class Number>
struct Difference {
  std::array<Number, 3> v;
  Difference(const Vec3& to, const Vec3& from)
      : v{Number(to[0]) - Number(from[0]), Number(to[1]) - Number(from[1]),
          Number(to[2]) - Number(from[2])} {}
};

template <class Number>
Number past_vertex(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Difference<Number> u(b, a);
  const Difference<Number> w(p, a);
  return u.v[0] * w.v[0] + u.v[1] * w.v[1] + u.v[2] * w.v[2];
}

template <class Number>
Number inside_edge(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) {
  const Difference<Number> u(b, a);
  const Difference<Number> v(o, a);
  const Difference<Number> w(p, a);
  const auto term = [&](std::size_t j, std::size_t k) {
    return Number((u.v[j] * v.v[k] - u.v[k] * v.v[j]) * (u.v[j] * w.v[k] - u.v[k] * w.v[j]));
  };
  return term(1, 2) + term(2, 0) + term(0, 1);
}

/// Sign of an interval, or 2 if it holds both signs.
int sign_if_certain(const Interval& value) noexcept {
  if (value.inf() > 0.0) return 1;
  if (value.sup() < 0.0) return -1;
  return value.inf() == 0.0 && value.sup() == 0.0 ? 0 : 2;
}

int sign_of(const CGAL::Mpzf& value) {
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
  return sign_of(past_vertex<CGAL::Mpzf>(a, b, p));
}

int inside_edge_exact(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) noexcept {
  const int sign = interval_sign([&] { return inside_edge<Interval>(a, b, o, p); });
  if (sign != 2) return sign;
  ++sign_counters().exact;
  return sign_of(inside_edge<CGAL::Mpzf>(a, b, o, p));
}

}  // namespace detail
}  // namespace plekton::geometry

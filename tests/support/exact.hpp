// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdint>

/// Exact reference for signs and closest points, written without any part of the library.
///
/// A double is an integer times a power of two. The coordinates of a query are brought to one power
/// of two, and from there on everything is integer arithmetic of unlimited length; quotients are
/// kept as numerator and denominator.
namespace plekton::test {

using Integer = boost::multiprecision::cpp_int;
using IntegerVec = std::array<Integer, 3>;
using geometry::Vec3;

/// The doubles of N points, each coordinate exactly integer * 2^exponent.
template <std::size_t N>
struct ScaledPoints {
  std::array<IntegerVec, N> points;
  int exponent;
};

/// A finite double as odd integer * 2^exponent; zero has the largest exponent, so that it never
/// sets the scale.
struct Dyadic {
  std::int64_t integer = 0;
  int exponent = INT_MAX;

  explicit Dyadic(double value) {
    if (value == 0.0) return;
    integer = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(integer));
    integer >>= zeros;
    exponent += zeros - 53;
  }
};

template <std::size_t N>
ScaledPoints<N> scaled(const std::array<Vec3, N>& points) {
  ScaledPoints<N> result{{}, INT_MAX};
  for (const Vec3& point : points) {
    for (int k = 0; k < 3; ++k)
      result.exponent = std::min(result.exponent, Dyadic(point[k]).exponent);
  }
  for (std::size_t i = 0; i < N; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Dyadic dyadic(points[i][k]);
      if (dyadic.integer == 0) continue;
      Integer& coordinate = result.points[i][static_cast<std::size_t>(k)];
      coordinate = dyadic.integer;
      coordinate <<= dyadic.exponent - result.exponent;
    }
  }
  if (result.exponent == INT_MAX) result.exponent = 0;
  return result;
}

inline IntegerVec difference(const IntegerVec& to, const IntegerVec& from) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
inline Integer dot(const IntegerVec& a, const IntegerVec& b) {
  return Integer(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
inline IntegerVec cross(const IntegerVec& a, const IntegerVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Sign of (p - a).(b - a).
inline int exact_sign_past_vertex(const Vec3& a, const Vec3& b, const Vec3& p) {
  const auto s = scaled(std::array{a, b, p});
  return dot(difference(s.points[2], s.points[0]), difference(s.points[1], s.points[0])).sign();
}

/// Sign of ((b - a) x (o - a)).((b - a) x (p - a)).
inline int exact_sign_inside_edge(const Vec3& a, const Vec3& b, const Vec3& o, const Vec3& p) {
  const auto s = scaled(std::array{a, b, o, p});
  const IntegerVec u = difference(s.points[1], s.points[0]);
  return dot(cross(u, difference(s.points[2], s.points[0])),
             cross(u, difference(s.points[3], s.points[0])))
      .sign();
}

/// Nearest point of a simplex: sum weights[k] / denominator * corner k.
struct ExactFoot {
  std::array<Integer, 3> weights;
  Integer denominator;       ///< > 0
  Integer squared_distance;  ///< times denominator, in units of 4^exponent m²
  int exponent;

  /// Bit k: corner k carries weight. One bit is a node, two an edge, three the face.
  unsigned witness_features() const {
    unsigned bits = 0;
    for (unsigned k = 0; k < 3; ++k) bits |= static_cast<unsigned>(weights[k] != 0) << k;
    return bits;
  }
  /// Distance (m), rounded once or twice in long double.
  long double distance() const {
    return std::ldexp(std::sqrt(squared_distance.convert_to<long double>() /
                                denominator.convert_to<long double>()),
                      exponent);
  }
  /// Barycentric coordinate, rounded once or twice in long double.
  long double weight(std::size_t k) const {
    return weights[k].convert_to<long double>() / denominator.convert_to<long double>();
  }
};

/// -1, 0 or +1 as the first distance is smaller, equal or larger.
inline int compare_distances(const ExactFoot& a, const ExactFoot& b) {
  Integer left = a.squared_distance * b.denominator;
  Integer right = b.squared_distance * a.denominator;
  const int shift = 2 * (a.exponent - b.exponent);
  (shift > 0 ? left : right) <<= static_cast<unsigned>(std::abs(shift));
  return left.compare(right) < 0 ? -1 : static_cast<int>(left.compare(right) > 0);
}

/// Nearest point of a node, a segment or a triangle (1, 2 or 3 corners) to a point: the least of
/// the perpendicular feet on all its nodes, sides and the face that have positive weights. Equal
/// distances go to the lower-dimensional one, then to the lower corners (01, 02, 12): only
/// simplices without area or length have such ties.
template <std::size_t N>
ExactFoot exact_foot(const Vec3& p, const std::array<Vec3, N>& x) {
  static_assert(N >= 1 && N <= 3);
  std::array<Vec3, N + 1> all;
  std::copy(x.begin(), x.end(), all.begin());
  all[N] = p;
  const auto s = scaled(all);
  std::array<IntegerVec, N> to_point;  // p - x_k
  for (std::size_t k = 0; k < N; ++k) to_point[k] = difference(s.points[N], s.points[k]);

  ExactFoot best{};
  bool found = false;
  const auto offer = [&](const std::array<Integer, 3>& weights, const Integer& denominator,
                         const Integer& squared) {
    ExactFoot candidate{weights, denominator, squared, s.exponent};
    if (!found || compare_distances(candidate, best) < 0) best = std::move(candidate);
    found = true;
  };
  for (std::size_t k = 0; k < N; ++k) {
    std::array<Integer, 3> weights{};
    weights[k] = 1;
    offer(weights, 1, dot(to_point[k], to_point[k]));
  }
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = i + 1; j < N; ++j) {
      const IntegerVec u = difference(s.points[j], s.points[i]);
      const Integer length = dot(u, u);
      const Integer along = dot(to_point[i], u);
      if (along.sign() <= 0 || along >= length) continue;
      std::array<Integer, 3> weights{};
      weights[i] = length - along;
      weights[j] = along;
      offer(weights, length, dot(to_point[i], to_point[i]) * length - along * along);
    }
  }
  if constexpr (N == 3) {
    const IntegerVec u = difference(s.points[1], s.points[0]);
    const IntegerVec v = difference(s.points[2], s.points[0]);
    const IntegerVec normal = cross(u, v);
    const Integer area = dot(normal, normal);
    const Integer w1 = dot(cross(to_point[0], v), normal);
    const Integer w2 = dot(cross(u, to_point[0]), normal);
    const Integer w0 = area - w1 - w2;
    const Integer height = dot(to_point[0], normal);
    if (w0.sign() > 0 && w1.sign() > 0 && w2.sign() > 0) offer({w0, w1, w2}, area, height * height);
  }
  return best;
}

}  // namespace plekton::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/closest_points.hpp"
#include "tests/support/exact.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

/// Exact judge of the nearest points of two convex cores, written without any part of the library.
///
/// A pair of points is nearest if and only if no corner lies on the wrong side of the planes
/// through them; both points, as those of the features that an answer names, are rational numbers.
/// So an answer is proven or disproven without a search.
namespace plekton::test {

using geometry::ClosestPoints;
using geometry::Relation;

/// Weighted corners over a common denominator; all weights > 0, or the foot points are not inside.
struct ExactPoints {
  std::array<Integer, 3> weights_a;
  std::array<Integer, 3> weights_b;
  Integer denominator;
  IntegerVec separation;  ///< times the denominator, in units of 2^exponent m
};

inline IntegerVec scaled_by(const Integer& factor, const IntegerVec& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}
inline IntegerVec sum(const IntegerVec& u, const IntegerVec& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}

/// Two cores in integers.
class ExactPair {
 public:
  ExactPair(std::span<const Vec3> a, std::span<const Vec3> b)
      : count_a_(a.size()), count_b_(b.size()) {
    std::array<Vec3, 6> all;
    all.fill(a[0]);
    std::copy(a.begin(), a.end(), all.begin());
    std::copy(b.begin(), b.end(), all.begin() + 3);
    const auto s = scaled(all);
    for (std::size_t k = 0; k < 3; ++k) {
      a_[k] = s.points[k];
      b_[k] = s.points[k + 3];
    }
    exponent_ = s.exponent;
  }

  int exponent() const { return exponent_; }

  /// The nearest points of the lines, planes or corners that span two features, if they are inside
  /// both and unique.
  std::optional<ExactPoints> feet(unsigned of_a, unsigned of_b) const {
    const int count_a = std::popcount(of_a);
    const int count_b = std::popcount(of_b);
    if (count_a == 2 && count_b == 2) return side_side(of_a, of_b);
    if (count_a == 1) return corner_on(a_[first(of_a)], of_a, b_, of_b);
    if (count_b == 1) {
      auto swapped = corner_on(b_[first(of_b)], of_b, a_, of_a);
      if (swapped) {
        std::swap(swapped->weights_a, swapped->weights_b);
        swapped->separation = scaled_by(-1, swapped->separation);
      }
      return swapped;
    }
    if (count_a == 2) return side_through_face(a_, of_a, b_);
    auto swapped = side_through_face(b_, of_b, a_);
    if (swapped) std::swap(swapped->weights_a, swapped->weights_b);
    return swapped;
  }

  /// Whether no point of the cores is nearer: no corner is on the wrong side of a plane.
  bool are_nearest(const ExactPoints& points) const {
    const IntegerVec p = position(a_, points.weights_a);
    const IntegerVec q = position(b_, points.weights_b);
    for (std::size_t k = 0; k < count_a_; ++k) {
      const IntegerVec way = difference(scaled_by(points.denominator, a_[k]), p);
      if (dot(way, points.separation).sign() > 0) return false;
    }
    for (std::size_t k = 0; k < count_b_; ++k) {
      const IntegerVec way = difference(scaled_by(points.denominator, b_[k]), q);
      if (dot(way, points.separation).sign() < 0) return false;
    }
    return true;
  }

  /// Component of the separation (m), rounded once or twice in long double.
  long double separation(const ExactPoints& points, std::size_t i) const {
    return std::ldexp(points.separation[i].convert_to<long double>() /
                          points.denominator.convert_to<long double>(),
                      exponent_);
  }
  long double distance(const ExactPoints& points) const {
    return std::ldexp(
        std::sqrt(dot(points.separation, points.separation).convert_to<long double>()) /
            points.denominator.convert_to<long double>(),
        exponent_);
  }

 private:
  using Core = std::array<IntegerVec, 3>;

  static std::size_t first(unsigned bits) {
    return static_cast<std::size_t>(std::countr_zero(bits));
  }
  static std::size_t last(unsigned bits) {
    return static_cast<std::size_t>(std::bit_width(bits)) - 1;
  }

  static IntegerVec position(const Core& x, const std::array<Integer, 3>& weights) {
    IntegerVec point{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] != 0) point = sum(point, scaled_by(weights[k], x[k]));
    }
    return point;
  }

  static bool all_positive(const std::array<Integer, 3>& weights, unsigned feature) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((feature >> k & 1U) != 0 && weights[k].sign() <= 0) return false;
    }
    return true;
  }

  std::optional<ExactPoints> finished(ExactPoints points, const Core& x, unsigned of_x,
                                      const Core& y, unsigned of_y) const {
    if (points.denominator.sign() <= 0 || !all_positive(points.weights_a, of_x) ||
        !all_positive(points.weights_b, of_y)) {
      return std::nullopt;
    }
    points.separation = difference(position(y, points.weights_b), position(x, points.weights_a));
    return points;
  }

  /// Foot of a corner on a corner, side or face of the other core.
  std::optional<ExactPoints> corner_on(const IntegerVec& p, unsigned corner, const Core& x,
                                       unsigned feature) const {
    ExactPoints points{};
    if (std::popcount(feature) == 1) {
      points.denominator = 1;
      points.weights_b[first(feature)] = 1;
    } else if (std::popcount(feature) == 2) {
      const IntegerVec u = difference(x[last(feature)], x[first(feature)]);
      points.denominator = dot(u, u);
      points.weights_b[last(feature)] = dot(difference(p, x[first(feature)]), u);
      points.weights_b[first(feature)] = points.denominator - points.weights_b[last(feature)];
    } else {
      const IntegerVec u = difference(x[1], x[0]);
      const IntegerVec v = difference(x[2], x[0]);
      const IntegerVec w = difference(p, x[0]);
      const IntegerVec normal = cross(u, v);
      points.denominator = dot(normal, normal);
      points.weights_b[1] = dot(cross(w, v), normal);
      points.weights_b[2] = dot(cross(u, w), normal);
      points.weights_b[0] = points.denominator - points.weights_b[1] - points.weights_b[2];
    }
    points.weights_a[first(corner)] = points.denominator;
    const bool is_of_a = &x == &b_;
    return finished(points, is_of_a ? a_ : b_, corner, x, feature);
  }

  std::optional<ExactPoints> side_side(unsigned of_a, unsigned of_b) const {
    const IntegerVec u = difference(a_[last(of_a)], a_[first(of_a)]);
    const IntegerVec v = difference(b_[last(of_b)], b_[first(of_b)]);
    const IntegerVec w = difference(b_[first(of_b)], a_[first(of_a)]);
    const IntegerVec normal = cross(u, v);
    ExactPoints points{};
    points.denominator = dot(normal, normal);
    points.weights_a[last(of_a)] = dot(cross(w, v), normal);
    points.weights_a[first(of_a)] = points.denominator - points.weights_a[last(of_a)];
    points.weights_b[last(of_b)] = dot(cross(w, u), normal);
    points.weights_b[first(of_b)] = points.denominator - points.weights_b[last(of_b)];
    return finished(points, a_, of_a, b_, of_b);
  }

  /// Where a side goes through the plane of a face.
  std::optional<ExactPoints> side_through_face(const Core& x, unsigned side, const Core& y) const {
    const IntegerVec& from = x[first(side)];
    const IntegerVec along = difference(x[last(side)], from);
    const IntegerVec u = difference(y[1], y[0]);
    const IntegerVec v = difference(y[2], y[0]);
    const IntegerVec w = difference(from, y[0]);
    const IntegerVec normal = cross(u, v);
    Integer slope = -dot(normal, along);
    const int sign = slope.sign();
    if (sign == 0) return std::nullopt;
    ExactPoints points{};
    points.denominator = slope * sign;
    points.weights_a[last(side)] = dot(normal, w) * sign;
    points.weights_a[first(side)] = points.denominator - points.weights_a[last(side)];
    points.weights_b[1] = dot(along, cross(w, v)) * -sign;
    points.weights_b[2] = dot(along, cross(u, w)) * -sign;
    points.weights_b[0] = points.denominator - points.weights_b[1] - points.weights_b[2];
    return finished(points, x, side, y, 7U);
  }

  std::size_t count_a_;
  std::size_t count_b_;
  Core a_;
  Core b_;
  int exponent_;
};

/// What is wrong with an answer.
struct Judgement {
  bool wrong_region = false;    ///< other features hold the nearest points, or it is no answer
  bool wrong_relation = false;  ///< apart or structure pair is not true
  bool not_a_number = false;
  double relative_error = 0.0;  ///< of the distance and of the separation, over the distance
  double mismatch =
      0.0;  ///< of the weights: how far the points they give are from the separation, over the size
};

inline double weights_mismatch(std::span<const Vec3> a, std::span<const Vec3> b,
                               const ClosestPoints& answer) {
  using LongVec = Eigen::Matrix<long double, 3, 1>;
  LongVec rest = answer.separation.cast<long double>();
  long double size = 0.0L;
  const auto add = [&](std::span<const Vec3> x, const Vec3& weights, long double sign) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const LongVec way = x[k].cast<long double>() - a[0].cast<long double>();
      size = std::max(size, way.norm());
      rest += sign * static_cast<long double>(weights[static_cast<Eigen::Index>(k)]) * way;
    }
  };
  add(a, answer.weights_a, 1.0L);
  add(b, answer.weights_b, -1.0L);
  return size > 0.0L ? static_cast<double>(rest.norm() / size) : 0.0;
}

inline Judgement judge(std::span<const Vec3> a, std::span<const Vec3> b,
                       const ClosestPoints& answer) {
  Judgement judgement;
  judgement.not_a_number = !(std::isfinite(answer.distance) && answer.separation.allFinite() &&
                             answer.weights_a.allFinite() && answer.weights_b.allFinite());
  judgement.mismatch = weights_mismatch(a, b, answer);
  const ExactPair pair(a, b);
  const auto points = pair.feet(answer.corners_a, answer.corners_b);
  if (!points || !pair.are_nearest(*points)) {
    judgement.wrong_region = true;
    return judgement;
  }
  const bool meets = dot(points->separation, points->separation).is_zero();
  judgement.wrong_relation = meets != (answer.relation == Relation::touching_or_crossing);
  if (meets) {
    judgement.wrong_relation = judgement.wrong_relation || answer.distance != 0.0;
    return judgement;
  }
  const long double distance = pair.distance(*points);
  long double error = std::abs(answer.distance - distance);
  for (std::size_t i = 0; i < 3; ++i) {
    error = std::max(error, std::abs(answer.separation[static_cast<Eigen::Index>(i)] -
                                     pair.separation(*points, i)));
  }
  judgement.relative_error = static_cast<double>(error / distance);
  return judgement;
}

/// All pairs of features that carry nearest points, in the order in which a tie is decided if a is
/// the lower side.
inline std::vector<std::array<unsigned, 2>> all_witness_features(std::span<const Vec3> a,
                                                                 std::span<const Vec3> b) {
  constexpr std::array<std::array<int, 2>, 8> kCounts{
      {{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}, {2, 2}, {2, 3}, {3, 2}}};
  const ExactPair pair(a, b);
  std::vector<std::array<unsigned, 2>> found;
  for (const auto& [count_a, count_b] : kCounts) {
    for (unsigned of_a = 1; of_a < 1U << a.size(); ++of_a) {
      for (unsigned of_b = 1; of_b < 1U << b.size(); ++of_b) {
        if (std::popcount(of_a) != count_a || std::popcount(of_b) != count_b) continue;
        const auto points = pair.feet(of_a, of_b);
        if (points && pair.are_nearest(*points)) found.push_back({of_a, of_b});
      }
    }
  }
  return found;
}

}  // namespace plekton::test

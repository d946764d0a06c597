// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <algorithm>
#include <array>
#include <limits>

/// Quick answers, in plain double, to what the exact signs would say: certain or none at all.
namespace plekton::geometry {

/// Where the foot of a point lies on the plane of a triangle.
enum class FootPlace : std::uint8_t { inside, outside, uncertain };

/// A triangle and a point, in numbers that tell the certain cases apart.
///
/// With the sides u and v from corner 0, the offset w of the point from it, n = u x v and q = n x
/// w, sign_inside_edge() (predicates.hpp) is for side 0 that of s_0 = -u.q, for side 2 that of s_2
/// = v.q, and for side 1 that of n.n - s_0 - s_2: the three are n.n times the weights of the
/// corners opposite. Error: with L the longer one of u and v, and R of that and w, each of the
/// three dots is a sum of 12 products of four rounded differences of at most L^2 R^2, each product
/// with at most 11 roundoffs to first order; so each is within 1.5e-14 L^2 R^2 of its value, their
/// sum within 4.6e-14, and within twice that in a directed rounding mode. What is farther from zero
/// than 2e-13 L^2 R^2 has the exact sign.
class FaceView {
 public:
  FaceView(const Vec3& point, const std::array<Vec3, 3>& x) noexcept : point_(point), x_(x) {
    const Vec3 u = x[1] - x[0];
    const Vec3 v = x[2] - x[0];
    const Vec3 w = point - x[0];
    const Vec3 normal = u.cross(v);
    const Vec3 turned = normal.cross(w);
    normal_squared_ = normal.squaredNorm();
    height_ = normal.dot(w);
    offset_squared_ = w.squaredNorm();
    side_[0] = -u.dot(turned);
    side_[2] = v.dot(turned);
    side_[1] = normal_squared_ - side_[0] - side_[2];
    length_squared_ = std::max(u.squaredNorm(), v.squaredNorm());
    const double reach_squared = std::max(offset_squared_, length_squared_);
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    error_ = has_usual_size() && reach_squared < kLargest ? 2e-13 * length_squared_ * reach_squared
                                                          : kInfinite;
  }

  /// inside: all three exact signs are positive; outside: one of them is negative.
  FootPlace place() const noexcept {
    if (side_[0] > error_ && side_[1] > error_ && side_[2] > error_) return FootPlace::inside;
    if (is_across(0) || is_across(1) || is_across(2)) return FootPlace::outside;
    return FootPlace::uncertain;
  }

  /// Whether the triangle is surely farther than range (m) from the point, by the same reasons as
  /// distance_bound(), but without a root: a millionth of range weaker.
  bool is_beyond(double range) const noexcept;

  /// m, a lower bound of the distance between the point and the triangle; maybe negative.
  ///
  /// The triangle is no nearer than its plane; and if the foot on the plane is across a side, no
  /// nearer than the line of that side, because the foot's nearest point on the far side of the
  /// line is on the line.
  double distance_bound() const noexcept;

 private:
  static constexpr double kSmallest = 1e-70;  // m²; fourth powers neither vanish nor overflow
  static constexpr double kLargest = 1e70;    // m²

  bool has_usual_size() const noexcept {
    return length_squared_ > kSmallest && length_squared_ < kLargest;
  }
  bool is_across(std::size_t side) const noexcept { return side_[side] < -error_; }
  Vec3 along(std::size_t side) const noexcept { return x_[(side + 1) % 3] - x_[side]; }
  Vec3 offset(std::size_t corner) const noexcept { return point_ - x_[corner]; }

  Vec3 point_;                  ///< m
  std::array<Vec3, 3> x_;       ///< m
  std::array<double, 3> side_;  ///< m⁴, positive inside; side k joins corners k and k + 1
  double normal_squared_;       ///< m⁴
  double height_;               ///< m³, over the plane, times |n|
  double offset_squared_;       ///< m², of the point from corner 0
  double length_squared_;       ///< m², L²
  double error_;                ///< m⁴, of side_
};

/// How much farther than range (m) a point is from a cell at least. Not positive: it may be nearer
/// than range. What is lost to rounding is on the safe side, for lengths between 1e-35 and 1e35 m
/// (else the answer is not positive).
double clearance(const Surface& surface, CellId cell, const Vec3& point, double range,
                 Positions x) noexcept;

}  // namespace plekton::geometry

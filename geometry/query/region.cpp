// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::geometry {
namespace {

/// Part of a line x0 + t (x1 - x0).
struct Interval {
  double low = 0.0;
  double high = 1.0;

  double length() const noexcept { return std::max(0.0, high - low); }
  void make_empty() noexcept { high = low - 1.0; }

  /// Keeps where from + t change is within the limits.
  void keep_between(double from, double change, double least, double most) noexcept {
    if (change == 0.0) {
      if (from < least || from > most) make_empty();
      return;
    }
    const double a = (least - from) / change;
    const double b = (most - from) / change;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }

  /// Keeps where |from + t change| is at most a radius.
  void keep_within(const Vec3& from, const Vec3& change, double radius) noexcept {
    const double a = change.squaredNorm();
    const double c = from.squaredNorm() - radius * radius;
    if (a == 0.0) {
      if (c > 0.0) make_empty();
      return;
    }
    const double b = from.dot(change);
    const double root = b * b - a * c;
    if (root < 0.0) {
      make_empty();
      return;
    }
    low = std::max(low, (-b - std::sqrt(root)) / a);
    high = std::min(high, (-b + std::sqrt(root)) / a);
  }
};

/// The same question to each kind of region.
struct PartIn {
  const Vec3& x0;
  const Vec3& x1;

  double operator()(const BallRegion& ball) const noexcept {
    Interval part;
    part.keep_within(x0 - ball.centre, x1 - x0, ball.radius);
    return part.length();
  }
  double operator()(const Box& box) const noexcept {
    Interval part;
    for (int axis = 0; axis < 3; ++axis)
      part.keep_between(x0[axis], x1[axis] - x0[axis], box.lower[axis], box.upper[axis]);
    return part.length();
  }
  double operator()(const CylinderRegion& cylinder) const noexcept {
    const Vec3 along = cylinder.to - cylinder.from;
    const double length = along.norm();
    const Vec3 axis = along / length;
    const Vec3 from = x0 - cylinder.from;
    const Vec3 change = x1 - x0;
    const double height = axis.dot(from);
    const double rise = axis.dot(change);
    Interval part;
    part.keep_between(height, rise, 0.0, length);
    part.keep_within(from - height * axis, change - rise * axis, cylinder.radius);
    return part.length();
  }
};

struct Contains {
  const Vec3& point;

  bool operator()(const BallRegion& ball) const noexcept {
    return (point - ball.centre).squaredNorm() <= ball.radius * ball.radius;
  }
  bool operator()(const Box& box) const noexcept {
    return (point.array() >= box.lower.array()).all() && (point.array() <= box.upper.array()).all();
  }
  bool operator()(const CylinderRegion& cylinder) const noexcept {
    const Vec3 along = cylinder.to - cylinder.from;
    const Vec3 from = point - cylinder.from;
    const double part = along.dot(from) / along.squaredNorm();
    return part >= 0.0 && part <= 1.0 &&
           (from - part * along).squaredNorm() <= cylinder.radius * cylinder.radius;
  }
};

struct Volume {
  double operator()(const BallRegion& ball) const noexcept { return ball_volume(ball.radius); }
  double operator()(const Box& box) const noexcept {
    return (box.upper - box.lower).cwiseMax(0.0).prod();
  }
  double operator()(const CylinderRegion& cylinder) const noexcept {
    return std::numbers::pi * cylinder.radius * cylinder.radius *
           (cylinder.to - cylinder.from).norm();
  }
};

struct BallIn {
  const Vec3& centre;
  double radius;

  double operator()(const BallRegion& ball) const noexcept {
    return lens_volume(radius, ball.radius, (centre - ball.centre).norm());
  }
  double operator()(const Box& box) const noexcept {
    return ball_volume_in_box(centre, radius, box);
  }
  double operator()(const CylinderRegion& cylinder) const noexcept {
    return ball_volume_in_cylinder(centre, radius, cylinder);
  }
};

struct Bounds {
  Box operator()(const BallRegion& ball) const noexcept {
    return {ball.centre.array() - ball.radius, ball.centre.array() + ball.radius};
  }
  Box operator()(const Box& box) const noexcept { return box; }
  Box operator()(const CylinderRegion& cylinder) const noexcept {
    const Vec3 axis = (cylinder.to - cylinder.from).normalized();
    // How far the discs at the ends reach along each axis of the world.
    const Vec3 reach =
        cylinder.radius * (1.0 - axis.array().square()).cwiseMax(0.0).sqrt().matrix();
    return {cylinder.from.cwiseMin(cylinder.to) - reach,
            cylinder.from.cwiseMax(cylinder.to) + reach};
  }
};

}  // namespace

double volume(const Region& region) noexcept {
  return std::visit(Volume{}, region);
}

bool contains(const Region& region, const Vec3& point) noexcept {
  return std::visit(Contains{point}, region);
}

double ball_volume_in(const Region& region, const Vec3& centre, double radius) noexcept {
  return std::visit(BallIn{centre, radius}, region);
}

double segment_part_in(const Region& region, const Vec3& x0, const Vec3& x1) noexcept {
  if (x0 == x1) return contains(region, x0) ? 1.0 : 0.0;
  return std::visit(PartIn{x0, x1}, region);
}

Box bounds(const Region& region) noexcept {
  return std::visit(Bounds{}, region);
}

}  // namespace plekton::geometry

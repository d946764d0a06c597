// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ray.hpp"

#include <cmath>

namespace plekton::geometry {
namespace {

/// A ray that grazes halves its distance in each step; after as many no bit is left of it.
constexpr int kMostSteps = 100;

RayHit hit_at(double t, const Vec3& point, const Proximity& proximity, CellId cell) {
  return {t, point, -proximity.normal, cell, proximity.b};
}

}  // namespace

std::optional<RayHit> hit(const Ray& ray, const PlacedSurface& on, CellId cell) noexcept {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  const double speed = ray.direction.norm();
  if (!(speed > 0.0) || !std::isfinite(speed) || !ray.origin.allFinite()) return std::nullopt;
  if (!(ray.t_end >= 0.0)) return std::nullopt;
  double t = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 point = ray.origin + t * ray.direction;
    const Proximity near = proximity(Probe::point(point), on, cell);
    const double reached = kUlp * (4.0 * near.arm_b + 2.0 * t * speed + ray.origin.norm());
    if (near.gap <= reached) return hit_at(t, point, near, cell);
    const double approach = near.normal.dot(ray.direction);  // how fast the gap closes
    if (!(approach > 0.0)) return std::nullopt;
    const double next = t + near.gap / approach;
    if (!(next <= ray.t_end)) return std::nullopt;
    if (!(next > t)) return hit_at(t, point, near, cell);
    t = next;
  }
  return std::nullopt;
}

}  // namespace plekton::geometry

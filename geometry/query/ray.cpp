// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ray.hpp"

#include "geometry/base/largest_coordinate.hpp"

#include <cmath>

namespace plekton::geometry {
namespace {

/// A ray that grazes halves its distance in each step; after as many no bit is left of it.
constexpr int kMostHalvings = 100;

constexpr double kLastBit = std::numeric_limits<double>::epsilon();

/// Of a core without thickness the point may be on it, or beyond it by rounding: there the normal
/// is turned to where the ray comes from.
RayHit hit_at(double t, const Vec3& point, const Proximity& proximity, CellId cell, const Ray& ray,
              double radius) {
  const bool is_behind = radius == 0.0 && t > 0.0 && proximity.normal.dot(ray.direction) < 0.0;
  return {t, point, is_behind ? proximity.normal : Vec3(-proximity.normal), cell, proximity.b};
}

}  // namespace

bool can_hit(const Ray& ray) noexcept {
  constexpr double kShortest = 1e-150, kLongest = 1e150;
  const double speed = ray.direction.norm();
  return speed >= kShortest && speed <= kLongest && ray.origin.allFinite() &&
         ray.origin.cwiseAbs().maxCoeff() < kLargestCoordinate && ray.t_end >= 0.0;
}

double resolution(const Ray& ray, double t) noexcept {
  return kLastBit * (2.0 * t * ray.direction.norm() + ray.origin.norm());
}

std::optional<RayHit> hit(const Ray& ray, const PlacedSurface& on, CellId cell) noexcept {
  if (!can_hit(ray)) return std::nullopt;
  const double radius = on.surface.radius(on.surface.structure_of(cell));
  double t = 0.0;
  for (int step = 0; step < kMostHalvings; ++step) {
    const Vec3 point = ray.origin + t * ray.direction;
    const Proximity near = proximity(Probe::point(point), on, cell);
    if (near.gap <= 4.0 * kLastBit * near.arm_b + resolution(ray, t))
      return hit_at(t, point, near, cell, ray, radius);
    const double approach = near.normal.dot(ray.direction);  // how fast the gap closes
    if (!(approach > 0.0)) {
      // The last step may have led beyond what has no thickness.
      if (radius > 0.0 || near.gap > 4.0 * resolution(ray, t)) return std::nullopt;
      return hit_at(t, point, near, cell, ray, radius);
    }
    const double next = t + near.gap / approach;
    if (!(next <= ray.t_end && std::isfinite(next))) return std::nullopt;
    if (!(next > t)) return hit_at(t, point, near, cell, ray, radius);
    t = next;
  }
  return std::nullopt;
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/core_pair.hpp"

#include "geometry/closest/decide.hpp"
#include "geometry/closest/deep.hpp"
#include "geometry/closest/point_segment.hpp"
#include "geometry/closest/point_triangle.hpp"
#include "geometry/closest/segment_segment.hpp"
#include "geometry/closest/segment_triangle.hpp"
#include "geometry/closest/triangle_triangle.hpp"

#include <algorithm>

namespace plekton::geometry {
namespace {

std::array<Vec3, 2> segment(const Core& core) {
  return {core.x[0], core.x[1]};
}

ClosestPoints of_two_points(const Core& a, const Core& b) {
  const bool meet = a.x[0] == b.x[0];
  return closest::evaluate(a.corners(), b.corners(),
                           {{1U, 1U}, meet ? Relation::touching_or_crossing : Relation::apart});
}

ClosestPoints reversed(const ClosestPoints& p) {
  return {p.weights_b, p.weights_a, -p.separation, p.distance,
          p.corners_b, p.corners_a, p.relation};
}

Core feature_of(const Core& core, unsigned corners) {
  Core feature;
  for (std::size_t k = 0; k < core.count; ++k) {
    if ((corners >> k & 1U) != 0) feature.x[feature.count++] = core.x[k];
  }
  return feature;
}

/// Of a point on a core it depends on the feature it lies in alone, so that cells that share the
/// feature agree.
DeepSeparation way_out(const Core& a, const Core& b, const ClosestPoints& points,
                       const Vec3& side) {
  if (closest::is_lower_side(b.corners(), a.corners())) {  // the same from both sides
    const DeepSeparation way = way_out(b, a, reversed(points), -side);
    return {-way.direction, way.depth};
  }
  if (a.count > 1) return deep_separation(a.corners(), b.corners(), side);
  const Core of_b = feature_of(b, points.corners_b);
  return deep_separation(a.corners(), of_b.corners(), side);
}

}  // namespace

ClosestPoints closest_points(const Core& a, const Core& b) noexcept {
  if (a.count > b.count) return reversed(closest_points(b, a));
  if (b.count == 1) return of_two_points(a, b);
  if (a.count == 1) {
    return b.count == 2 ? point_segment(a.x[0], segment(b)) : point_triangle(a.x[0], b.x);
  }
  if (b.count == 2) return segment_segment(segment(a), segment(b));
  return a.count == 2 ? segment_triangle(segment(a), b.x) : triangle_triangle(a.x, b.x);
}

namespace {

CoreProximity with_direction(const Core& a, const Core& b, const ClosestPoints& points,
                             const Vec3& side) {
  // A separation whose square vanishes has no direction in double.
  if (points.relation == Relation::apart && points.distance > 0.0) {
    return {points, (points.separation / points.distance).normalized(), points.distance};
  }
  const DeepSeparation way = way_out(a, b, points, side);
  return {points, way.direction, points.relation == Relation::apart ? 0.0 : -way.depth};
}

}  // namespace

CoreProximity core_proximity(const Core& a, const Core& b, const Vec3& side) noexcept {
  return with_direction(a, b, closest_points(a, b), side);
}

CoreProximity core_proximity(const Core& a, const Core& b,
                             const closest::WitnessFeatures& guess) noexcept {
  const bool holds = closest::certify(a.corners(), b.corners(), guess) == closest::Verdict::unique;
  const ClosestPoints points =
      holds ? closest::evaluate(a.corners(), b.corners(), {guess, Relation::apart})
            : closest_points(a, b);
  return with_direction(a, b, points, Vec3::Zero());
}

CoreProximity at_last_touch(const Core& a, const Core& b, const CoreProximity& found) noexcept {
  if (!(found.signed_distance < 0.0)) return found;
  constexpr double kClear = 1e-12;  // of their size: further out than rounding leaves in doubt
  Core still = a, moved = b;
  double size = 0.0;
  for (std::size_t i = 0; i < a.count; ++i) {
    still.x[i] = a.x[i] - a.x[0];
    size = std::max(size, still.x[i].norm());
  }
  for (std::size_t i = 0; i < b.count; ++i) {
    moved.x[i] = b.x[i] - a.x[0];
    size = std::max(size, moved.x[i].norm());
  }
  const Vec3 way = (kClear * size - found.signed_distance) * found.normal;
  for (std::size_t i = 0; i < b.count; ++i) moved.x[i] += way;
  const ClosestPoints last = closest_points(still, moved);
  CoreProximity result = found;
  result.points.weights_a = last.weights_a;
  result.points.weights_b = last.weights_b;
  result.points.corners_a = last.corners_a;
  result.points.corners_b = last.corners_b;
  return result;
}

}  // namespace plekton::geometry

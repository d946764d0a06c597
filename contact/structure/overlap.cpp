// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/overlap.hpp"

namespace plekton::contact::structure {
namespace {

Vector normal_of(const std::array<Vector, 3>& facet) {
  return unit((facet[1] - facet[0]).cross(facet[2] - facet[0]));
}

/// What round-off makes of a point on a plane is below this times the numbers it comes from. A line
/// that lies in a plane up to that crosses it nowhere.
constexpr double kRoundoff = 1e-12;

/// Height of a point over a plane, in units of the length of its normal, and the size of its terms.
struct Height {
  Real value;
  double size;

  Height(const Vector& point, const Vector& origin, const Vector& inward)
      : value((point - origin).dot(inward)),
        size(std::sqrt((point - origin).squaredNorm().value * inward.squaredNorm().value)) {}
  bool is_zero() const { return std::abs(value.value) <= kRoundoff * size; }
};

/// The part of a polygon on the inner side of a plane.
Polygon clipped(const Polygon& polygon, const Vector& origin, const Vector& inward) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector& here = polygon[i];
    const Vector& there = polygon.next(i);
    const Height height_here(here, origin, inward);
    const Height height_there(there, origin, inward);
    const bool is_inside = height_here.value.value >= 0.0 || height_here.is_zero();
    const bool next_inside = height_there.value.value >= 0.0 || height_there.is_zero();
    if (is_inside) kept.add(here);
    if (is_inside != next_inside) {
      const Real drop = height_here.value - height_there.value;
      kept.add(here + (height_here.value / drop) * (there - here));
    }
  }
  return kept;
}

/// Without corners that repeat the one before: they have no direction to the next one.
Polygon without_repeats(const Polygon& polygon) {
  double size = 0.0;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    size = std::max(size, (polygon[i] - polygon[0]).squaredNorm().value);
  }
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double step = (polygon.next(i) - polygon[i]).squaredNorm().value;
    if (step > kRoundoff * kRoundoff * size) kept.add(polygon[i]);
  }
  return kept;
}

}  // namespace

bool lies_in_plane(const Vector& first, const Vector& last, const Vector& origin,
                   const Vector& normal) {
  return Height(first, origin, normal).is_zero() && Height(last, origin, normal).is_zero();
}

bool cut(Interval& interval, const Vector& first, const Vector& last, const Vector& origin,
         const Vector& inward) {
  if (lies_in_plane(first, last, origin, inward)) return true;
  return cut(interval, (first - origin).dot(inward), (last - origin).dot(inward));
}

bool cut(Interval& interval, const Real& height_at_0, const Real& height_at_1) {
  if (height_at_0.value < 0.0 && height_at_1.value < 0.0) return false;
  if (height_at_0.value < 0.0 || height_at_1.value < 0.0) {
    const Real zero = height_at_0 / (height_at_0 - height_at_1);
    if (height_at_0.value < 0.0 && zero > interval.from) interval.from = zero;
    if (height_at_1.value < 0.0 && zero < interval.to) interval.to = zero;
  }
  return interval.from < interval.to;
}

Real FacetOverlap::distance(const Vector& point) const {
  const Real height = (origin_b - point).dot(normal_b) / axis.dot(normal_b);
  return Real(side) * height * half_cosine;
}

FacetOverlap face_to_face(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  const Vector normal_a = normal_of(a);
  const Vector facing_b = normal_of(b);
  const double sign = normal_a.dot(facing_b).value >= 0.0 ? 1.0 : -1.0;
  FacetOverlap found;
  found.normal_b = Real(sign) * facing_b;
  found.origin_b = b[0];
  found.axis = unit(normal_a + found.normal_b);
  found.cosine = normal_a.dot(found.normal_b);
  found.half_cosine = found.axis.dot(normal_a);
  Polygon region;
  for (const Vector& x : a) region.add(x);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector side = b[(i + 1) % 3] - b[i];
    region = clipped(region, b[i], Real(sign) * found.axis.cross(side));
  }
  region = without_repeats(region);
  if (region.size() < 3) return found;
  found.region = region;
  Real height(0.0);
  for (std::size_t i = 0; i < region.size(); ++i) {
    height = height + (found.origin_b - region[i]).dot(found.normal_b);
  }
  found.side = height.value >= 0.0 ? 1.0 : -1.0;
  // Planes z = -(n - axis (n.axis)).y / (n.axis) over the plane perpendicular to the axis.
  const Vector across_a = normal_a - found.half_cosine * found.axis;
  const Vector across_b = found.normal_b - found.axis.dot(found.normal_b) * found.axis;
  found.slope = Real(found.side) / found.half_cosine * (across_a - across_b);
  return found;
}

std::optional<EdgeOverFacet> above(const Vector& first, const Vector& last,
                                   const std::array<Vector, 3>& facet) {
  const Vector normal = normal_of(facet);
  EdgeOverFacet found{{0.0, 1.0}, (last - first).norm(), 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector inward = normal.cross(facet[(i + 1) % 3] - facet[i]);
    if (!cut(found.part, first, last, facet[i], inward)) return {};
  }
  const Real height_first = (first - facet[0]).dot(normal);
  const Real height_last = (last - facet[0]).dot(normal);
  const Real side(height_first.value + height_last.value >= 0.0 ? 1.0 : -1.0);
  found.first = side * height_first;
  found.last = side * height_last;
  found.slope = (found.last - found.first) / found.length;
  return found;
}

std::optional<EdgeBesideEdge> beside(const std::array<Vector, 2>& edge,
                                     const std::array<Vector, 2>& other) {
  const Vector along = unit(other[1] - other[0]);
  const Vector to_first = edge[0] - other[0];
  const Real first = to_first.dot(along);
  EdgeBesideEdge found{{0.0, 1.0}, (edge[1] - edge[0]).norm(), {}, {}};
  if (!cut(found.part, edge[0], edge[1], other[0], along)) return {};
  if (!cut(found.part, edge[0], edge[1], other[1], Real(-1.0) * along)) return {};
  const Vector direction = unit(edge[1] - edge[0]);
  found.start = to_first - first * along;
  found.drift = direction - direction.dot(along) * along;
  return found;
}

}  // namespace plekton::contact::structure

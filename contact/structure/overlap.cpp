// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/overlap.hpp"

namespace plekton::contact::structure {
namespace {

template <class Number>
using Point = geometry::PackVec3<Number>;

template <class Number>
Point<Number> normal_of(const std::array<Point<Number>, 3>& facet) {
  return unit((facet[1] - facet[0]).cross(facet[2] - facet[0]));
}

/// What round-off makes of a point on a plane is below this times the numbers it comes from. A line
/// that lies in a plane up to that crosses it nowhere.
constexpr double kRoundoff = 1e-12;

/// Height of a point over a plane, in units of the length of its normal; 0 up to round-off.
template <class Number>
double height_now(const Point<Number>& point, const Point<Number>& origin,
                  const Point<Number>& normal) {
  const Vec3 up = still(point) - still(origin);
  const Vec3 n = still(normal);
  const double height = up.dot(n);
  return std::abs(height) <= kRoundoff * std::sqrt(up.squaredNorm() * n.squaredNorm()) ? 0.0
                                                                                       : height;
}

/// Keeps the part of a polygon on the inner side of a plane.
template <class Number>
void clip(PolygonOf<Number>& polygon, const Point<Number>& origin, const Point<Number>& inward) {
  std::array<bool, Polygon::kMostCorners> inside{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    inside[i] = height_now(polygon[i], origin, inward) >= 0.0;
    count += inside[i];
  }
  if (count == polygon.size()) return;
  PolygonOf<Number> kept;
  for (std::size_t i = 0; i < polygon.size() && count > 0; ++i) {
    const Point<Number>& here = polygon[i];
    const Point<Number>& there = polygon.next(i);
    if (inside[i]) kept.add(here);
    if (inside[i] == inside[i + 1 == polygon.size() ? 0 : i + 1]) continue;
    const Number height = (here - origin).dot(inward);
    const Number drop = height - (there - origin).dot(inward);
    kept.add(here + (height / drop) * (there - here));
  }
  polygon = kept;
}

/// Takes out corners that repeat the one before: they have no direction to the next one.
template <class Number>
void drop_repeats(PolygonOf<Number>& polygon) {
  const auto step = [&](std::size_t i) {
    return (still(polygon.next(i)) - still(polygon[i])).squaredNorm();
  };
  double size = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    size = std::max(size, (still(polygon[i]) - still(polygon[0])).squaredNorm());
  }
  const double least = kRoundoff * kRoundoff * size;
  PolygonOf<Number> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (step(i) > least) kept.add(polygon[i]);
  }
  if (kept.size() < polygon.size()) polygon = kept;
}

/// Takes out corners at which the rim does not turn, or turns back, up to round-off: of an overlap
/// that is a line nothing is left. A corner that turns back would count as a whole turn.
template <class Number>
void drop_straight(PolygonOf<Number>& polygon, const Point<Number>& axis) {
  for (std::size_t before = 0; polygon.size() > 0 && polygon.size() != before;) {
    before = polygon.size();
    PolygonOf<Number> kept;
    for (std::size_t i = 0; i < before; ++i) {
      const Vec3 here = still(polygon[i]);
      const Vec3 come = here - still(polygon[i == 0 ? before - 1 : i - 1]);
      const Vec3 go = still(polygon.next(i)) - here;
      const double least = kRoundoff * std::sqrt(come.squaredNorm() * go.squaredNorm());
      if (still(axis).dot(come.cross(go)) > least) kept.add(polygon[i]);
    }
    if (kept.size() < before) polygon = kept;
  }
}

template <class Number>
FacetOverlapOf<Number> overlap_of(const std::array<Point<Number>, 3>& a,
                                  const std::array<Point<Number>, 3>& b) {
  const Point<Number> normal_a = normal_of(a);
  const Point<Number> facing_b = normal_of(b);
  const double sign = still(normal_a.dot(facing_b)) >= 0.0 ? 1.0 : -1.0;
  FacetOverlapOf<Number> found;
  found.normal_b = sign * facing_b;
  found.origin_b = b[0];
  found.axis = unit(normal_a + found.normal_b);
  found.cosine = normal_a.dot(found.normal_b);
  found.half_cosine = found.axis.dot(normal_a);
  PolygonOf<Number>& region = found.region;
  for (const Point<Number>& x : a) region.add(x);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point<Number> side = b[(i + 1) % 3] - b[i];
    clip(region, b[i], sign * found.axis.cross(side));
    if (region.size() < 3) break;
  }
  drop_repeats(region);
  drop_straight(region, found.axis);
  if (region.size() < 3) {
    region.clear();
    return found;
  }
  double height = 0.0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    height += (still(found.origin_b) - still(region[i])).dot(still(found.normal_b));
  }
  found.side = height >= 0.0 ? 1.0 : -1.0;
  // Planes z = -(n - axis (n.axis)).y / (n.axis) over the plane perpendicular to the axis.
  const Point<Number> across_a = normal_a - found.half_cosine * found.axis;
  const Point<Number> across_b = found.normal_b - found.axis.dot(found.normal_b) * found.axis;
  found.slope = Number(found.side) / found.half_cosine * (across_a - across_b);
  return found;
}

template <class Number>
bool lies_in(const Point<Number>& first, const Point<Number>& last, const Point<Number>& origin,
             const Point<Number>& normal) {
  return height_now(first, origin, normal) == 0.0 && height_now(last, origin, normal) == 0.0;
}

template <class Number>
bool keep_above(IntervalOf<Number>& interval, const Number& height_at_0,
                const Number& height_at_1) {
  const double now_at_0 = still(height_at_0), now_at_1 = still(height_at_1);
  if (now_at_0 < 0.0 && now_at_1 < 0.0) return false;
  if (now_at_0 < 0.0 || now_at_1 < 0.0) {
    const Number zero = height_at_0 / (height_at_0 - height_at_1);
    if (now_at_0 < 0.0 && zero > interval.from) interval.from = zero;
    if (now_at_1 < 0.0 && zero < interval.to) interval.to = zero;
  }
  return interval.from < interval.to;
}

template <class Number>
bool keep_inside(IntervalOf<Number>& interval, const Point<Number>& first,
                 const Point<Number>& last, const Point<Number>& origin,
                 const Point<Number>& inward) {
  if (lies_in(first, last, origin, inward)) return true;
  return keep_above<Number>(interval, (first - origin).dot(inward), (last - origin).dot(inward));
}

/// Keeps the part of an edge above the interior of a facet. @returns whether there is one
template <class Number>
bool keep_over(IntervalOf<Number>& part, const Point<Number>& first, const Point<Number>& last,
               const std::array<Point<Number>, 3>& facet, const Point<Number>& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point<Number> inward = normal.cross(facet[(i + 1) % 3] - facet[i]);
    if (!keep_inside(part, first, last, facet[i], inward)) return false;
  }
  return true;
}

/// A point without derivatives.
Point<double> now(const Vector& x) {
  return {x.x.value, x.y.value, x.z.value};
}

/// Whether an edge has a part above a facet: by the same numbers, without derivatives.
bool is_over_now(const Vector& first, const Vector& last, const std::array<Vector, 3>& facet) {
  const std::array<Point<double>, 3> corners{now(facet[0]), now(facet[1]), now(facet[2])};
  IntervalOf<double> part{0.0, 1.0};
  return keep_over(part, now(first), now(last), corners, normal_of(corners));
}

}  // namespace

bool lies_in_plane(const Vector& first, const Vector& last, const Vector& origin,
                   const Vector& normal) {
  return lies_in<Real>(first, last, origin, normal);
}

bool cut(Interval& interval, const Vector& first, const Vector& last, const Vector& origin,
         const Vector& inward) {
  return keep_inside<Real>(interval, first, last, origin, inward);
}

bool cut(Interval& interval, const Real& height_at_0, const Real& height_at_1) {
  return keep_above<Real>(interval, height_at_0, height_at_1);
}

FacetOverlap face_to_face(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  return overlap_of<Real>(a, b);
}

FacetOverlapOf<double> face_to_face_now(const Simplex& a, const Simplex& b) {
  const auto now = [](const Simplex& facet) {
    std::array<Point<double>, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = {facet.x[i][0], facet.x[i][1], facet.x[i][2]};
    return x;
  };
  return overlap_of<double>(now(a), now(b));
}

std::optional<EdgeOverFacet> above(const Vector& first, const Vector& last,
                                   const std::array<Vector, 3>& facet) {
  if (!is_over_now(first, last, facet)) return {};
  const Vector normal = normal_of<Real>(facet);
  EdgeOverFacet found{{0.0, 1.0}, (last - first).norm(), 0.0, 0.0, 0.0};
  keep_over(found.part, first, last, facet, normal);
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
  if (!cut(found.part, edge[0], edge[1], other[1], -1.0 * along)) return {};
  const Vector direction = unit(edge[1] - edge[0]);
  found.start = to_first - first * along;
  found.drift = direction - direction.dot(along) * along;
  return found;
}

}  // namespace plekton::contact::structure

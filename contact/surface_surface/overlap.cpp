// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/overlap.hpp"

#include "contact/surface_surface/facing_facets.hpp"

namespace plekton::contact::structure {
namespace {

template <class Number>
using Point = geometry::PackVec3<Number>;

template <class Number>
Point<Number> normal_of(const std::array<Point<Number>, 3>& facet) {
  return unit((facet[1] - facet[0]).cross(facet[2] - facet[0]));
}

/// Height of a point over a plane, in units of the length of its normal; 0 up to round-off: a line
/// that lies in a plane up to that crosses it nowhere.
template <class Number>
double height_now(const Point<Number>& point, const Point<Number>& origin,
                  const Point<Number>& normal) {
  const Vec3 up = still(point) - still(origin);
  const Vec3 n = still(normal);
  const double height = up.dot(n);
  return std::abs(height) <= kPlaneRoundoff * std::sqrt(up.squaredNorm() * n.squaredNorm())
             ? 0.0
             : height;
}

template <class Number>
bool lies_in(const Point<Number>& first, const Point<Number>& last, const Point<Number>& origin,
             const Point<Number>& normal) {
  return height_now(first, origin, normal) == 0.0 && height_now(last, origin, normal) == 0.0;
}

/// Where an edge with these heights at its ends crosses height 0.
template <class Number>
Number crossing(const Number& height_at_0, const Number& height_at_1) {
  return height_at_0 / (height_at_0 - height_at_1);
}

template <class Number>
bool keep_above(IntervalOf<Number>& interval, const Number& height_at_0,
                const Number& height_at_1) {
  const double now_at_0 = still(height_at_0), now_at_1 = still(height_at_1);
  if (now_at_0 < 0.0 && now_at_1 < 0.0) return false;
  if (now_at_0 < 0.0 || now_at_1 < 0.0) {
    const Number zero = crossing(height_at_0, height_at_1);
    if (now_at_0 < 0.0 && zero > interval.from) interval.from = zero;
    if (now_at_1 < 0.0 && zero < interval.to) interval.to = zero;
  }
  return interval.from < interval.to;
}

/// Which sides of a facet, or -1 the ends of an edge, bound the part of the edge above it.
using BoundingSides = std::array<int, 2>;

/// By the same numbers, without derivatives. @returns nothing where no part is above the facet
std::optional<BoundingSides> sides_of_part(const Point<double>& first, const Point<double>& last,
                                           const std::array<Point<double>, 3>& facet) {
  const Point<double> normal = normal_of(facet);
  BoundingSides sides{-1, -1};
  IntervalOf<double> part{0.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point<double> inward = normal.cross(facet[(i + 1) % 3] - facet[i]);
    if (lies_in(first, last, facet[i], inward)) continue;
    const auto [from, to] = part;
    if (!keep_above(part, (first - facet[i]).dot(inward), (last - facet[i]).dot(inward))) return {};
    if (part.from != from) sides[0] = static_cast<int>(i);
    if (part.to != to) sides[1] = static_cast<int>(i);
  }
  return sides;
}

template <class Number>
Number cosine_of(const std::array<Point<Number>, 2>& a, const std::array<Point<Number>, 2>& b) {
  const Number cosine = unit(a[1] - a[0]).dot(unit(b[1] - b[0]));
  return still(cosine) < 0.0 ? -cosine : cosine;
}

}  // namespace

bool lies_in_plane(const Vector& first, const Vector& last, const Vector& origin,
                   const Vector& normal) {
  return lies_in<Real>(first, last, origin, normal);
}

bool cut(Interval& interval, const Vector& first, const Vector& last, const Vector& origin,
         const Vector& inward) {
  if (lies_in(first, last, origin, inward)) return true;
  return cut(interval, (first - origin).dot(inward), (last - origin).dot(inward));
}

bool cut(Interval& interval, const Real& height_at_0, const Real& height_at_1) {
  return keep_above<Real>(interval, height_at_0, height_at_1);
}

std::optional<EdgeOverFacet> above(const Vector& first, const Vector& last,
                                   const std::array<Vector, 3>& facet) {
  const auto sides =
      sides_of_part(now(first), now(last), {now(facet[0]), now(facet[1]), now(facet[2])});
  if (!sides) return {};
  const Vector normal = normal_of<Real>(facet);
  EdgeOverFacet found{{0.0, 1.0}, *sides, (last - first).norm(), 0.0, 0.0, 0.0};
  const auto crossing_of = [&](int side) {
    const auto i = static_cast<std::size_t>(side);
    const Vector inward = normal.cross(facet[(i + 1) % 3] - facet[i]);
    return crossing((first - facet[i]).dot(inward), (last - facet[i]).dot(inward));
  };
  if ((*sides)[0] >= 0) found.part.from = crossing_of((*sides)[0]);
  if ((*sides)[1] >= 0) found.part.to = crossing_of((*sides)[1]);
  const Real height_first = (first - facet[0]).dot(normal);
  const Real height_last = (last - facet[0]).dot(normal);
  // Beyond the facet the edge may go to the other side of its plane.
  const double middle = 0.5 * (found.part.from.value + found.part.to.value);
  const double height = (1.0 - middle) * height_first.value + middle * height_last.value;
  const Real side(height >= 0.0 ? 1.0 : -1.0);
  found.first = side * height_first;
  found.last = side * height_last;
  found.slope = (found.last - found.first) / found.length;
  return found;
}

Real cosine_between(const Edge& a, const Edge& b) {
  return cosine_of<Real>(a, b);
}

bool are_along(const Edge& a, const Edge& b) {
  return parallel_share(cosine_of<double>({now(a[0]), now(a[1])}, {now(b[0]), now(b[1])})) > 0.0;
}

std::optional<EdgeBesideEdge> beside(const Edge& edge, const Edge& other) {
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure/simplex.hpp"

#include <array>
#include <cstddef>
#include <optional>

/// Where one body lies above another: the parts of edges and facets that face each other.
namespace plekton::contact::structure {

/// Part of an edge: from its first end times 1 - from, to its last.
template <class Number>
struct IntervalOf {
  Number from;
  Number to;
};
using Interval = IntervalOf<Real>;

/// A convex polygon with room for what three cuts leave of a triangle, also where rounding takes
/// corners for dents: 4, 6, 9 corners.
template <class Number>
class PolygonOf {
 public:
  using Corner = geometry::PackVec3<Number>;
  static constexpr std::size_t kMostCorners = 9;

  PolygonOf() = default;
  PolygonOf(const PolygonOf& other) { *this = other; }
  /// Copies the corners that there are: each is large.
  PolygonOf& operator=(const PolygonOf& other) noexcept {
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) corners_[i] = other.corners_[i];
    return *this;
  }

  std::size_t size() const noexcept { return size_; }
  const Corner& operator[](std::size_t i) const noexcept { return corners_[i]; }
  const Corner& next(std::size_t i) const noexcept { return corners_[i + 1 == size_ ? 0 : i + 1]; }
  void add(const Corner& corner) { corners_[size_++] = corner; }
  void clear() noexcept { size_ = 0; }

 private:
  std::array<Corner, kMostCorners> corners_;
  std::size_t size_ = 0;
};
using Polygon = PolygonOf<Real>;

/// Two facets that face each other, seen along the mean of their normals.
template <class Number>
struct FacetOverlapOf {
  using Point = geometry::PackVec3<Number>;

  PolygonOf<Number> region;  ///< on the core of a, counterclockwise about the axis; empty if they
                             ///< do not
  Point axis;                ///< unit, mean of both normals, on the side of a's
  Point slope;               ///< of the distance, over the plane perpendicular to the axis
  Number cosine;             ///< of the angle between both planes
  Number half_cosine;        ///< of half of it

  /// Distance (m) of b's plane from a point on a's, of equal facets that of their cores.
  Number distance(const Point& point) const {
    const Number height = (origin_b - point).dot(normal_b) / axis.dot(normal_b);
    return side * height * half_cosine;
  }

  Point origin_b;
  Point normal_b;
  double side;  ///< 1 if b lies on the axis' side of a, -1 on the other
};
using FacetOverlap = FacetOverlapOf<Real>;
FacetOverlap face_to_face(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b);

/// The same as it is now, without derivatives, at a small part of the cost: the same bits.
FacetOverlapOf<double> face_to_face_now(const Simplex& a, const Simplex& b);

/// An edge above (or below) a facet.
struct EdgeOverFacet {
  Interval part;  ///< of the edge, that lies above the facet
  Real length;    ///< m, of the whole edge
  Real first;     ///< m, distance of the edge's first end from the facet's plane
  Real last;      ///< m, of its other end
  Real slope;     ///< of the distance, along the edge

  Real distance(const Real& t) const { return first + t * (last - first); }
};
std::optional<EdgeOverFacet> above(const Vector& first, const Vector& last,
                                   const std::array<Vector, 3>& facet);

/// An edge beside the line of another, as far as it lies beside the other.
struct EdgeBesideEdge {
  Interval part;
  Real length;   ///< m, of the whole edge
  Vector start;  ///< from the other line to the edge's first end, perpendicular to the line
  Vector drift;  ///< how that changes by length of the edge

  Vector separation(const Real& t) const { return start + (t * length) * drift; }
  /// Slope of the distance at a place.
  Real slope(const Real& t) const { return separation(t).dot(drift) / separation(t).norm(); }
};
std::optional<EdgeBesideEdge> beside(const std::array<Vector, 2>& edge,
                                     const std::array<Vector, 2>& other);

/// Keeps what of an interval has a nonnegative height, which is linear from one end of the edge
/// (t = 0) to the other. @returns whether anything is left
bool cut(Interval& interval, const Real& height_at_0, const Real& height_at_1);

/// Keeps what of an edge is on the inner side of a plane; all of an edge that lies in it.
bool cut(Interval& interval, const Vector& first, const Vector& last, const Vector& origin,
         const Vector& inward);

/// Up to round-off: such an edge crosses the plane nowhere.
bool lies_in_plane(const Vector& first, const Vector& last, const Vector& origin,
                   const Vector& normal);

}  // namespace plekton::contact::structure

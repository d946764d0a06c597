// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/simplex.hpp"

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

/// An edge above (or below) a facet.
struct EdgeOverFacet {
  Interval part;                     ///< of the edge, that lies above the facet
  std::array<int, 2> sides{-1, -1};  ///< of the facet, that the part begins and ends at; -1: at an
                                     ///< end of the edge
  Real length;                       ///< m, of the whole edge
  Real first;                        ///< m, distance of the edge's first end from the facet's plane
  Real last;                         ///< m, of its other end
  Real slope;                        ///< of the distance, along the edge

  Real distance(const Real& t) const { return first + t * (last - first); }
};
std::optional<EdgeOverFacet> above(const Vector& first, const Vector& last,
                                   const std::array<Vector, 3>& facet);

/// An edge by its ends.
using Edge = std::array<Vector, 2>;

/// Of the angle between the lines of two edges.
Real cosine_between(const Edge& a, const Edge& b);
/// Whether parallel_share() of it is above 0; without derivatives.
bool are_along(const Edge& a, const Edge& b);

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
std::optional<EdgeBesideEdge> beside(const Edge& edge, const Edge& other);

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

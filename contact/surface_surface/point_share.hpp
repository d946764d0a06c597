// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/facing_facets.hpp"
#include "contact/surface_surface/simplex.hpp"

/// Where two facets touch at a point, and where they lie on each other.
///
/// Facets that are tilted against each other by an angle t touch in a strip of the width u / t,
/// with u the overlap. As long as that is narrow beside the bodies' thickness the contact is one at
/// the nearest points (nearest.hpp). Where it is wide, it counts by its area (extended.hpp), and
/// where the nearest points are no longer matters: of facets that lie flat they are anywhere, and
/// the next rounding picks another corner. So what a pair of facets does at its nearest points is
/// multiplied by a share that depends on
///
///     X = (range * sin t / u)^2        range: the sum of both radii
///
/// alone while their cores do not cross: 1 from X1 = 1 - kCosineOfCrossing^2 = 0.19 on (a strip of
/// 2.3 ranges), below that z (2 - z) with z = X / X1. It is smooth, and goes to 0 where the facets
/// are flat: no corner is favoured there, whatever rounding or a mesh that coincides with the other
/// one makes of them. What the nearest points of a linear spring store grows to twice what it was at
/// X1 and no further: deeper overlaps never store less, so nothing attracts. It goes with the square
/// of the angle, like a spring that turns the facets flat.
///
/// Why X1: facets that cross at more than kCosineOfCrossing have no extent, so they must count in
/// full at any overlap up to the range. And where the share falls the area of the overlap has taken
/// over: a corner of 90 degrees that tips down by t along its diagonal has the area (u / t)^2 in
/// range, and the integral of the energy over it is 1 / (6 X) of the energy of one contact, 0.9
/// where the share begins to fall. So the sum never falls below one contact while a body comes to
/// lie flat.
///
/// Facets beside each other in one plane, rim to rim, have no area to take over: see rim_share.hpp.
///
/// Of facets that are through each other little is flat: the share comes back to 1 from where the
/// cores meet to two ranges deeper. There the shortest way out turns from one pair of features to
/// another one, which may be a rim or none, and only what all ways share may count (a pair 4 ranges
/// deep stored half at once as its way out left the rims). It comes back to 1 with the overlap, so
/// deeper overlaps still store no less.
///
/// Features that facets share (geometry/critical/product_features.hpp) take the mean share of all
/// pairs of cells that have them. With the weights of inclusion and exclusion, what lies in
/// several pairs of cells then counts with a mean of their shares: on a seam of two with half of
/// each.
namespace plekton::contact::structure {

/// Square of the sine of the angle between the planes of two facets; negative where one is none.
double tilt_between(const Simplex& a, const Simplex& b);

struct PointShare {
  double share = 1.0;
  double by_distance = 0.0;  ///< 1/m, derivative by the distance of the nearest points
  double by_tilt = 0.0;      ///< derivative by tilt_between()
};

/// Ranges, from where the cores meet to where facets count as crossing whatever their tilt. As the
/// share comes back a linear contact of flat ones gets 3.5 times as stiff as one, and no stiffer:
/// the second derivative of u^2 / 2 (1 - left) in point_share(), at most.
inline constexpr double kDepthOfCrossing = 2.0;

/// @param tilt     of tilt_between()
/// @param overlap  m, > 0
/// @param range    m
inline PointShare point_share(double tilt, double overlap, double range) {
  constexpr double kTilted = 1.0 - kCosineOfCrossing * kCosineOfCrossing;
  const double square = overlap * overlap;
  // Most facets are tilted; nor where one has no area, or is none.
  if (!(tilt >= 0.0) || range * range * tilt >= kTilted * square) return {};
  const double depth = (overlap - range) / (kDepthOfCrossing * range);
  if (depth >= 1.0) return {};
  const double per_tilt = range * range / square;
  const double x = per_tilt * tilt;
  const double z = x / kTilted;
  const double by_x = 2.0 * (1.0 - z) / kTilted;
  const PointShare share{z * (2.0 - z), by_x * 2.0 * x / overlap, by_x * per_tilt};
  if (depth <= 0.0) return share;
  const double left = (1.0 - depth) * (1.0 - depth) * (1.0 + 2.0 * depth);
  const double by_depth = -6.0 * depth * (1.0 - depth);
  const double of_depth = (1.0 - share.share) * by_depth / (kDepthOfCrossing * range);
  return {1.0 - (1.0 - share.share) * left, left * share.by_distance + of_depth,
          left * share.by_tilt};
}

/// Forces of an energy that depends on tilt_between() of two facets.
/// @param by_tilt  J, its derivative
PairForces tilting_forces(const Simplex& a, const Simplex& b, double by_tilt);

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

/// How much of a ball lies in a region: the volumes of intersections, in m³.
///
/// Those with half-spaces, balls and boxes are closed forms, right to about 1e-15 of the ball's
/// volume. That with a cylinder has no closed form in elementary functions; it is a quadrature of
/// one, right to 1e-8 of the ball's volume. A radius may be 0.
namespace plekton::geometry {

/// Volume of a ball.
double ball_volume(double radius) noexcept;

/// Of a ball and the half-space that begins at a height above its centre (m, below 0: beneath it).
double cap_volume(double radius, double height) noexcept;

/// Of two balls with a distance between their centres. The lens: the sum of two caps.
double lens_volume(double radius_a, double radius_b, double distance) noexcept;

/// Of a ball and a box. By inclusion and exclusion of what is beyond one, two and three planes at
/// right angles, whose volumes follow from the areas of their faces (divergence theorem) and of the
/// spherical polygon (Gauss and Bonnet).
double ball_volume_in_box(const Vec3& centre, double radius, const Box& box) noexcept;

/// A finite cylinder as a region, with flat ends.
struct CylinderRegion {
  Vec3 from;      ///< m, centre of one end
  Vec3 to;        ///< m, of the other; not the same point
  double radius;  ///< m, > 0
};

/// Of a ball and a cylinder. Cuts across the axis are lenses of two circles; their areas are summed
/// along the axis by Gauss and Legendre, from kink to kink.
double ball_volume_in_cylinder(const Vec3& centre, double radius,
                               const CylinderRegion& cylinder) noexcept;

}  // namespace plekton::geometry

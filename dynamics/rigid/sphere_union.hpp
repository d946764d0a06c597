// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/rigid/mass_properties.hpp"

#include <span>

namespace plekton::dynamics {

/// Moments of what some spheres cover together, however they overlap.
struct SphereUnion {
  VolumeMoments moments;  ///< about the origin that was asked for
  double error = 0.0;     ///< relative, estimated, of the volume
};

/// Slices across z: the union of discs in a slice is bounded by arcs, over which Green's theorem
/// gives area and moments in closed form. Over z they are smooth but where a disc or the chord of
/// two begins or ends and where three spheres meet in a point; between such places they are
/// integrated by Gauss' rule in theta, z = middle - half cos(theta), which takes the square roots
/// at the ends away. The error is the difference between rules of 32 and 48 points, and is about
/// rounding. With n spheres that each meet k others the time grows with n k² (n k + n).
/// @param centres  m
/// @param radii    m, > 0
SphereUnion sphere_union(std::span<const Vec3> centres, std::span<const double> radii,
                         const Vec3& origin);

}  // namespace plekton::dynamics

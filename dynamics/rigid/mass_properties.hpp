// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/facet.hpp"

#include <array>
#include <span>

/// Mass, centre and inertia of bodies of one density.
namespace plekton::dynamics {

using geometry::Mat3;
using geometry::Quat;
using geometry::Vec3;

/// Integrals over a volume, about an origin: of 1 (m³), x (m⁴) and x x^T (m⁵).
struct VolumeMoments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  VolumeMoments& operator+=(const VolumeMoments& other) noexcept;
};

struct MassProperties {
  double mass = 0.0;            ///< kg
  Vec3 centre = Vec3::Zero();   ///< m
  Mat3 inertia = Mat3::Zero();  ///< kg m², about the centre, along the axes of the world
};

/// Of a volume with a density (kg/m³); all zero if it has no volume.
/// @param origin  m, about which the moments are
MassProperties mass_of(const VolumeMoments& moments, double density, const Vec3& origin) noexcept;

/// Of two bodies together, without what they may have in common twice.
MassProperties together(const MassProperties& a, const MassProperties& b) noexcept;

/// The same distribution with another mass (kg). @param body  has a mass
MassProperties scaled_to(const MassProperties& body, double mass) noexcept;

/// Of what a closed mesh encloses, exact but for rounding: the sum of tetrahedra from a point to
/// all facets, with their signs. The volume is taken as positive, whichever way the facets face.
/// The thickness of the facets is not part of it.
/// @param facets  corners of each, all facing the same way
/// @param origin  m, about which the moments are, near the mesh
VolumeMoments solid_moments(geometry::Positions points,
                            std::span<const std::array<geometry::NodeId, 3>> facets,
                            const Vec3& origin) noexcept;

/// Of a shell on a mesh, half of its thickness on each side: the sum of the prisms on all facets.
/// Where facets meet at an angle it counts what they have in common twice, and leaves the wedge on
/// the other side out.
/// @param thickness  m
VolumeMoments shell_moments(geometry::Positions points,
                            std::span<const std::array<geometry::NodeId, 3>> facets,
                            double thickness, const Vec3& origin) noexcept;

/// Principal moments of inertia, and the turn from their axes to the world.
struct PrincipalAxes {
  Vec3 moments;  ///< kg m², ascending
  Quat orientation;
};

/// @param inertia  kg m², symmetric
PrincipalAxes principal_axes(const Mat3& inertia);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// Edges at which the surface folds by more than this (degrees) keep their place.
inline constexpr double kFeatureAngle = 40.0;

/// Replaces the facets by nearly equilateral ones with edges near a length (CGAL's
/// isotropic_remeshing, five rounds). Border edges and folds above kFeatureAngle are cut where they
/// are longer than 4/3 of it, and collapsed along their line where they are shorter than 4/5 of it.
/// Their nodes stay in place or go; those where lines end, branch, or turn as within a circle of
/// two target edges radius stay, so the rim and the creases are no more than a ninth of the target
/// away from where they were. If facets of the outcome intersect, short edges of lines stay as well
/// where that makes fewer of them. Other nodes lie on the old surface up to rounding.
/// @param target_edge  m.
/// @param mesh  with finite points, and facets that have an area: repair() sees to both
/// @throws MeshError if the length is not positive and finite, would make more than 2e7 facets, or
///         is below 256 roundings of the coordinates; for facets that name a point twice or one
///         that is not there; for a mesh that is not 1e-30 to 1e30 m large, not manifold, or whose
///         facets disagree, where remeshing would tear shared nodes apart; and what CGAL throws
///         where it gives up. Source: Botsch & Kobbelt, A remeshing approach to multiresolution
///         modeling (2004).
Mesh remesh(const Mesh& mesh, double target_edge);

}  // namespace plekton::geometry

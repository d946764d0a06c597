// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// Edges at which the surface folds by more than this (degrees) keep their place.
inline constexpr double kFeatureAngle = 40.0;

/// Replaces the facets by nearly equilateral ones with edges near a length (CGAL's
/// isotropic_remeshing, five rounds). Border edges and folds above kFeatureAngle are cut where they
/// are longer than 4/3 of it and stay in place otherwise, so the rim and the creases keep their
/// shape, and edges along them may stay shorter. Other nodes lie on the old surface up to rounding.
/// @param target_edge  m.
/// @throws MeshError if the length is not positive and finite or would make more than 2e7 facets,
///         and for a mesh that is not manifold or whose facets disagree, where remeshing would tear
///         shared nodes apart. Source: Botsch & Kobbelt, A remeshing approach to multiresolution
///         modeling (2004).
Mesh remesh(const Mesh& mesh, double target_edge);

}  // namespace plekton::geometry

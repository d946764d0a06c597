// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// A closed surface around a mesh, at a distance of `finest` / 30 outside of it: manifold, without
/// intersections and facing outward, whatever the mesh is like (CGAL's alpha_wrap_3). Sheets become
/// thin closed shells, and openings and inner spaces that a ball of radius `finest` cannot enter
/// from outside are sealed.
/// @param finest  m. Smaller keeps more detail and takes more facets (about the area over its
///                square).
/// @throws MeshError if the length is not positive and finite, or below 1/2000 of the diagonal of
///         the bounds, where it would take more memory than there is.
/// Source: Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner & Alliez, Alpha wrapping with an offset
/// (2022).
Mesh wrap(const Mesh& mesh, double finest);

}  // namespace plekton::geometry

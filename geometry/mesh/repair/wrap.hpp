// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// A closed surface around a mesh, at a distance of `finest` / 30 outside of it: manifold, without
/// intersections and facing outward, whatever the mesh is like (CGAL's alpha_wrap_3). Sheets become
/// thin closed shells, and openings and inner spaces that a ball of radius `finest` cannot enter
/// from outside are sealed.
/// @param finest  m. Smaller keeps more detail and takes more facets: in each of its squares on the
///                outside about 2 on thick bodies and 8 on thin ones, so 16 to those of a sheet,
///                and about 0.1 ms and 1 kB for each.
/// @throws MeshError if the length is not positive and finite, below 1/2000 of the diagonal of the
///         bounds, or so short that, by a coarse wrap, there would be more than a million facets;
///         it says from which length on there are not. Source: Portaneri, Rouxel-Labbe, Hemmer,
///         Cohen-Steiner & Alliez, Alpha wrapping with an offset (2022).
Mesh wrap(const Mesh& mesh, double finest);

}  // namespace plekton::geometry

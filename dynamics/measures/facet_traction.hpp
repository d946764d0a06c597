// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"
#include "geometry/primitives/facet.hpp"

#include <span>
#include <vector>

namespace plekton::dynamics {

/// What contacts do to a facet, per area as it is now.
struct FacetTraction {
  double pressure = 0.0;  ///< Pa, against the normal of the facet: positive from the side that it
                          ///< faces, negative from behind
  geometry::Vec3 shear = geometry::Vec3::Zero();  ///< Pa, along the facet
};

/// Tractions on facets.
///
/// A contact acts on the nodes of the surface by its weights; each node hands its force on to the
/// facets around it in proportion to their areas. So the traction of a facet is the sum of F_n /
/// A_n over its three corners, with A_n the area of all facets at the corner: the tractions times
/// the areas add up to the force of all contacts on nodes of facets, and a uniform pressure comes
/// out as itself. Torques are left out. A facet without area has the tractions of its corners as
/// shear.
/// @param forces  N, of contacts, by NodeId
/// @param x       m, by NodeId
std::vector<FacetTraction> facet_tractions(std::span<const geometry::Facet> facets,
                                           std::span<const geometry::Vec3> forces,
                                           geometry::Positions x);

}  // namespace plekton::dynamics

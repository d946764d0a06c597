// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/node_state.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "geometry/facet.hpp"

/// How the mass of a structure is given to its nodes. Use one mode for a structure: edge mode for
/// lattices of beams, area mode for sheets whose edges are only a discretisation.
namespace plekton::dynamics {

/// Edge mode: each node of a beam gets m = 1/2 rho A L, and the inertia 2/5 m r² of a ball, r =
/// sqrt(A / pi). Effeindzourou et al., Geotextiles and Geomembranes 44 (2016) 143-156.
/// @param density  kg/m³
void add_beam_mass(NodeProperties& properties, const BeamBond& beam, double density) noexcept;

/// Edge mode for an edge that no beam lies along, as in a sheet: the same as for a beam of full
/// circular section.
/// @param radius   m
/// @param density  kg/m³
void add_edge_mass(NodeProperties& properties, const std::array<NodeId, 2>& nodes,
                   geometry::Positions positions, double radius, double density) noexcept;

/// Area mode: each node of a facet gets m = rho 2 r A / 3, and the inertia 2/5 m r² of a ball. A
/// facet without area adds nothing.
/// @param density  kg/m³
void add_facet_mass(NodeProperties& properties, const geometry::Facet& facet,
                    geometry::Positions positions, double density) noexcept;

}  // namespace plekton::dynamics

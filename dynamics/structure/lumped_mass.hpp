// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "geometry/primitives/facet.hpp"

#include <cstdint>

/// How the mass of a structure is given to its nodes. Use one mode for a structure: edge mode for
/// lattices of beams, area mode for sheets whose edges are only a discretisation.
namespace plekton::dynamics {

/// The moment of inertia of what a node stands for, the same about every axis.
enum class NodalInertia : std::uint8_t {
  ball,   ///< 2/5 m r², as Effeindzourou et al. 2016
  length  ///< m (r² / 4 + L² / 12): of half of a bar of length L about its end. A contact that
          ///< turns a node then limits the step no more than one that moves it.
          ///<
          ///< What it costs: in a mode of wave number q nodes turn by q times what they move, so
          ///< omega² falls by (q L)² / 12, and the frequency of the bending mode with n bars in
          ///< each half wave by pi² / (24 n²) = 0.41 / n²: 1.6 % for 5 bars, 0.1 % for 20. About
          ///< the axis of a bar it is by (1 + L² / (3 r²)) / 2 too large: torsion swings that much
          ///< slower in its square. Statics, and all motion that turns little, stay.
};

/// Edge mode: each node of a beam gets m = 1/2 rho A L, and the inertia of a ball, r = sqrt(A /
/// pi), or of its length. Effeindzourou et al., Geotextiles and Geomembranes 44 (2016) 143-156.
/// @param density  kg/m³
void add_beam_mass(NodeProperties& properties, const BeamBond& beam, double density,
                   NodalInertia inertia = NodalInertia::ball) noexcept;

/// Edge mode for an edge that no beam lies along, as in a sheet: the same as for a beam of full
/// circular section.
/// @param radius   m
/// @param density  kg/m³
void add_edge_mass(NodeProperties& properties, const std::array<NodeId, 2>& nodes,
                   geometry::Positions positions, double radius, double density,
                   NodalInertia inertia = NodalInertia::ball) noexcept;

/// Area mode: each node of a facet gets m = rho 2 r A / 3, and the inertia 2/5 m r² of a ball, or
/// that of its length with the mean of L² of the two sides that meet there. A facet without area
/// adds nothing.
/// @param density  kg/m³
void add_facet_mass(NodeProperties& properties, const geometry::Facet& facet,
                    geometry::Positions positions, double density,
                    NodalInertia inertia = NodalInertia::ball) noexcept;

}  // namespace plekton::dynamics

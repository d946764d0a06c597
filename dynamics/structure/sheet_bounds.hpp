// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/sheet_spring.hpp"

#include <array>

/// How stiff a facet of a sheet is at most, for the critical time step.
namespace plekton::dynamics {

class NodalStiffness;

/// Largest eigenvalues at rest of the parts of a facet's stiffness matrix.
struct SheetBounds {
  double in_plane;  ///< N/m
  double across;    ///< N/m, of normal motion, and of rotations times their radius
  double turning;   ///< N m, about the normal
  double gyration;  ///< m², squared radius by which rotations are counted
  double tension;   ///< -, times the membrane force: of the tension
};

SheetBounds bounds_of(const SheetFacet& facet, const SheetSpring& spring);

/// Adds the stiffness of a facet as it is now; see SheetFacets.
void add_stiffness(const SheetSpring& spring, const SheetBounds& bounds,
                   const std::array<NodeId, 3>& nodes, const NodeState& state,
                   NodalStiffness& stiffness);

}  // namespace plekton::dynamics

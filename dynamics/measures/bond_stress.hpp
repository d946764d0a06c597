// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/bond_forces.hpp"

namespace plekton::dynamics {

/// Largest stresses (Pa) in the section of a bond. The fibre that bears most has the magnitude of
/// axial, and bending on top of it.
struct BondStress {
  double axial = 0.0;  ///< tension over area, negative in compression
  double bending =
      0.0;  ///< >= 0, of the outermost fibre, at the end with the larger moment: M r / I
  double torsion = 0.0;  ///< >= 0, shear stress at the surface: T r / J
};

/// With r the radius of a full circle of the area of the section: exact where it is one. Bars bear
/// no bending and no torsion; then these are 0.
BondStress bond_stress(const BondForces& forces, const BeamSection& section) noexcept;

}  // namespace plekton::dynamics

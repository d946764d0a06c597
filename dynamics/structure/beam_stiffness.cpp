// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_stiffness.hpp"


#include <algorithm>
#include <numbers>

namespace plekton::dynamics {

// Let u and t be the sum and difference of the nodes' rotations across the beam, and v the relative
// displacement across it. For any gamma > 0 the energies of shear and bending are 1/2 of
//   12 EI/(L0 L²) (v - L/2 u)² + EI/L0 t²
//     <= 12 EI/(L0 L²) (1 + 1/gamma) v² + 3 EI/L0 (1 + gamma) u² + EI/L0 t²,
// with v² <= 2 (v_a² + v_b²), and u² + t² = 2 (u_a² + u_b²) since sum and difference are
// orthogonal: the larger of their factors holds for both. gamma = 4 rho² / L², with rho² = 2/5 A /
// pi the square of a node's radius of gyration, makes both parts limit the step alike.
//
// That is the bond at rest. Bending does not make it stiffer: by turns of either of two directions
// half the square of their angle theta has the second derivatives 1 and theta cot theta <= 1
// (BeamBonds). The shear of a bond that is bent at the same time does, with the square of both
// angles: its largest stiffness was at most 1.04 times this one in 60 000 random bonds with theta
// up to 60 degrees, 2 % of the frequency, and 4.2 times where the ends point against the chord.
void add_beam(NodalStiffness& stiffness, const BeamBond& bond, const NodeState& state,
              double rest_length) {
  const BeamSection& section = bond.section;
  const Vec3 chord =
      state.position[index_of(bond.nodes[1])] - state.position[index_of(bond.nodes[0])];
  const double distance = chord.norm();
  const double length = distance > 0.0 ? distance : bond.length;
  const Vec3 n = distance > 0.0 ? Vec3(chord / distance) : Vec3(Vec3::UnitX());

  const double axial = section.young_modulus * section.area / bond.length;
  const double bending = section.young_modulus * section.second_moment / bond.length;
  const double twist = section.shear_modulus * section.torsion_constant / bond.length;
  const double gamma = 1.6 * section.area / (std::numbers::pi * length * length);
  const double shear = 12.0 * bending / (length * length) * (1.0 + 1.0 / gamma);
  const double tension = std::max(0.0, axial * (length - rest_length));

  const Mat3 translation = along_and_across(n, 2.0 * axial, 2.0 * (shear + tension / length));
  const Mat3 rotation = along_and_across(n, 2.0 * twist, 6.0 * bending * (1.0 + gamma));
  for (const NodeId node : bond.nodes) stiffness.add_to_node(node, translation, rotation);
}

}  // namespace plekton::dynamics

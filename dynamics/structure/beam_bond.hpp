// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

#include <array>
#include <iosfwd>
#include <string_view>

namespace plekton::dynamics {

// beam_bonds.hpp and beam_kernel.hpp
class BeamBonds;
template <class Number>
struct BeamSpringOf;

/// Section and material of a beam. With second_moment and torsion_constant 0 it is a bar, which
/// only resists stretching.
struct BeamSection {
  double young_modulus;     ///< Pa, > 0
  double shear_modulus;     ///< Pa, > 0
  double area;              ///< m², > 0
  double second_moment;     ///< m⁴, >= 0, the same about both axes
  double torsion_constant;  ///< m⁴, >= 0
};

/// Full circular section: A = pi r², I = pi r⁴ / 4, J = 2 I, G = E / (2 (1 + nu)).
BeamSection circular_section(double radius, double young_modulus, double poisson_ratio) noexcept;

/// A bar of full circular section, which only resists stretching: the edges of a truss membrane. It
/// does not turn its nodes: hold their rotations, or contacts spin them freely.
BeamSection bar_section(double radius, double young_modulus) noexcept;

/// An Euler-Bernoulli beam between two nodes, in total form: force and torque follow from where the
/// nodes are and how they are turned now, with no history that could drift.
struct BeamBond {
  std::array<NodeId, 2> nodes;
  double length;  ///< m, at rest
  BeamSection section;
  Quat rest_a;  ///< unit; from the bond's frame (x along the beam) to that of node a, at rest
  Quat rest_b;  ///< likewise for node b
};

/// The beam between two nodes that is at rest where and as they are now.
/// @throws std::invalid_argument listing every problem (see list_problems)
BeamBond make_beam(NodeId a, NodeId b, const NodeState& at_rest, const BeamSection& section);

/// What the force needs to know of a bond.
BeamSpringOf<double> spring_of(const BeamBond& bond) noexcept;

/// Writes a line for everything that is wrong with a bond: a node that does not exist, the same
/// node at both ends, a length at rest that is not positive and finite, a section out of range, a
/// rest rotation that is not a unit quaternion.
/// @param name  how the lines begin, as in "bond 12"
void list_problems(const BeamBond& bond, std::size_t node_count, std::string_view name,
                   std::ostream& problems);

}  // namespace plekton::dynamics

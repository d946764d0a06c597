// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/chunks.hpp"
#include "dynamics/node_state.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// Section and material of a beam.
struct BeamSection {
  double young_modulus;     ///< Pa
  double shear_modulus;     ///< Pa
  double area;              ///< m²
  double second_moment;     ///< m⁴, the same about both axes
  double torsion_constant;  ///< m⁴
};

/// Full circular section: A = pi r², I = pi r⁴ / 4, J = 2 I, G = E / (2 (1 + nu)).
BeamSection circular_section(double radius, double young_modulus, double poisson_ratio) noexcept;

/// An Euler-Bernoulli beam between two nodes, in total form: force and torque follow from where the nodes are and how
/// they are turned now, with no history that could drift.
struct BeamBond {
  std::array<NodeId, 2> nodes;
  double length;  ///< m, at rest
  BeamSection section;
  Quat rest_a;  ///< from the bond's frame (x along the beam) to that of node a, at rest
  Quat rest_b;  ///< likewise for node b
};

}  // namespace plekton::dynamics

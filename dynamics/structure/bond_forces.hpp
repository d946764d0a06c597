// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"

namespace plekton::dynamics {

// beam_kernel.hpp
template <class Number>
struct BeamSpringOf;
template <class Number>
struct BeamEndsOf;
template <class Number>
struct BeamPoseOf;
template <class Number>
struct BeamReactionOf;

/// What a bond carries, in world axes.
///
/// Let n be the unit vector from node a to node b, and e_a, e_b the axes of the beam as the nodes
/// carry them; all three agree in a straight beam. With F the force and T_a, T_b the torques that
/// the bond exerts on its nodes,
///
///     F on b = shear - tension n = - F on a,
///     T_a = moment_a + torque e_a,   T_b = moment_b - torque e_b.
///
/// A cut through the beam thus has the bending moment -moment_a at a and moment_b at b, and
/// T_a + T_b + L n x shear = 0.
struct BondForces {
  double tension = 0.0;          ///< N, along the chord; negative in compression
  Vec3 shear = Vec3::Zero();     ///< N, across the chord
  Vec3 moment_a = Vec3::Zero();  ///< N m, across e_a; both are equal and opposite in pure bending
  Vec3 moment_b = Vec3::Zero();  ///< N m, across e_b
  double torque = 0.0;  ///< N m; positive if b is turned against a about the axis from a to b
};

/// The parts of what a bond does to its nodes.
BondForces parts_of(const BeamReactionOf<double>& reaction,
                    const BeamPoseOf<double>& pose) noexcept;

/// Of a bond whose ends are as given. Coincident nodes: see any_beam_pose.
BondForces bond_forces(const BeamSpringOf<double>& spring, const BeamEndsOf<double>& ends) noexcept;

}  // namespace plekton::dynamics

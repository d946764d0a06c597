// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/rotation_step.hpp"
#include "geometry/pack.hpp"

/// The arithmetic of a beam between two nodes, for one (Real = double) or for some side by side
/// (Real = Pack). The formulas are derived at BeamBonds.
namespace plekton::dynamics {

using geometry::PackVec3;

/// What the force needs to know of a bond.
template <class Real>
struct BeamSpringOf {
  Real length;          ///< m, at rest
  Real axial;           ///< N/m, EA / L0
  Real bending;         ///< N m, EI / L0
  Real twist;           ///< N m, GJ / L0
  QuatOf<Real> rest_a;  ///< unit; from the bond's frame to that of node a, at rest
  QuatOf<Real> rest_b;  ///< likewise for node b
};

/// Where the nodes of a bond are and how they are turned.
template <class Real>
struct BeamEndsOf {
  PackVec3<Real> chord;  ///< m, from node a to node b
  QuatOf<Real> turn_a;   ///< unit, from the node's frame to the world
  QuatOf<Real> turn_b;
};

/// How a bond lies.
template <class Real>
struct BeamPoseOf {
  QuatOf<Real> frame_a;  ///< of the beam, as node a carries it
  QuatOf<Real> frame_b;
  PackVec3<Real> a, b;  ///< unit, axes of the beam as the nodes carry them
  PackVec3<Real> n;     ///< unit, from node a to node b
  Real length;          ///< m, of the chord
  Real per_length;      ///< 1/m; 0 if the nodes coincide
};

/// What a bond does to its nodes.
template <class Real>
struct BeamReactionOf {
  PackVec3<Real> force;     ///< N, on b; the opposite acts on a
  PackVec3<Real> torque_a;  ///< N m
  PackVec3<Real> torque_b;  ///< N m
  Real tension;             ///< N
  Real energy;              ///< J
};

template <class Real>
PLEKTON_INLINE QuatOf<Real> product(const QuatOf<Real>& p, const QuatOf<Real>& q) noexcept {
  return {
      p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y, p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z,
      p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x, p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z};
}

/// First column of the rotation matrix of a unit quaternion.
template <class Real>
PLEKTON_INLINE PackVec3<Real> x_axis(const QuatOf<Real>& q) noexcept {
  const Real y2 = q.y + q.y;
  const Real z2 = q.z + q.z;
  return {Real(1.0) - (q.y * y2 + q.z * z2), q.x * y2 + q.w * z2, q.x * z2 - q.w * y2};
}

/// Nodes that coincide have no direction: then n is not finite, or not a number.
template <class Real>
PLEKTON_INLINE BeamPoseOf<Real> beam_pose(const BeamSpringOf<Real>& spring,
                                          const BeamEndsOf<Real>& ends) noexcept {
  const QuatOf<Real> frame_a = product(ends.turn_a, spring.rest_a);
  const QuatOf<Real> frame_b = product(ends.turn_b, spring.rest_b);
  const Real length = ends.chord.norm();
  const Real per_length = Real(1.0) / length;
  return {frame_a, frame_b,   x_axis(frame_a), x_axis(frame_b), per_length * ends.chord,
          length,  per_length};
}

/// How the frame of node b is twisted against that of node a.
template <class Real>
struct BeamTwistOf {
  Real x;                   ///< component along the beam of the quaternion from frame a to frame b
  PackVec3<Real> gradient;  ///< of 2 x by a turn of node b (1/rad)
};

/// With i the unit quaternion along x, the component is x = <p i, q> for frames p and q. A turn g
/// of b changes q by 1/2 g q, hence x by 1/2 <p i q*, g>: x and its gradient are the scalar and
/// the vector part of the one product p i q*.
template <class Real>
PLEKTON_INLINE BeamTwistOf<Real> beam_twist(const QuatOf<Real>& p, const QuatOf<Real>& q) noexcept {
  return {
      p.w * q.x - p.x * q.w + p.z * q.y - p.y * q.z,
      {p.w * q.w + p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.z + p.z * q.w + p.x * q.y + p.y * q.x,
       p.x * q.z + p.z * q.x - p.w * q.y - p.y * q.w}};
}

template <class Real>
PLEKTON_INLINE BeamReactionOf<Real> beam_reaction(const BeamSpringOf<Real>& spring,
                                                  const BeamPoseOf<Real>& pose) noexcept {
  using Vector = PackVec3<Real>;
  const Vector& n = pose.n;
  // Differences first: small rotations then lose no digits to cancellation.
  const Vector bend_a = pose.a - n;
  const Vector bend_b = pose.b - n;
  const Vector bend = bend_a + bend_b;
  const Real opening = Real(0.5) * (pose.a - pose.b).squaredNorm();
  const Real elongation = pose.length - spring.length;
  const Real moment = Real(6.0) * spring.bending;
  const Real shear = moment * pose.per_length;
  const Real tension = spring.axial * elongation;

  // The torque of the twist energy U_t(x) on b is -1/2 dU_t/dx times the gradient.
  const BeamTwistOf<Real> twist = beam_twist(pose.frame_a, pose.frame_b);
  const Real x2 = twist.x * twist.x;
  const Real twist_torque = spring.twist * (Real(2.0) + Real(4.0 / 3.0) * x2) * twist.x;
  const Vector relative =
      (spring.bending * (Real(2.0) + Real(5.0 / 12.0) * opening)) * pose.a.cross(pose.b) -
      twist_torque * twist.gradient;

  // The bracket of U, with |a - n|² + (a - n).(b - n) + |b - n|² = 1/2 s + 3/4 |a + b - 2 n|².
  const Real bend_energy =
      (Real(1.0) - Real(5.0 / 24.0) * opening) * opening + Real(1.5) * bend.squaredNorm();
  return {shear * bend - (shear * bend.dot(n) + tension) * n, moment * bend_a.cross(n) - relative,
          moment * bend_b.cross(n) + relative, tension,
          Real(0.5) * tension * elongation + spring.bending * bend_energy +
              spring.twist * (Real(2.0) + Real(2.0 / 3.0) * x2) * x2};
}

/// How one bond lies, whatever its chord: between coincident nodes the chord has the mean direction
/// of the axes, and per_length is 0.
inline BeamPoseOf<double> any_beam_pose(const BeamSpringOf<double>& spring,
                                        const BeamEndsOf<double>& ends) noexcept {
  BeamPoseOf<double> pose = beam_pose(spring, ends);
  if (!(pose.length > 0.0)) {
    const PackVec3<double> sum = pose.a + pose.b;
    const double size = sum.norm();
    pose.n = size > 0.0 ? (1.0 / size) * sum : PackVec3<double>::Zero();
    pose.per_length = 0.0;
  }
  return pose;
}

/// What one bond does, whatever its chord: between coincident nodes there is no shear force.
inline BeamReactionOf<double> any_beam_reaction(const BeamSpringOf<double>& spring,
                                                const BeamEndsOf<double>& ends) noexcept {
  return beam_reaction(spring, any_beam_pose(spring, ends));
}

}  // namespace plekton::dynamics

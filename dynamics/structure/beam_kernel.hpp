// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/rotation_step.hpp"
#include "geometry/base/pack.hpp"

#include <limits>

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

/// Half an angle over its sine, from 1 minus the cosine of the half: y = 1 - cos(angle / 2), from 0
/// (1, no angle) to 1 (pi / 2, half a turn).
///
/// acos(1 - y) / sqrt(y (2 - y)) is analytic where |y| < 2, the sum of n! / (2 n + 1)!! yⁿ. The
/// coefficients below are those of the polynomial that agrees with it at the 21 Chebyshev points of
/// [0, 1]: by Bernstein's theorem its error falls by 3 + sqrt(8) = 5.8 with each degree, and is
/// 3.4e-17 (relative) here, below rounding. The powers are summed in parts that need not wait for
/// each other (Estrin).
template <class Real>
PLEKTON_INLINE Real half_angle_over_sine(const Real& y) noexcept {
  constexpr int kDegree = 20;
  constexpr double kCoefficients[kDegree + 1] = {1.0,
                                                 0.33333333333330945,
                                                 0.13333333333682526,
                                                 0.05714285694042784,
                                                 0.025396831596651948,
                                                 0.011543895604776996,
                                                 0.00532944828305169,
                                                 0.0024737607111697374,
                                                 0.001251083869870826,
                                                 0.00016421047913476515,
                                                 0.0017011133906985544,
                                                 -0.003976427223224787,
                                                 0.009195329684833449,
                                                 -0.01586170544127971,
                                                 0.02153400343586953,
                                                 -0.022454256450108755,
                                                 0.01773831596916336,
                                                 -0.01025927464062151,
                                                 0.004114940516850556,
                                                 -0.001025639660813829,
                                                 0.00012117305831116537};
  const Real y2 = y * y;
  const Real y4 = y2 * y2;
  const Real y8 = y4 * y4;
  const auto c = [&](int n) __attribute__((always_inline)) {
    return Real(kCoefficients[n]);
  };
  const auto four = [&](int n) __attribute__((always_inline)) {
    return (c(n) + c(n + 1) * y) + (c(n + 2) + c(n + 3) * y) * y2;
  };
  const Real low = four(0) + four(4) * y4;
  const Real middle = four(8) + four(12) * y4;
  const Real high = four(16) + c(kDegree) * y4;
  return low + (middle + high * y8) * y8;
}

template <class Real>
PLEKTON_INLINE BeamReactionOf<Real> beam_reaction(const BeamSpringOf<Real>& spring,
                                                  const BeamPoseOf<Real>& pose) noexcept {
  using Vector = PackVec3<Real>;
  const Vector& n = pose.n;
  const Vector sum = pose.a + pose.b;
  const Real size_squared = sum.squaredNorm();
  const Real size = geometry::square_root(size_squared);
  // Quotient and root do not wait for each other. What underflows has no direction.
  const Vector mean = geometry::select(size_squared > Real(std::numeric_limits<double>::min()),
                                       (Real(1.0) / size_squared) * size, Real(0.0)) *
                      sum;
  // Differences first: small rotations then lose no digits to cancellation.
  const Vector opening = pose.a - pose.b;
  const Vector askew = mean - n;
  const Real askew_squared = askew.squaredNorm();
  // The gradient of |q| (|q| - q.n) by q over |q|: 2 m - (m.n) m - n, with 1 - m.n = |m - n|² / 2.
  const Vector pull = askew + (Real(0.5) * askew_squared) * mean;
  const Real ratio = half_angle_over_sine(Real(1.0) - Real(0.5) * size);
  const Real elongation = pose.length - spring.length;
  const Real moment = Real(3.0) * spring.bending * size;
  const Real shear = moment * size * pose.per_length;
  const Real tension = spring.axial * elongation;

  // The torque of the twist energy U_t(x) on b is -1/2 dU_t/dx times the gradient.
  const BeamTwistOf<Real> twist = beam_twist(pose.frame_a, pose.frame_b);
  const Real x2 = twist.x * twist.x;
  const Real twist_torque = spring.twist * (Real(2.0) + Real(4.0 / 3.0) * x2) * twist.x;
  const Vector relative =
      (spring.bending * ratio) * mean.cross(opening) - twist_torque * twist.gradient;

  const Real bend_energy = Real(0.5) * (ratio * ratio) * opening.squaredNorm() +
                           Real(1.5) * size_squared * askew_squared;
  return {shear * askew - (shear * askew.dot(n) + tension) * n,
          moment * pull.cross(pose.a) - relative, moment * pull.cross(pose.b) + relative, tension,
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

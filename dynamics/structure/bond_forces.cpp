// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_forces.hpp"

#include "dynamics/structure/beam_kernel.hpp"

namespace plekton::dynamics {
namespace {

Vec3 vector_of(const PackVec3<double>& v) noexcept {
  return {v.x, v.y, v.z};
}

}  // namespace

// The torques along the axes are equal and opposite: with r the quaternion p q* between the frames
// the gradient of the twist is the vector part of e_a r = r e_b, and its component along either
// axis is the scalar part of r.
BondForces parts_of(const BeamReactionOf<double>& reaction,
                    const BeamPoseOf<double>& pose) noexcept {
  const Vec3 n = vector_of(pose.n);
  const Vec3 force = vector_of(reaction.force);
  const Vec3 axis_a = vector_of(pose.a);
  const Vec3 axis_b = vector_of(pose.b);
  const Vec3 torque_a = vector_of(reaction.torque_a);
  const Vec3 torque_b = vector_of(reaction.torque_b);
  return {reaction.tension, force - force.dot(n) * n, torque_a - torque_a.dot(axis_a) * axis_a,
          torque_b - torque_b.dot(axis_b) * axis_b, -torque_b.dot(axis_b)};
}

BondForces bond_forces(const BeamSpringOf<double>& spring,
                       const BeamEndsOf<double>& ends) noexcept {
  const BeamPoseOf<double> pose = any_beam_pose(spring, ends);
  return parts_of(beam_reaction(spring, pose), pose);
}

}  // namespace plekton::dynamics

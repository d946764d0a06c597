// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/state/rigid_nodes.hpp"

#include <Eigen/Cholesky>

namespace plekton::dynamics {

Mat3 cross_matrix(const Vec3& c) noexcept {
  Mat3 matrix;
  matrix << 0.0, -c.z(), c.y(), c.z(), 0.0, -c.x(), -c.y(), c.x(), 0.0;
  return matrix;
}

Mat3 inertia_in_world(const Vec3& moments, const Quat& orientation) noexcept {
  const Mat3 axes = orientation.toRotationMatrix();
  return axes * moments.asDiagonal() * axes.transpose();
}

RigidNodes::RigidNodes(std::span<const RigidBody> bodies, const NodeState& state,
                       const NodeProperties& properties)
    : state_(&state), properties_(&properties) {
  if (bodies.empty()) return;
  body_of_follower_.assign(state.size(), -1);
  body_of_reference_.assign(state.size(), -1);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto body = static_cast<std::int32_t>(b);
    body_of_reference_[index_of(bodies[b].node)] = body;
    for (const NodeId node : bodies[b].nodes) body_of_follower_[index_of(node)] = body;
    references_.push_back(bodies[b].node);
    moments_.push_back(bodies[b].moments);
  }
}

Vec3 RigidNodes::lever_of(NodeId node) const noexcept {
  const std::int32_t body = body_followed_by(node);
  if (body < 0) return Vec3::Zero();
  return state_->position[index_of(node)] - state_->position[index_of(reference(body))];
}

// With I = C C^T of the free rows and columns, and 1 in place of those that are held, F C^-T is
// such a matrix, F the projection on what is free.
Mat3 RigidNodes::turn_root(std::int32_t body) const {
  const std::size_t node = index_of(reference(body));
  const Held held = properties_->held[node];
  if (holds_rotation(held)) return Mat3::Zero();
  const Vec3 is_free = free_turns(held);
  Mat3 inertia =
      inertia_in_world(moments_[static_cast<std::size_t>(body)], state_->orientation[node]);
  inertia = is_free.asDiagonal() * inertia * is_free.asDiagonal();
  inertia.diagonal() += Vec3::Ones() - is_free;
  const Eigen::LLT<Mat3> root(inertia);
  return is_free.asDiagonal() * root.matrixU().solve(Mat3::Identity());
}

Mat3 RigidNodes::point_mobility(std::int32_t body, const Vec3& lever) const {
  const std::size_t node = index_of(reference(body));
  const Mat3 moved = cross_matrix(lever) * turn_root(body);
  Mat3 mobility = moved * moved.transpose();
  const Held held = properties_->held[node];
  if (!holds_translation(held)) mobility.diagonal() += free_axes(held) / properties_->mass[node];
  return mobility;
}

Vec3 free_acceleration(NodeId node, const Vec3& force, const Vec3& gravity,
                       const NodeProperties& properties, const RigidNodes& rigid) noexcept {
  if (rigid.body_at(node) >= 0 || rigid.body_followed_by(node) >= 0) return Vec3::Zero();
  const std::size_t i = index_of(node);
  const Vec3 free = free_axes(properties.held[i]);
  if (free.isZero(0.0)) return Vec3::Zero();
  return free.cwiseProduct(gravity + force / properties.mass[i]);
}

}  // namespace plekton::dynamics

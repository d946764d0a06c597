// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/rigid_body.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// The matrix of v -> c x v.
Mat3 cross_matrix(const Vec3& c) noexcept;

/// kg m², about the axes of the world.
Mat3 inertia_in_world(const Vec3& moments, const Quat& orientation) noexcept;

/// Which nodes belong to which rigid body, where they are on it now, and how easily a push there
/// moves it.
class RigidNodes {
 public:
  /// No bodies.
  RigidNodes() = default;
  /// @param state, properties  of all nodes; they must outlive this, which follows the state
  RigidNodes(std::span<const RigidBody> bodies, const NodeState& state,
             const NodeProperties& properties);

  /// Number of bodies.
  std::size_t size() const noexcept { return references_.size(); }

  /// The body that a node follows, or -1.
  std::int32_t body_followed_by(NodeId node) const noexcept {
    return references_.empty() ? -1 : body_of_follower_[index_of(node)];
  }
  /// The body whose reference node a node is, or -1.
  std::int32_t body_at(NodeId node) const noexcept {
    return references_.empty() ? -1 : body_of_reference_[index_of(node)];
  }
  NodeId reference(std::int32_t body) const noexcept {
    return references_[static_cast<std::size_t>(body)];
  }
  /// The node whose motion moves a node: the reference node of its body, or itself.
  NodeId mover_of(NodeId node) const noexcept {
    const std::int32_t body = body_followed_by(node);
    return body < 0 ? node : reference(body);
  }
  /// m, from the reference node of its body to a node; zero of a node that follows none.
  Vec3 lever_of(NodeId node) const noexcept;

  /// 1/sqrt(kg m²), a matrix S with S S^T the inverse inertia of the motions that are free, zero
  /// about the axes of the world that are held.
  Mat3 turn_root(std::int32_t body) const;
  /// 1/kg, velocity of a point of a body for each unit of impulse on it.
  /// @param lever  m, from the reference node to the point
  Mat3 point_mobility(std::int32_t body, const Vec3& lever) const;

  /// By NodeId, the body that a node follows, or -1; empty without bodies.
  const std::vector<std::int32_t>& followed() const noexcept { return body_of_follower_; }

 private:
  const NodeState* state_ = nullptr;
  const NodeProperties* properties_ = nullptr;
  std::vector<std::int32_t> body_of_follower_;   // by NodeId
  std::vector<std::int32_t> body_of_reference_;  // by NodeId
  std::vector<NodeId> references_;               // by body
  std::vector<Vec3> moments_;                    // kg m², by body
};

/// m/s², of a node by a force (N) and gravity, along the axes that it is free in; 0 of parts of rigid
/// bodies.
Vec3 free_acceleration(NodeId node, const Vec3& force, const Vec3& gravity,
                       const NodeProperties& properties, const RigidNodes& rigid) noexcept;

}  // namespace plekton::dynamics

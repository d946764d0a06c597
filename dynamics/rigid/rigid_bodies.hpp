// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/state/rigid_body.hpp"

#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// The rigid bodies of a scene in motion.
///
/// In each step the forces on the nodes of a body are added up to a force and a torque on its
/// reference node (gather()), in the order of the nodes, so that the result does not depend on
/// threads. Its velocity is stepped as that of any node is (leapfrog.hpp), and its angular momentum
/// likewise; it then turns freely, with that momentum, over the drift. Its nodes are where they are
/// on it: their velocities are those that take them there, straight, within the drift, and the
/// leapfrog moves them. So are its own, with the mean angular velocity of the drift.
///
/// Momentum of translation and rotation is what the forces give, to rounding. The kinetic energy of
/// the turning is 1/2 L(t - dt/2) . I(t)^-1 L(t + dt/2), as the leapfrog has it. What is held about
/// some axes and turns about them is sped up or slowed down about the others: external work.
///
/// Numerical damping scales the components of the torque along the principal axes; where some axes
/// are held, those along the axes of the world.
class RigidBodies {
 public:
  /// @param state  at the start
  RigidBodies(std::span<const RigidBody> bodies, const NodeState& state);

  bool empty() const noexcept { return bodies_.empty(); }

  /// Takes the motions of the reference nodes: sets the velocities of the nodes that follow, and
  /// the angular momentum.
  void start(NodeState& state, const NodeProperties& properties);
  /// The same of one body, if the node is its reference node.
  void start_from(NodeId node, NodeState& state, const NodeProperties& properties);
  /// The same where the angular momentum goes on, as only its translation is another.
  void go_on_turning_from(NodeId node, NodeState& state, const NodeProperties& properties);

  /// Adds to the angular momentum (kg m²/s, about the centre of mass) of a body.
  void push_turning(std::size_t body, const Vec3& impulse) noexcept {
    bodies_[body].momentum += impulse;
  }

  /// J, of what is free to turn. (That of the translation is the reference node's.)
  double turning_energy(const NodeState& state, const NodeProperties& properties) const;

  /// Adds the forces on the nodes of each body to those on its reference node, whose held spins are
  /// set to what they were prescribed as.
  void gather(NodeState& state, NodeForces& forces, const NodeProperties& properties,
              geometry::ThreadPool& pool);

  /// Sets the velocities for the drift that begins now; the leapfrog has to follow. No allocation.
  /// @param forces  with the loads on the reference nodes
  StepWork step(NodeState& state, const NodeForces& forces, const NodeProperties& properties,
                const MotionOptions& options, const StepLengths& lengths,
                geometry::ThreadPool& pool);

  /// N, of all forces on the nodes of a body in the last gather(), without the loads on its reference
  /// node.
  const Vec3& gathered_force(std::size_t body) const noexcept { return bodies_[body].gathered; }
  /// N m, about the centre of mass, likewise.
  const Vec3& gathered_torque(std::size_t body) const noexcept {
    return bodies_[body].gathered_torque;
  }
  /// kg m²/s, angular momentum about the centre of mass, of a body that is free to turn.
  const Vec3& angular_momentum(std::size_t body) const noexcept { return bodies_[body].momentum; }

  /// @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

 private:
  struct Body {
    NodeId node;
    std::vector<NodeId> nodes;
    std::vector<Vec3> places;  ///< m, of nodes, in the frame of the body
    Vec3 moments;              ///< kg m²
    Vec3 momentum;             ///< kg m²/s, angular, world; about held axes of no meaning
    Vec3 gathered;             ///< N
    Vec3 gathered_torque;      ///< N m
    Vec3 held_spin;            ///< rad/s, about held axes; 0 about the others
  };

  /// How a body turns at the moment of a kick.
  struct Turning {
    Vec3 torque;  ///< N m
    Quat orientation;
    Held held;
    Vec3 last_held_spin;  ///< rad/s, until now
  };

  static void start(Body& body, NodeState& state, const NodeProperties& properties);
  static Vec3 turn(Body& body, const Turning& now, const MotionOptions& options,
                   const StepLengths& lengths, StepWork& work);
  static Vec3 turn_about_free_axes(Body& body, const Turning& now, const MotionOptions& options,
                                   const StepLengths& lengths, StepWork& work);
  static double lead(const Body& body, double drift, const NodeForces& forces, NodeState& state);
  static StepWork step(Body& body, NodeState& state, const NodeForces& forces,
                       const NodeProperties& properties, const MotionOptions& options,
                       const StepLengths& lengths);

  std::vector<Body> bodies_;
  geometry::ParallelSum<StepWork> sum_;
};

}  // namespace plekton::dynamics

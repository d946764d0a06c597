// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/time_step/coming_partner.hpp"

#include <cstddef>
#include <cstdint>

namespace plekton::dynamics {

/// A part of what holds a node.
struct StepPart {
  enum class Kind : std::uint8_t {
    nothing,
    bond,
    sheet_facet,
    tie,
    ball_contact,       ///< of the node's ball with another
    surface_contact,    ///< of a ball with a surface
    structure_contact,  ///< of two structures, or of one with itself
    plane_contact,
    coming_contacts,  ///< with all that may come to touch the node
    ground_springs,
    pressure
  };
  Kind kind = Kind::nothing;
  std::size_t id = 0;       ///< of a bond, sheet facet or tie
  NodeId a{-1};             ///< of a contact: its ball
  NodeId b{-1};             ///< of a contact: its other ball, or a node of its surface
  ComingPartner partner{};  ///< of coming_contacts: the stiffest of them
};

/// What limits a critical time step: a node, its motion, and the stiffest part of what holds it.
struct StepCause {
  CriticalStep step;
  StepPart part;
  double share = 0.0;  ///< of the part in the stiffness along that motion, from 0 to 1
  double without_gas_and_damping = step.dt;  ///< s, before gases and viscous damping shorten it
  double without_dashpots = step.dt;         ///< s, the same before dashpots of contacts do
};

/// Finds the stiffest part of what holds a node along the motion that limits a step. It has the
/// functions of NodalStiffness for contacts, and looks at each contact by itself.
class StiffestPart {
 public:
  /// @param step  finite; also whose node and motion
  /// @param rigid  must outlive this
  StiffestPart(const CriticalStep& step, const NodeProperties& properties, const RigidNodes& rigid);

  NodeId node() const noexcept { return step_.node; }

  /// Looks at a part.
  /// @param add  adds it to a NodalStiffness
  template <class Add>
  void consider(const StepPart& part, const Add& add) {
    space_.set_zero();
    add(space_);
    take(part, space_.along(step_, properties_));
  }

  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact);
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, const ContactStiffness& contact,
                      const SurfaceTurning& turning);
  void add_to_wall(NodeId ball, const ContactStiffness& contact);
  void add(NodeId node, const IsotropicStiffness& springs);

  StepCause cause() const noexcept;

 private:
  void take(const StepPart& part, double stiffness) noexcept;

  /// Whether the node is this one, or moves it with its rigid body.
  bool moves(NodeId node) const noexcept { return rigid_.mover_of(node) == step_.node; }

  CriticalStep step_;
  const NodeProperties& properties_;
  const RigidNodes& rigid_;
  NodalStiffness space_;
  StepPart stiffest_;
  double largest_ = 0.0;  // 1/s²
  double total_ = 0.0;    // 1/s²
};

}  // namespace plekton::dynamics

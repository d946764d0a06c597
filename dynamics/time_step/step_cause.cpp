// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_cause.hpp"

namespace plekton::dynamics {

using Kind = StepPart::Kind;

StiffestPart::StiffestPart(const CriticalStep& step, const NodeProperties& properties,
                           const RigidNodes& rigid)
    : step_(step), properties_(properties), rigid_(rigid), space_(1, &properties, &rigid) {
  space_.begin_at(index_of(step.node));
}

void StiffestPart::add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
  if (!moves(a) && !moves(b)) return;
  consider({Kind::ball_contact, 0, a, b},
           [&](NodalStiffness& space) { space.add_pair(a, b, contact); });
}

void StiffestPart::add_on_surface(NodeId ball, const geometry::CorePoint& core,
                                  const ContactStiffness& contact, const SurfaceTurning& turning) {
  consider({Kind::surface_contact, 0, ball, core.nodes[0]},
           [&](NodalStiffness& space) { space.add_on_surface(ball, core, contact, turning); });
}

void StiffestPart::add_to_wall(NodeId ball, const ContactStiffness& contact) {
  if (!moves(ball)) return;
  consider({Kind::plane_contact, 0, ball, NodeId{-1}},
           [&](NodalStiffness& space) { space.add_to_wall(ball, contact); });
}

void StiffestPart::add(NodeId node, const IsotropicStiffness& springs) {
  if (!moves(node)) return;
  consider({Kind::structure_contact, 0, node, NodeId{-1}},
           [&](NodalStiffness& space) { space.add(node, springs); });
}

void StiffestPart::take(const StepPart& part, double stiffness) noexcept {
  total_ += stiffness;
  if (!(stiffness > largest_)) return;
  largest_ = stiffness;
  stiffest_ = part;
}

StepCause StiffestPart::cause() const noexcept {
  return {step_, stiffest_, total_ > 0.0 ? largest_ / total_ : 0.0, step_.dt};
}

}  // namespace plekton::dynamics

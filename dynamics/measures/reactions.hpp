// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_record.hpp"
#include "dynamics/measures/force_and_moment.hpp"
#include "dynamics/state/node_state.hpp"

#include <functional>
#include <span>

/// What bodies and supports bear.
namespace plekton::dynamics {

using contact::NodeForces;

/// What all other bodies do to some by contact.
/// @param contacts  of a step
/// @param is_one    whether a body is one of those that are meant; what they do to each other
/// cancels
/// @param about     m, point of the moment
ForceAndMoment contact_force_on(std::span<const contact::ContactRecord> contacts,
                                const std::function<bool(const contact::ContactBody&)>& is_one,
                                const Vec3& about);

/// Forces on nodes and where these were.
struct LoadedNodesView {
  geometry::Positions position;  ///< m
  const NodeForces& forces;      ///< of contacts, bonds, sheets and loads
  const NodeProperties& properties;
  Vec3 gravity;  ///< m/s²
};

/// What the supports of some nodes bear, the opposite of what they do: contacts, bonds, sheets,
/// loads and the weight of these nodes, along and about the axes that are held. Along free axes
/// nothing is supported; the inertia of nodes that are moved is not counted.
/// @param about  m, point of the moment
ForceAndMoment support_reaction(std::span<const NodeId> nodes, const LoadedNodesView& view,
                                const Vec3& about);

}  // namespace plekton::dynamics

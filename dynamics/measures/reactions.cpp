// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/reactions.hpp"

namespace plekton::dynamics {

ForceAndMoment contact_force_on(std::span<const contact::ContactRecord> contacts,
                                const std::function<bool(const contact::ContactBody&)>& is_one,
                                const Vec3& about) {
  ForceAndMoment sum;
  for (const contact::ContactRecord& contact : contacts) {
    const bool on_a = is_one(contact.a);
    if (on_a == is_one(contact.b)) continue;
    const double sign = on_a ? -1.0 : 1.0;
    sum.add(contact.point - about, sign * contact.force(), sign * contact.moment);
  }
  return sum;
}

ForceAndMoment support_reaction(std::span<const NodeId> nodes, const LoadedNodesView& view,
                                const Vec3& about) {
  ForceAndMoment sum;
  for (const NodeId id : nodes) {
    const std::size_t i = index_of(id);
    const Held held = view.properties.held[i];
    const Vec3 along = Vec3::Ones() - free_axes(held);
    const Vec3 turns = Vec3::Ones() - free_turns(held);
    const Vec3 force = view.forces.force[i] + view.properties.mass[i] * view.gravity;
    sum.add(view.position[i] - about, along.cwiseProduct(force),
            turns.cwiseProduct(view.forces.torque[i]));
  }
  return sum;
}

}  // namespace plekton::dynamics

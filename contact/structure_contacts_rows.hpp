// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/slip_state.hpp"
#include "contact/structure_contacts.hpp"

/// Contacts of structures as they are reported.
namespace plekton::contact {

/// By patch, which of the acting terms overlaps most.
template <ContactLaw Law>
std::vector<std::uint32_t> StructureContacts<Law>::deepest_places() const {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> deepest(patches_.size(), kNone);
  const auto overlap = [&](std::uint32_t i) { return terms_[terms_.acting()[i]].overlap; };
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    std::uint32_t& so_far = deepest[places_[i].patch];
    if (so_far == kNone || overlap(i) > overlap(so_far)) so_far = i;
  }
  return deepest;
}

template <ContactLaw Law>
template <class Visit>
void StructureContacts<Law>::for_each_row(Positions x, Visit&& visit) const {
  const std::vector<std::uint32_t> deepest = deepest_places();
  const std::vector<SpreadSum> spreads = sum_spreads();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (patches_[i].pushes()) visit(row_of(patches_[i], spreads[i], deepest[i], x));
  }
  for (const Bond& bond : bonds_) {
    ContactRow row = row_of(bond);
    row.point_a = position(bond.a, x);
    row.point_b = position(bond.b, x);
    row.point = row.point_b + bond.lever_b(meetings_[bond.meeting]);
    visit(row);
  }
}

template <ContactLaw Law>
template <class Visit>
void StructureContacts<Law>::for_each_row_on(NodeId node, Positions x, Visit&& visit) const {
  NodeForces forces(x.size());
  Vec3& force = forces.force[index_of(node)];
  Vec3& torque = forces.torque[index_of(node)];
  auto patch = patches_.begin();
  auto bond = bonds_.begin();
  for_each_row(x, [&](const ContactRow& row) {
    force = torque = Vec3::Zero();
    while (patch != patches_.end() && !patch->pushes()) ++patch;
    if (patch != patches_.end()) {
      patch->add_forces(meeting_of(*patch), forces);
      const auto place = static_cast<std::uint32_t>(patch - patches_.begin());
      for (const Spread& spread : spreads_) {
        if (spread.patch == place) spread.add_forces(meetings_[spread.meeting], forces);
      }
      ++patch;
    } else {
      bond->add_forces(meetings_[bond->meeting], forces);
      ++bond;
    }
    visit(row, force, torque);
  });
}

/// All but its points.
template <ContactLaw Law>
ContactRow StructureContacts<Law>::row_of(const Bond& bond) const {
  const auto body = [&](const geometry::CorePoint& core) {
    return ContactBody{BodyKind::structure,
                       static_cast<std::int32_t>(surface_->structure_of(core.nodes[0])),
                       core.feature};
  };
  ContactRow row;
  row.id = bond.id;
  row.a = body(bond.a);
  row.b = body(bond.b);
  row.normal = bond.normal;
  row.gap = bond.gap;
  set_force(row, bond.other_force);
  row.moment = bond.moment;
  set_state<Law>(row, bond.parameters(meetings_[bond.meeting]), bond.memory.history, bond.pressing);
  return row;
}

template <ContactLaw Law>
ContactRow StructureContacts<Law>::row_of(const Patch& patch, const SpreadSum& spread,
                                          std::uint32_t deepest, Positions x) const {
  const Meeting& meeting = meeting_of(patch);
  const PairTerm& term = terms_[terms_.acting()[deepest]];
  const bool is_turned = places_[deepest].is_turned;
  const auto body = [&](const geometry::FeatureNodes& nodes) {
    return ContactBody{BodyKind::structure,
                       static_cast<std::int32_t>(surface_->structure_of(nodes.ids[0])),
                       geometry::feature_of(*surface_, nodes)};
  };
  ContactRow row;
  row.id = patch.id;
  row.a = body(is_turned ? term.b : term.a);
  row.b = body(is_turned ? term.a : term.b);
  row.point_a = patch.first.point();
  row.point_b = patch.second.point();
  row.point = row.point_b + patch.lever_of_second(meeting);
  row.normal = patch.memory.normal;
  row.gap = patch.gap;
  const double point_force = patch.point_part * patch.normal_force;
  set_force(row, patch.other_force);
  set_state<Law>(row, patch.parameters(meeting), patch.memory.history, point_force);
  row.is_slipping = row.is_slipping && !spread.sticks;
  row.elastic_force = patch.normal_force;
  set_force(row, patch.elastic_force + patch.second.total_attraction() + patch.other_force +
                     spread.force);
  row.moment = patch.second.moment_about(row.point, x) + spread.moment;
  if constexpr (HasMoments<Law>) row.moment += patch.moment;
  return row;
}

}  // namespace plekton::contact

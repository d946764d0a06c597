// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure_contacts.hpp"

/// What all contacts of structures come to.
namespace plekton::contact {

template <ContactLaw Law>
void StructureContacts<Law>::add_up_patches(Positions x) {
  largest_overlap_ratio_ = 0.0;
  for (Patch& patch : patches_) patch.reset();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    const Places& places = places_[i];
    const Meeting& meeting = meetings_[term.spring];
    const double radius = std::min(meeting.radius_first, meeting.radius_second);
    largest_overlap_ratio_ = std::max(largest_overlap_ratio_, term.overlap / radius);
    Patch& patch = patches_[places.patch];
    patch.energy += term.forces.energy;
    auto& side_a = places.is_turned ? patch.second : patch.first;
    auto& side_b = places.is_turned ? patch.first : patch.second;
    for (std::size_t k = 0; k < term.a.count; ++k)
      side_a.add_force(places.a[k], term.forces.on_a[k]);
    for (std::size_t k = 0; k < term.b.count; ++k)
      side_b.add_force(places.b[k], term.forces.on_b[k]);
    if (const structure::PairForces* const ends = terms_.at_ends(terms_.acting()[i])) {
      for (std::size_t k = 0; k < term.a.count; ++k) side_a.add_force(places.a[k], ends->on_a[k]);
      for (std::size_t k = 0; k < term.b.count; ++k) side_b.add_force(places.b[k], ends->on_b[k]);
    }
    const auto attract = [&](const structure::PairForces* by) {
      if (by == nullptr) return;
      patch.attraction_energy += by->energy;
      for (std::size_t k = 0; k < term.a.count; ++k)
        side_a.add_attraction(places.a[k], by->on_a[k]);
      for (std::size_t k = 0; k < term.b.count; ++k)
        side_b.add_attraction(places.b[k], by->on_b[k]);
    };
    attract(terms_.attraction(terms_.acting()[i]));
    attract(terms_.attraction_at_ends(terms_.acting()[i]));
  }
  for (Patch& patch : patches_) patch.find_totals(meeting_of(patch), x);
}

template <ContactLaw Law>
void StructureContacts<Law>::add_forces(NodeForces& forces) const {
  for (const Patch& patch : patches_) patch.add_forces(meeting_of(patch), forces);
  for (const Spread& spread : spreads_) spread.add_forces(meetings_[spread.meeting], forces);
  for (const Bond& bond : bonds_) bond.add_forces(meetings_[bond.meeting], forces);
}

template <ContactLaw Law>
double StructureContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  for (const Patch& patch : patches_)
    energy += patch.energy + patch.attraction_energy + history_energy(patch);
  for (const Spread& spread : spreads_) energy += spread.energy;
  for (const Bond& bond : bonds_) energy += bond.history_energy(meetings_[bond.meeting]);
  return energy;
}

template <ContactLaw Law>
template <class Visit>
void StructureContacts<Law>::for_each_stiffness(Visit&& visit) const {
  for (const Patch& patch : patches_) {
    if (!(patch.normal_force > 0.0)) continue;
    const Meeting& meeting = meeting_of(patch);
    const auto parameters = patch.whole_parameters(meeting);
    const auto on = [&](double radius) {
      return [&, radius](NodeId node, double share) {
        const double part = (1.0 - patch.bar_part) * std::abs(share);
        visit(node, part * Law::normal_stiffness(parameters, patch.gap),
              part * Law::tangential_stiffness(parameters, patch.gap), radius);
      };
    };
    if (patch.bar_part == 1.0) continue;
    patch.first.for_each_share(on(meeting.radius_first));
    patch.second.for_each_share(on(meeting.radius_second));
  }
  for (const Spread& spread : spreads_) {
    if (!spread.is_of_bar) continue;  // the patch tells that of facets
    const Meeting& meeting = meetings_[spread.meeting];
    // Joints in a wrap move one by one, against the whole spring of a bar.
    const double contacts = spread.is_wrapped ? std::max(1.0, spread.count) : spread.count;
    const auto parameters = Law::multiplied(meeting.parameters, contacts);
    const auto on = [&](const typename Spread::Side& side, double radius) {
      for (std::size_t i = 0; i < 3; ++i)
        visit(side.nodes[i], side.shares[i] * Law::normal_stiffness(parameters, spread.gap),
              side.shares[i] * Law::tangential_stiffness(parameters, spread.gap), radius);
    };
    on(spread.a, meeting.radius_first);
    on(spread.b, meeting.radius_second);
  }
  for (const Bond& bond : bonds_) {
    if (bond.gap < 0.0 || bond.is_broken) continue;  // the patch tells that of what touches
    const Meeting& meeting = meetings_[bond.meeting];
    const auto parameters = bond.parameters(meeting);
    const auto on = [&](const geometry::CorePoint& core, double radius) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = core.weights[static_cast<int>(i)];
        visit(core.nodes[i], share * Law::normal_stiffness(parameters, 0.0),
              share * Law::tangential_stiffness(parameters, 0.0), radius);
      }
    };
    on(bond.a, meeting.radius_first);
    on(bond.b, meeting.radius_second);
  }
}

}  // namespace plekton::contact

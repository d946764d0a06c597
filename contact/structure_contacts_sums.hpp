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
    const structure::PairForces* const attraction = terms_.attraction(terms_.acting()[i]);
    if (attraction == nullptr) continue;
    patch.attraction_energy += attraction->energy;
    for (std::size_t k = 0; k < term.a.count; ++k)
      side_a.add_attraction(places.a[k], attraction->on_a[k]);
    for (std::size_t k = 0; k < term.b.count; ++k)
      side_b.add_attraction(places.b[k], attraction->on_b[k]);
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
        visit(node, std::abs(share) * Law::normal_stiffness(parameters, patch.gap),
              std::abs(share) * Law::tangential_stiffness(parameters, patch.gap), radius);
      };
    };
    patch.first.for_each_share(on(meeting.radius_first));
    patch.second.for_each_share(on(meeting.radius_second));
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/slip_state.hpp"
#include "contact/structure_contacts.hpp"

#include <algorithm>

/// Friction of facets that lie on each other (structure/spread_contact.hpp).
namespace plekton::contact {

/// Finds what presses by its extent, with the histories of the last step.
template <ContactLaw Law>
void StructureContacts<Law>::find_spreads(Positions x) {
  previous_spreads_.swap(spreads_);
  spreads_.clear();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t acting = terms_.acting()[i];
    const PairTerm& term = terms_[acting];
    const structure::PairForces* const forces = terms_.spread(acting);
    if (forces == nullptr) continue;
    Spread spread;
    if (!spread.locate(term, *forces, meetings_[term.spring], x)) continue;
    spread.pair = terms_.holders(term).front().pair;
    spread.patch = places_[i].patch;
    spread.is_turned = places_[i].is_turned;
    spread.meeting = term.spring;
    Patch& patch = patches_[spread.patch];
    if (patch.pushes()) patch.point_part -= spread.normal_force / patch.normal_force;
    spreads_.push_back(spread);
  }
  for (Patch& patch : patches_) patch.point_part = std::clamp(patch.point_part, 0.0, 1.0);
}

/// Hands the histories of the last step over. What stood on pairs that press no more is dissipated.
template <ContactLaw Law>
EnergyLoss StructureContacts<Law>::carry_spreads(const Motion& motion, double dt) {
  EnergyLoss loss;
  for (const Spread& old : previous_spreads_) loss.dissipated += old.energy;
  for (std::size_t i = 0; i < spreads_.size(); ++i) {
    Spread& spread = spreads_[i];
    const std::int32_t before = pairs_[spread.pair].spread;
    if (before < 0) continue;
    const Spread& old = previous_spreads_[static_cast<std::size_t>(before)];
    spread.take_over(old, meetings_[spread.meeting], patches_[spread.patch].free_part, motion, dt);
    loss.dissipated -= old.energy;
    loss.tracking += old.energy - spread.energy;
  }
  for (PairOfCells& pair : pairs_) pair.spread = -1;
  for (std::size_t i = 0; i < spreads_.size(); ++i)
    pairs_[spreads_[i].pair].spread = static_cast<std::int32_t>(i);
  return loss;
}

/// @returns the energy (J) dissipated
template <ContactLaw Law>
double StructureContacts<Law>::advance_spreads(const Motion& motion, double dt,
                                               geometry::ThreadPool& pool) {
  pool.for_each_range(spreads_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Spread& spread = spreads_[i];
      spread.apply_law(meetings_[spread.meeting], patches_[spread.patch].free_part, motion, dt);
    }
  });
  double dissipated = 0.0;
  for (const Spread& spread : spreads_) dissipated += spread.dissipated;
  return dissipated;
}

/// By patch, what its spread contacts do to its second side about the point of its row.
template <ContactLaw Law>
std::vector<typename StructureContacts<Law>::SpreadSum> StructureContacts<Law>::sum_spreads()
    const {
  std::vector<SpreadSum> sums(patches_.size());
  for (const Spread& spread : spreads_) {
    const Meeting& meeting = meetings_[spread.meeting];
    const Patch& patch = patches_[spread.patch];
    const double sign = spread.is_turned ? -1.0 : 1.0;
    const Vec3 force = sign * spread.other_force;
    const Vec3 about = patch.second.point() + patch.lever_of_second(meeting);
    const Vec3 point = spread.b.point + spread.lever_b(meeting);
    SpreadSum& sum = sums[spread.patch];
    sum.force += force;
    sum.moment += sign * spread.moment + (point - about).cross(force);
    const Vec3 along =
        spread.other_force - spread.other_force.dot(spread.memory.normal) * spread.memory.normal;
    sum.sticks = sum.sticks || !is_at_limit<Law>(spread.parameters(meeting, patch.free_part),
                                                 spread.memory.history, spread.normal_force, along);
  }
  return sums;
}

}  // namespace plekton::contact

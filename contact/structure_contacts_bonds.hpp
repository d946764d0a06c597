// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure_contacts.hpp"

/// Bonds between structures (structure/structure_bond.hpp): where they are formed and broken.
///
/// The bonds of a patch together count for as many contacts as it did at most so far. Each pair of
/// cells has one, with a share by how hard it presses, so sheets peel off little by little. They
/// carry their part of the tangential force; the patch has the rest. Where a bond has broken the
/// patch forms no others: what slides or comes back is held by friction alone until it has parted.
namespace plekton::contact {

/// Finds where all bonds are, and forms new ones. @returns the energy (J) lost
template <ContactLaw Law>
double StructureContacts<Law>::prepare_bonds(const Motion& motion, geometry::ThreadPool& pool) {
  if (bonds_.empty() && !glues_) return 0.0;
  for (const Heir& heir : heirs_) patches_[heir.patch].is_torn |= previous_[heir.old_patch].is_torn;
  for (Bond& bond : bonds_) bond.patch = patch_of(bond);
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].locate(meetings_[bonds_[i].meeting], motion.position);
  });
  const double lost = form_bonds(motion.position);
  for (Gluing& of : gluing_) of.pressing = 0.0;
  for (const Bond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].pressing += bond.pressing;
  }
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const double share = gluing_[i].pressing / patches_[i].normal_force;
    if (gluing_[i].pressing > 0.0) patches_[i].free_part = std::max(0.0, 1.0 - share);
  }
  return lost;
}

/// That of its cells, or one that follows the patch of the last step; -1: there is none.
template <ContactLaw Law>
std::int32_t StructureContacts<Law>::patch_of(const Bond& bond) const {
  if (bond.pair >= 0) {
    const PairOfCells& pair = pairs_[static_cast<std::size_t>(bond.pair)];
    if (pair.patch >= 0) return pair.patch;
  }
  if (bond.patch < 0) return -1;
  const auto old = static_cast<std::uint32_t>(bond.patch);
  const auto heir =
      std::lower_bound(heirs_.begin(), heirs_.end(), old,
                       [](const Heir& of, std::uint32_t patch) { return of.old_patch < patch; });
  const bool is_followed = heir != heirs_.end() && heir->old_patch == old;
  return is_followed ? static_cast<std::int32_t>(heir->patch) : -1;
}

/// Glues what patches count for beyond their bonds. @returns the energy (J) lost
template <ContactLaw Law>
double StructureContacts<Law>::form_bonds(Positions x) {
  constexpr double kLeastGrowth = 1e-6;  // part of a patch that is worth the time
  gluing_.assign(patches_.size(), {});
  for (const Bond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].bonds += bond.count;
  }
  if (!glues_) return 0.0;
  list_pressed_pairs();
  for (Pressed& pressed : pressed_) {
    Gluing& gluing = gluing_[pressed.patch];
    const std::int32_t bond = pairs_[pressed.pair].bond;
    const double has = bond < 0 ? 0.0 : bonds_[static_cast<std::size_t>(bond)].count;
    pressed.wants = std::max(0.0, gluing.count_of(pressed.near, pressed.wide) - has);
    gluing.wants += pressed.wants;
  }
  double lost = 0.0;
  for (const Pressed& pressed : pressed_) {
    const Gluing& gluing = gluing_[pressed.patch];
    const double missing = gluing.near + gluing.wide - gluing.bonds;
    if (pressed.wants > 0.0 && missing > kLeastGrowth * (gluing.near + gluing.wide))
      lost += glue_pair(pressed, missing * pressed.wants / gluing.wants, x);
  }
  return lost;
}

/// Pairs of cells in patches that may have bonds, and how many contacts they count for: as many as
/// give their force along the patch's normal at its mean overlap.
template <ContactLaw Law>
void StructureContacts<Law>::list_pressed_pairs() {
  pressed_.clear();
  near_push_.assign(pairs_.size(), 0.0);
  for (const std::uint32_t acting : terms_.acting()) add_near_push(terms_[acting]);
  for (const std::uint32_t acting : terms_.acting()) {
    const PairTerm& term = terms_[acting];
    if (!term.is_of_cells || !glues<Law>(meetings_[term.spring].parameters)) continue;
    const structure::Holder& holder = terms_.holders(term).front();
    const auto patch = static_cast<std::uint32_t>(pairs_[holder.pair].patch);
    if (patches_[patch].is_torn || !patches_[patch].pushes()) continue;
    const double push = std::abs(structure::force_on_a(term).dot(patches_[patch].normal()));
    const double deepest =
        springs_[term.spring].force(springs_[term.spring].range() - term.overlap);
    const double one = Law::elastic_normal_force(
        meetings_[term.spring].parameters, push > 0.0 ? -2.0 * term.forces.energy / push : 0.0);
    if (!(one > 0.0) || !(deepest > 0.0)) continue;
    const double near = near_push_[holder.pair] / deepest;
    const double wide = std::max(0.0, push - term.point_share * term.weight * deepest) / one;
    pressed_.push_back({holder.pair, patch, acting, holder.is_turned, near, wide, 0.0});
    gluing_[patch].near += near;
    gluing_[patch].positive += std::max(0.0, near);
    gluing_[patch].wide += wide;
  }
}

/// Gives what a term does at its nearest points to the pairs of cells that have these: what is
/// taken off for a side goes to the cell that is nearest there, and leaves nothing of it. Of a pass
/// between two cells each has an equal part.
template <ContactLaw Law>
void StructureContacts<Law>::add_near_push(const PairTerm& term) {
  const structure::NormalSpring& spring = springs_[term.spring];
  const double push = term.point_share * term.weight * spring.force(spring.range() - term.overlap);
  const auto holders = terms_.holders(term);
  const auto has_them = [&](const structure::Holder& holder) {
    return terms_.of_cells(holder.pair).overlap == term.overlap;
  };
  const auto having = std::count_if(holders.begin(), holders.end(), has_them);
  const double sharing = static_cast<double>(having > 0 ? having : std::ssize(holders));
  for (const structure::Holder& holder : holders) {
    if (having == 0 || has_them(holder)) near_push_[holder.pair] += push / sharing;
  }
}

/// @returns the energy (J) lost
template <ContactLaw Law>
double StructureContacts<Law>::glue_pair(const Pressed& pressed, double count, Positions x) {
  PairOfCells& pair = pairs_[pressed.pair];
  const PairTerm& term = terms_[pressed.term];
  const Meeting& bodies = meetings_[term.spring];
  const auto at = structure::pressed_points(*surface_, term, springs_[term.spring].range(), x);
  if (pair.bond >= 0) return bonds_[static_cast<std::size_t>(pair.bond)].grow(bodies, at, count, x);
  std::optional<Bond> bond = structure::new_bond(bodies, at, count, x);
  if (!bond) return 0.0;
  bond->cells = pair.cells;
  bond->is_turned = pressed.is_turned;
  bond->meeting = term.spring;
  bond->pair = static_cast<std::int32_t>(pressed.pair);
  bond->patch = static_cast<std::int32_t>(pressed.patch);
  pair.bond = static_cast<std::int32_t>(bonds_.size());
  bonds_.push_back(*bond);
  return 0.0;
}

/// One step of the law for all bonds, after that for the patches.
/// @returns the energy (J) dissipated
template <ContactLaw Law>
double StructureContacts<Law>::advance_bonds(const Motion& motion, double dt,
                                             geometry::ThreadPool& pool) {
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].apply_law(meetings_[bonds_[i].meeting], motion, dt);
  });
  double dissipated = 0.0;
  for (Bond& bond : bonds_) {
    dissipated += bond.dissipated;
    if (bond.is_broken) dissipated += hand_to_patch(bond);
  }
  return dissipated;
}

/// What a broken bond still holds goes to the facets or the patch of its cells, if they touch.
/// @returns the energy (J) lost
template <ContactLaw Law>
double StructureContacts<Law>::hand_to_patch(Bond& bond) {
  double lost = bond.history_energy(meetings_[bond.meeting]);
  if (bond.patch >= 0) {
    Patch& patch = patches_[static_cast<std::size_t>(bond.patch)];
    patch.is_torn = true;
    const auto pair = static_cast<std::size_t>(bond.pair);
    if (bond.pair >= 0 && pairs_[pair].spread >= 0) {
      lost += hand_to_spread(bond, spreads_[static_cast<std::size_t>(pairs_[pair].spread)]);
    } else if (bond.pair >= 0 && pairs_[pair].patch >= 0 && patch.pushes()) {
      const double sign = bond.is_turned != pairs_[pair].is_turned ? -1.0 : 1.0;
      lost += history_energy(patch);
      Law::add_share(patch.memory.history,
                     carried_history<Law>(bond.memory, sign * patch.memory.normal, 0.0), sign);
      lost -= history_energy(patch);
    }
  }
  bond.memory.history = {};
  return lost;
}

/// The bond's points a and b are on the facets a and b. @returns the energy (J) lost
template <ContactLaw Law>
double StructureContacts<Law>::hand_to_spread(const Bond& bond, Spread& spread) {
  const double before = spread.energy;
  const auto carried = carried_history<Law>(bond.memory, spread.memory.normal, 0.0);
  Law::add_share(spread.memory.history, carried, std::min(1.0, bond.count / spread.count));
  const auto parameters =
      spread.parameters(meetings_[spread.meeting], patches_[spread.patch].free_part);
  spread.energy = Law::history_energy(parameters, spread.memory.history);
  return before - spread.energy;
}

/// Takes out those that broke in the last step.
template <ContactLaw Law>
void StructureContacts<Law>::drop_broken_bonds() {
  if (std::erase_if(bonds_, [](const Bond& bond) { return bond.is_broken; }) > 0) match_bonds();
}

/// Which pair of cells in the list each bond belongs to.
template <ContactLaw Law>
void StructureContacts<Law>::match_bonds() {
  for (PairOfCells& pair : pairs_) pair.bond = -1;
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    Bond& bond = bonds_[i];
    const auto pair = std::lower_bound(
        pairs_.begin(), pairs_.end(), bond.cells,
        [](const PairOfCells& of, const geometry::CellPair& cells) { return of.cells < cells; });
    const bool is_listed = pair != pairs_.end() && pair->cells == bond.cells;
    bond.pair = is_listed ? static_cast<std::int32_t>(pair - pairs_.begin()) : -1;
    if (is_listed) pair->bond = static_cast<std::int32_t>(i);
  }
}

/// Bonds on cells that have broken away are gone. @returns the energy (J) lost with them
template <ContactLaw Law>
double StructureContacts<Law>::keep_bonds(const geometry::SurfaceChange& change) {
  double lost = 0.0;
  std::erase_if(bonds_, [&](Bond& bond) {
    const auto a = change.now(bond.cells.a);
    const auto b = change.now(bond.cells.b);
    const bool is_left = a && b;
    if (is_left) {
      bond.cells = {*a, *b};
      bond.a.feature = *change.now(bond.a.feature);
      bond.b.feature = *change.now(bond.b.feature);
    } else {
      lost += bond.history_energy(meetings_[bond.meeting]);
    }
    return !is_left;
  });
  match_bonds();
  return lost;
}

}  // namespace plekton::contact

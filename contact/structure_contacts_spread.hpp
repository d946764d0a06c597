// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/slip_state.hpp"
#include "contact/structure_contacts.hpp"

#include <algorithm>

/// Friction of facets that lie on each other, and of bars (structure/spread_contact.hpp).
namespace plekton::contact {

/// How hard every pair of cells with a bar in it presses: its part of what all terms do that it
/// has, of each as much as every other pair has that has it. That is the rule of inclusion and
/// exclusion again: the joints of a chain take from the bars beside them what these have together.
template <ContactLaw Law>
void StructureContacts<Law>::share_pushes() {
  bar_push_.assign(pairs_.size(), 0.0);
  pressing_.assign(patches_.size(), {});
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    const auto holders = terms_.holders(term);
    const double part = 1.0 / static_cast<double>(holders.size());
    std::size_t bars = 0;
    for (const structure::Holder& holder : holders) {
      const PairTerm& cells = terms_.of_cells(holder.pair);
      if (cells.a.count == 3 && cells.b.count == 3) continue;
      bar_push_[holder.pair] += part * term.push;
      ++bars;
    }
    const double of_bars = bars == holders.size() ? 1.0 : part * static_cast<double>(bars);
    Pressing& pressing = pressing_[places_[i].patch];
    pressing.all += term.push;
    const structure::NormalSpring& spring = springs_[term.spring];
    pressing.deepest = std::max(pressing.deepest, spring.force(spring.range() - term.overlap));
    pressing.bars += of_bars * term.push;
    pressing.energy += of_bars * term.forces.energy;
    pressing.wraps = pressing.wraps || terms_.wraps(terms_.acting()[i]);
  }
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    if (bar_push_[pair] > 0.0)
      pressing_[static_cast<std::size_t>(pairs_[pair].patch)].positive += bar_push_[pair];
  }
}

/// Finds what presses by its extent or has a bar in it.
template <ContactLaw Law>
void StructureContacts<Law>::find_spreads(Positions x) {
  share_pushes();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Pressing& of = pressing_[i];
    if (of.bars > 0.0 && of.energy > 0.0 && of.positive > 0.0)
      patches_[i].bar_part = std::clamp(of.bars / of.all, 0.0, 1.0);
    patches_[i].point_part -= patches_[i].bar_part;
  }
  previous_spreads_.swap(spreads_);
  spreads_.clear();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t acting = terms_.acting()[i];
    const PairTerm& term = terms_[acting];
    if (!term.is_of_cells) continue;
    Spread spread;
    spread.pair = terms_.holders(term).front().pair;
    spread.patch = places_[i].patch;
    spread.is_turned = places_[i].is_turned;
    spread.meeting = term.spring;
    Patch& patch = patches_[spread.patch];
    if (const structure::PairForces* const extent = terms_.spread(acting)) {
      if (!spread.locate(term, *extent, meetings_[term.spring], x)) continue;
      if (patch.pushes()) patch.point_part -= spread.normal_force / patch.normal_force;
    } else if (!locate_bar(term, spread, x)) {
      continue;
    }
    spreads_.push_back(spread);
  }
  for (Patch& patch : patches_) patch.point_part = std::clamp(patch.point_part, 0.0, 1.0);
}

/// What pairs push less than nothing is taken from the others of their patch. Pairs of a patch that
/// is one contact have its normal, so that their springs add up to one.
/// @returns whether it presses
template <ContactLaw Law>
bool StructureContacts<Law>::locate_bar(const PairTerm& term, Spread& spread, Positions x) const {
  const Pressing& of = pressing_[spread.patch];
  const Patch& patch = patches_[spread.patch];
  const double push = bar_push_[spread.pair];
  if (!(push > 0.0) || !(patch.bar_part > 0.0)) return false;
  spread.is_wrapped = of.wraps;
  const double own = of.spread();
  Vec3 towards = (spread.is_turned ? -1.0 : 1.0) * (1.0 - own) * patch.elastic_force;
  if (patch.pushes()) towards /= patch.normal_force;
  return spread.locate_bar(
      term, {push * std::min(1.0, of.bars / of.positive), 2.0 * of.energy / of.bars, towards, own},
      meetings_[term.spring], x);
}

/// Hands the histories of the last step over: to the same pairs, and, of bars, what these count for
/// less to those beside them that come to count for more, so that a contact that moves over a joint
/// keeps its force. What nothing takes over is dissipated.
template <ContactLaw Law>
EnergyLoss StructureContacts<Law>::carry_spreads(const Motion& motion, double dt) {
  EnergyLoss loss;
  spread_at_.assign(pairs_.size(), -1);
  for (std::size_t i = 0; i < spreads_.size(); ++i)
    spread_at_[spreads_[i].pair] = static_cast<std::int32_t>(i);
  find_transfers();
  const auto follow = [&](std::uint32_t old, Spread& spread, double contacts) {
    Spread& from = previous_spreads_[old];
    spread.take_over(from, contacts, motion, dt);
    loss.tracking += from.energy;
    from.energy = 0.0;
  };
  for (Spread& spread : spreads_) {
    const std::int32_t before = pairs_[spread.pair].spread;
    if (before < 0) continue;
    const auto old = static_cast<std::uint32_t>(before);
    follow(old, spread, std::min(previous_spreads_[old].count, spread.count));
  }
  for (const Transfer& of : transfers_) follow(of.from, spreads_[of.to], of.contacts);
  for (const Spread& old : previous_spreads_) loss.dissipated += old.energy;
  for (Spread& spread : spreads_) {
    spread.memory.normal = spread.normal();
    spread.find_energy(meetings_[spread.meeting], patches_[spread.patch].free_part);
    loss.tracking -= spread.energy;
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) pairs_[i].spread = spread_at_[i];
  return loss;
}

/// From pairs that count for less than in the last step to those that share a term with them and
/// count for more: what is given is no more than either has less or more.
template <ContactLaw Law>
void StructureContacts<Law>::find_transfers() {
  transfers_.clear();
  const auto before = [&](std::uint32_t pair) {
    const std::int32_t at = pairs_[pair].spread;
    const bool is_bar = at >= 0 && previous_spreads_[static_cast<std::size_t>(at)].is_of_bar;
    return is_bar ? previous_spreads_[static_cast<std::size_t>(at)].count : 0.0;
  };
  const auto now = [&](std::uint32_t pair) {
    const std::int32_t at = spread_at_[pair];
    const bool is_bar = at >= 0 && spreads_[static_cast<std::size_t>(at)].is_of_bar;
    return is_bar ? spreads_[static_cast<std::size_t>(at)].count : 0.0;
  };
  for (const std::uint32_t acting : terms_.acting()) {
    const auto holders = terms_.holders(terms_[acting]);
    if (holders.size() < 2) continue;
    for (const structure::Holder& from : holders) {
      const double less = before(from.pair) - now(from.pair);
      if (!(less > 0.0)) continue;
      for (const structure::Holder& to : holders) {
        const double more = now(to.pair) - before(to.pair);
        if (more > 0.0)
          transfers_.push_back({static_cast<std::uint32_t>(pairs_[from.pair].spread),
                                static_cast<std::uint32_t>(spread_at_[to.pair]), less, more});
      }
    }
  }
  find_transfers_of_gone(now, before);
  std::sort(transfers_.begin(), transfers_.end());
  transfers_.erase(std::unique(transfers_.begin(), transfers_.end()), transfers_.end());
  asked_.assign(spreads_.size(), 0.0);
  for (auto begin = transfers_.begin(); begin != transfers_.end();) {
    auto end = begin;
    double more = 0.0;
    for (; end != transfers_.end() && end->from == begin->from; ++end) more += end->more;
    for (; begin != end; ++begin) {
      begin->contacts = begin->less * (begin->more / more);
      asked_[begin->to] += begin->contacts;
    }
  }
  for (Transfer& of : transfers_) of.contacts *= std::min(1.0, of.more / asked_[of.to]);
}

/// From pairs that press no more, and so have no term with others either: to those beside them in
/// the patches that follow theirs.
template <ContactLaw Law>
template <class Now, class Before>
void StructureContacts<Law>::find_transfers_of_gone(Now now, Before before) {
  goes_on_.assign(previous_spreads_.size(), 0);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (pairs_[i].spread >= 0 && spread_at_[i] >= 0)
      goes_on_[static_cast<std::size_t>(pairs_[i].spread)] = 1;
  by_patch_.clear();
  for (std::uint32_t from = 0; from < previous_spreads_.size(); ++from) {
    const Spread& old = previous_spreads_[from];
    if (goes_on_[from] != 0 || !old.is_of_bar) continue;
    if (by_patch_.empty()) {
      for (std::uint32_t i = 0; i < spreads_.size(); ++i)
        if (spreads_[i].is_of_bar) by_patch_.push_back({spreads_[i].patch, i});
      std::sort(by_patch_.begin(), by_patch_.end());
    }
    auto heir =
        std::lower_bound(heirs_.begin(), heirs_.end(), old.patch,
                         [](const Heir& of, std::uint32_t patch) { return of.old_patch < patch; });
    for (; heir != heirs_.end() && heir->old_patch == old.patch; ++heir) {
      auto at = std::lower_bound(by_patch_.begin(), by_patch_.end(),
                                 std::pair{heir->patch, std::uint32_t{0}});
      for (; at != by_patch_.end() && at->first == heir->patch; ++at) {
        const Spread& to = spreads_[at->second];
        const double more = now(to.pair) - before(to.pair);
        if (more > 0.0 && to.is_beside(old))
          transfers_.push_back({from, at->second, old.count, more});
      }
    }
  }
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure_contacts.hpp"

/// Which pairs of cells are one patch, and where their forces act.
namespace plekton::contact {

/// Pairs of cells hang together where they share a feature that acts.
template <ContactLaw Law>
void StructureContacts<Law>::find_patches() {
  for (PairOfCells& pair : pairs_) {
    pair.old_patch = pair.patch;
    pair.was_turned = pair.is_turned;
    pair.patch = -1;
  }
  connected_.reset(pairs_.size());
  constexpr std::int32_t kTouches = 0;
  for (const std::uint32_t acting : terms_.acting()) {
    const auto holders = terms_.holders(terms_[acting]);
    const structure::Holder& first = holders.front();
    for (const structure::Holder& holder : holders) {
      connected_.unite(first.pair, holder.pair, first.is_turned != holder.is_turned);
      pairs_[holder.pair].patch = kTouches;
    }
  }
  number_patches();
}

template <ContactLaw Law>
void StructureContacts<Law>::number_patches() {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    if (pairs_[i].patch < 0) continue;
    const auto place = connected_.find(i);
    // The root is the lowest of its patch: it comes first.
    pairs_[i].patch =
        place.root == i ? static_cast<std::int32_t>(count++) : pairs_[place.root].patch;
    pairs_[i].is_turned = place.is_turned;
  }
  patches_.resize(count);
}

template <ContactLaw Law>
void StructureContacts<Law>::find_places() {
  for (Patch& patch : patches_) {
    patch.first.clear();
    patch.second.clear();
  }
  places_.clear();
  for (const std::uint32_t acting : terms_.acting()) {
    const PairTerm& term = terms_[acting];
    const structure::Holder& holder = terms_.holders(term).front();
    const PairOfCells& pair = pairs_[holder.pair];
    const bool is_turned = holder.is_turned != pair.is_turned;
    places_.push_back({static_cast<std::uint32_t>(pair.patch), is_turned, {}, {}});
    Patch& patch = patches_[places_.back().patch];
    patch.meeting = term.spring;
    for (const NodeId node : term.a) (is_turned ? patch.second : patch.first).add(node);
    for (const NodeId node : term.b) (is_turned ? patch.first : patch.second).add(node);
  }
  for (Patch& patch : patches_) {
    patch.first.sort();
    patch.second.sort();
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    Places& places = places_[i];
    const Patch& patch = patches_[places.patch];
    const auto& side_a = places.is_turned ? patch.second : patch.first;
    const auto& side_b = places.is_turned ? patch.first : patch.second;
    for (std::size_t k = 0; k < term.a.count; ++k) places.a[k] = side_a.place_of(term.a.ids[k]);
    for (std::size_t k = 0; k < term.b.count; ++k) places.b[k] = side_b.place_of(term.b.ids[k]);
  }
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/term_parts.hpp"

#include <numeric>

namespace plekton::contact::structure {

void TermParts::find(const TermsInRange& terms, std::size_t pair_count) {
  constexpr std::int32_t kInRange = 0;
  parts_.assign(pair_count, kNone);
  sides_.resize(pair_count);
  connected_.reset(pair_count);
  for (const std::uint32_t term : terms.acting) {
    const auto holders = terms.holders_of(term);
    const Holder& first = holders.front();
    for (const Holder& holder : holders) {
      connected_.unite(first.pair, holder.pair, first.sides.with(holder.sides));
      parts_[holder.pair] = kInRange;
    }
  }
  firsts_.assign(number_parts() + 1, 0);
  // By counting, so that those of a part stay in their order.
  const auto part = [&](std::uint32_t term) {
    return static_cast<std::size_t>(parts_[terms.holders_of(term).front().pair]);
  };
  for (const std::uint32_t term : terms.acting) ++firsts_[part(term) + 1];
  std::inclusive_scan(firsts_.begin(), firsts_.end(), firsts_.begin());
  places_.resize(terms.acting.size());
  next_.assign(firsts_.begin(), firsts_.end());
  for (std::uint32_t i = 0; i < terms.acting.size(); ++i)
    places_[next_[part(terms.acting[i])]++] = i;
}

/// @returns how many there are
std::size_t TermParts::number_parts() {
  std::int32_t count = 0;
  for (std::uint32_t pair = 0; pair < parts_.size(); ++pair) {
    if (parts_[pair] == kNone) continue;
    const auto place = connected_.find(pair);
    // The root is the lowest of its part: it comes first.
    parts_[pair] = place.root == pair ? count++ : parts_[place.root];
    sides_[pair] = place.sides;
  }
  return static_cast<std::size_t>(count);
}

}  // namespace plekton::contact::structure

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shells.hpp"

#include <algorithm>
#include <utility>

namespace plekton::contact {

void Shells::build(std::span<const WholeFacet> facets) {
  facets_.assign(facets.begin(), facets.end());
  shells_.clear();
  reduced_.clear();
  side_entries_.clear();
  facet_entries_.clear();
  number_sides();
  drop_rims();
  if (facets_.empty()) return;
  reducer_.assign(side_ids_.size(), kNone);
  side_times_.assign(side_ids_.size(), 0.0);
  facet_times_.assign(facets_.size(), 0.0);
  for (std::uint32_t facet = 0; facet < facets_.size(); ++facet) reduce(facet);
}

void Shells::number_sides() {
  side_ids_.clear();
  for (const WholeFacet& facet : facets_)
    side_ids_.insert(side_ids_.end(), facet.sides.begin(), facet.sides.end());
  std::sort(side_ids_.begin(), side_ids_.end());
  side_ids_.erase(std::unique(side_ids_.begin(), side_ids_.end()), side_ids_.end());
  for (WholeFacet& facet : facets_) {
    for (std::uint32_t& side : facet.sides) {
      side = static_cast<std::uint32_t>(std::lower_bound(side_ids_.begin(), side_ids_.end(), side) -
                                        side_ids_.begin());
    }
  }
}

/// A facet alone on a side is in no shell, and dropping it may leave others alone.
void Shells::drop_rims() {
  sides_.assign(side_ids_.size(), Side{0, 0});
  for (std::uint32_t facet = 0; facet < facets_.size(); ++facet) {
    for (const std::uint32_t side : facets_[facet].sides) {
      ++sides_[side].facets;
      sides_[side].ids ^= facet;
    }
  }
  is_dropped_.assign(facets_.size(), 0);
  rims_.clear();
  for (std::uint32_t side = 0; side < sides_.size(); ++side) {
    if (sides_[side].facets == 1) rims_.push_back(side);
  }
  while (!rims_.empty()) {
    const Side rim = sides_[rims_.back()];
    rims_.pop_back();
    if (rim.facets == 0) continue;
    const std::uint32_t alone = rim.ids;
    is_dropped_[alone] = 1;
    for (const std::uint32_t side : facets_[alone].sides) {
      sides_[side].ids ^= alone;
      if (--sides_[side].facets == 1) rims_.push_back(side);
    }
  }
  std::size_t kept = 0;
  for (std::size_t facet = 0; facet < facets_.size(); ++facet) {
    if (is_dropped_[facet] == 0) facets_[kept++] = facets_[facet];
  }
  facets_.resize(kept);
}

void Shells::subtract(const Reduced& older, double factor) {
  for (const Entry& entry : std::span(side_entries_).subspan(older.first_side, older.side_count))
    side_times_[entry.at] -= factor * entry.times;
  for (const Entry& entry : std::span(facet_entries_).subspan(older.first_facet, older.facet_count))
    facet_times_[entry.at] -= factor * entry.times;
}

/// Adds nearer facets until no side is left, or one that no nearer facet is reduced to. (Shells in
/// space have no torsion, so the times stay -1, 0 and 1, or small whole numbers.)
void Shells::reduce(std::uint32_t facet) {
  for (std::size_t k = 0; k < 3; ++k)
    side_times_[facets_[facet].sides[k]] += facets_[facet].signs[k];
  facet_times_[facet] = 1.0;
  std::size_t last = side_times_.size();
  while (last-- > 0) {
    if (side_times_[last] == 0.0) continue;
    if (reducer_[last] == kNone) break;
    const Reduced& older = reduced_[reducer_[last]];
    const double times = side_entries_[older.first_side + older.side_count - 1].times;
    subtract(older, side_times_[last] / times);
  }
  const auto keep = [](std::vector<double>& times, std::size_t count, std::vector<Entry>& entries) {
    const std::size_t first = entries.size();
    for (std::uint32_t i = 0; i < count; ++i) {
      if (times[i] != 0.0) entries.push_back({i, std::exchange(times[i], 0.0)});
    }
    return std::pair(static_cast<std::uint32_t>(first),
                     static_cast<std::uint32_t>(entries.size() - first));
  };
  const auto [first, count] = keep(facet_times_, facet + 1, facet_entries_);
  if (last >= side_times_.size()) {
    shells_.push_back({facets_[facet].upper, first, count});
    return;
  }
  reducer_[last] = static_cast<std::uint32_t>(reduced_.size());
  const auto [first_side, side_count] = keep(side_times_, last + 1, side_entries_);
  reduced_.push_back({first_side, side_count, first, count});
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/merge_shares.hpp"

namespace plekton::contact {

void MergeShares::begin(std::span<const double> minima) {
  parts_.clear();
  minima_ = minima.size();
  for (const double distance : minima) parts_.push_back({distance, 0.0});
}

std::uint32_t MergeShares::join(std::uint32_t a, std::uint32_t b, double distance) {
  const auto both = static_cast<std::uint32_t>(parts_.size());
  const double of_a = parts_[a].amount + (distance - parts_[a].since);
  const double of_b = parts_[b].amount + (distance - parts_[b].since);
  const double sum = of_a + of_b;
  parts_[a].share = sum > 0.0 ? of_a / sum : 0.5;
  parts_[b].share = sum > 0.0 ? of_b / sum : 0.5;
  parts_[a].in = parts_[b].in = both;
  parts_.push_back({distance, sum});
  return both;
}

std::span<const double> MergeShares::shares() {
  shares_.resize(parts_.size());
  for (std::size_t i = parts_.size(); i-- > 0;) {
    const Part& part = parts_[i];
    shares_[i] = part.in == kNoPart ? 1.0 : shares_[part.in] * part.share;
  }
  return {shares_.data(), minima_};
}

}  // namespace plekton::contact

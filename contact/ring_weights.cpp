// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ring_weights.hpp"

#include <algorithm>

namespace plekton::contact {
namespace {

/// Of the level. Shorter intervals are left out: where hundreds of features are equally far, but
/// for rounding, each would cost as much as all others, and none pushes.
constexpr double kShortest = 1e-12;

}  // namespace

std::span<const RingWeights::Share> RingWeights::find(const geometry::Surface& surface,
                                                      const Vec3& point, double range,
                                                      std::span<const geometry::CellId> cells,
                                                      Positions x, std::span<const double> events) {
  near_.build(surface, point, range, cells, x);
  const auto feet = near_.vertices();
  shares_of_holes_.build(static_cast<std::uint32_t>(feet.size()), near_.links(), near_.fillings());
  hollows_.build(near_.whole_facets());
  sums_.assign(feet.size(), 0.0);
  list_levels(events);
  for (std::size_t i = 0; i < levels_.size(); ++i)
    add_interval(levels_[i], i + 1 < levels_.size() ? levels_[i + 1] : range);

  shares_.clear();
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (sums_[i] != 0.0) shares_.push_back({&feet[i], sums_[i] / (range - feet[i].distance)});
  }
  return shares_;
}

std::span<const RingWeights::Share> RingWeights::find_of_wires(
    const geometry::Surface& surface, const Vec3& point, double range,
    std::span<const geometry::CellId> cells, Positions x) {
  near_.build(surface, point, range, cells, x);
  const std::uint32_t vertices = near_.set_level(range);
  const auto weights = spanning_.find(vertices, near_.links());
  sums_.assign(vertices, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) sums_[near_.links()[i].a] += 1.0 - weights[i];
  shares_.clear();
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    if (sums_[i] != 0.0) shares_.push_back({&near_.vertices()[i], sums_[i]});
  }
  return shares_;
}

void RingWeights::list_levels(std::span<const double> events) {
  levels_.assign(events.begin(), events.end());
  for (const NearComplex::Vertex& foot : near_.vertices()) {
    if (foot.core.feature.kind == geometry::FeatureKind::node && foot.distance > events.front())
      levels_.push_back(foot.distance);
  }
  std::sort(levels_.begin(), levels_.end());
}

void RingWeights::add_interval(double lower, double upper) {
  if (!(upper - lower > kShortest * upper)) return;
  const double level = 0.5 * (lower + upper);
  const std::uint32_t below = near_.set_level(level);
  const auto shares = shares_of_holes_.find(below, near_.links());
  for (std::size_t i = 0; i < shares.size(); ++i)
    sums_[near_.links()[i].a] += (upper - lower) * shares[i];
  if (hollows_.hollow_count(below) > 0) take_hollows(below, level, upper - lower);
}

void RingWeights::take_hollows(std::uint32_t below, double level, double length) {
  corner_weights_.clear();
  for (std::uint32_t i = 0; i < below; ++i) {
    const double overlap = level - near_.vertices()[i].distance;
    corner_weights_.push_back(1.0 / (overlap * overlap));
  }
  const auto shares = hollows_.find(below, corner_weights_);
  for (std::size_t i = 0; i < shares.size(); ++i) sums_[i] -= length * shares[i];
}

}  // namespace plekton::contact

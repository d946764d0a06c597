// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ring_weights.hpp"

#include <numeric>

namespace plekton::contact {
namespace {

/// Of the level. Shorter intervals are left out: where hundreds of features are equally far, but
/// for rounding, each would cost as much as all others, and none pushes.
constexpr double kShortest = 1e-12;

}  // namespace

std::span<const RingWeights::Share> RingWeights::find(const geometry::Surface& surface,
                                                      const Vec3& point, double range,
                                                      std::span<const geometry::CellId> cells,
                                                      Positions x,
                                                      std::span<const RingEvent> events) {
  near_.build(surface, point, range, cells, x);
  const auto feet = near_.vertices();
  shares_of_holes_.build(static_cast<std::uint32_t>(feet.size()), near_.links(), near_.fillings());
  sums_.assign(feet.size(), 0.0);
  ring_count_.clear();
  for (std::size_t i = 0; i < events.size(); ++i)
    add_interval(events[i].level, i + 1 < events.size() ? events[i + 1].level : range);
  find_hollows(events);

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

void RingWeights::add_interval(double lower, double upper) {
  ring_count_.push_back(-1);
  if (!(upper - lower > kShortest * upper)) return;
  const std::uint32_t below = near_.set_level(0.5 * (lower + upper));
  const auto shares = shares_of_holes_.find(below, near_.links());
  ring_count_.back() = static_cast<int>(shares_of_holes_.hole_count(below));
  for (std::size_t i = 0; i < shares.size(); ++i)
    sums_[near_.links()[i].a] += (upper - lower) * shares[i];
}

/// Where there are more rings than the events say, a top has filled none. Only looked for if that
/// is so at the last level: in between, events an ulp apart may change places.
void RingWeights::find_hollows(std::span<const RingEvent> events) {
  hollows_.assign(events.size(), 0);
  const auto add = [](int sum, const RingEvent& event) { return sum + event.rings; };
  if (ring_count_.back() <= std::accumulate(events.begin(), events.end(), 0, add)) return;
  int expected = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    expected += events[i].rings;
    if (ring_count_[i] < 0) continue;
    hollows_[i] = ring_count_[i] - expected;
    expected = ring_count_[i];
  }
}

}  // namespace plekton::contact

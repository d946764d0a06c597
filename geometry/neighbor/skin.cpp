// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/skin.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace plekton::geometry {

namespace {

bool is_skin(double skin) noexcept {
  return std::isfinite(skin) && (skin == 0.0 || skin >= kSmallestSkin);
}

double checked(double skin) {
  if (!is_skin(skin)) {
    std::ostringstream message;
    message << "Skin: got a skin of " << skin << " m, expected 0 or a finite length of at least "
            << kSmallestSkin << " m; a tenth of the smallest radius is a good start";
    throw std::invalid_argument(message.str());
  }
  return skin;
}

/// m, largest coordinate.
double furthest(Positions x) {
  double furthest = 0.0;
  for (const Vec3& position : x) furthest = std::max(furthest, position.cwiseAbs().maxCoeff());
  return furthest;
}

}  // namespace

Skin::Skin(double skin) : skin_(checked(skin)) {}

void Skin::set(double skin) {
  skin_ = checked(skin);
  built_ = false;
}

void Skin::mark_built(Positions x) {
  built_positions_.assign(x.begin(), x.end());
  built_ = true;
  way_ = 0.0;
  furthest_ = furthest(x);
}

/// How far nodes have moved since then is not known of a state that was read: the next step asks.
void Skin::exchange(const StateArchive& archive) {
  archive("skin", skin_);
  archive("is_built", built_);
  archive("built_positions", built_positions_);
  archive.require(is_skin(skin_), "skin");
  if (!archive.is_reading()) return;
  way_ = std::numeric_limits<double>::infinity();
  furthest_ = furthest(built_positions_);
}

bool Skin::needs_rebuild(Positions x, ThreadPool& pool) {
  if (!built_ || skin_ == 0.0 || x.size() != built_positions_.size()) return true;
  const double limit = skin_ * skin_ * (1.0 - 1e-12);
  largest_.assign(static_cast<std::size_t>(pool.thread_count()), 0.0);
  std::atomic<bool> too_far = false;
  pool.for_each_range(x.size(), [&](std::size_t begin, std::size_t end, int worker) {
    bool exceeded = false;
    double largest = 0.0;
    for (std::size_t node = begin; node < end; ++node) {
      const double squared = (x[node] - built_positions_[node]).squaredNorm();
      // Written so that NaN counts as too far.
      exceeded |= !(4.0 * squared <= limit);
      largest = std::max(largest, squared);
    }
    largest_[static_cast<std::size_t>(worker)] = largest;
    if (exceeded) too_far.store(true, std::memory_order_relaxed);
  });
  way_ = (1.0 + 1e-15) * std::sqrt(*std::max_element(largest_.begin(), largest_.end()));
  return too_far.load(std::memory_order_relaxed);
}

/// Rounding: a step x += v dt is rounded twice, by at most eps / 2 of the way and of the coordinate
/// in each of three components; the sum and the speed by a few eps of it. Four eps of each pay for
/// all of it, and the last factor for the sums of a list that lasts a million steps.
double Skin::way_after(double way) const noexcept {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return way_ + ((1.0 + kRounding) * way + (way > 0.0 ? kRounding * (furthest_ + skin_) : 0.0));
}

bool Skin::may_need_rebuild(double way) noexcept {
  way_ = way_after(way);
  return may_be_over(way_);
}

}  // namespace plekton::geometry

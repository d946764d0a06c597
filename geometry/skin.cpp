// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/skin.hpp"

#include <atomic>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace plekton::geometry {

namespace {

double checked(double skin) {
  constexpr double kSmallestSkin = 1e-100;
  if (!std::isfinite(skin) || skin < 0.0 || (skin > 0.0 && skin < kSmallestSkin)) {
    std::ostringstream message;
    message << "Skin: got a skin of " << skin << " m, expected 0 or a finite length of at least "
            << kSmallestSkin << " m; a tenth of the smallest radius is a good start";
    throw std::invalid_argument(message.str());
  }
  return skin;
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
}

bool Skin::needs_rebuild(Positions x, ThreadPool& pool) const {
  if (!built_ || skin_ == 0.0 || x.size() != built_positions_.size()) return true;
  const double limit = skin_ * skin_ * (1.0 - 1e-12);
  std::atomic<bool> too_far = false;
  pool.for_each_range(x.size(), [&](std::size_t begin, std::size_t end, int) {
    bool exceeded = false;
    for (std::size_t node = begin; node < end; ++node) {
      // Written so that NaN counts as too far.
      exceeded |= !(4.0 * (x[node] - built_positions_[node]).squaredNorm() <= limit);
    }
    if (exceeded) too_far.store(true, std::memory_order_relaxed);
  });
  return too_far.load(std::memory_order_relaxed);
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/deferred_pairs.hpp"

#include "contact/tracking/rekey.hpp"
#include "geometry/primitives/cell_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plekton::contact {

namespace {

/// A cell in range is most often still there in the next steps: how many steps, this one
/// included, go by until it is looked at again.
constexpr double kStepsInRange = 8.0;

}  // namespace

void DeferredPairs::rebuild(std::span<const geometry::CellId> cells) {
  make_room(cells_, cells.size());
  make_room(wake_, cells.size());
  cells_.assign(cells.begin(), cells.end());
  wake_.assign(cells.size(), 0.0);
  is_new_ = true;
}

void DeferredPairs::begin_step(const Motion& motion) noexcept {
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  all_are_due_ = is_new_ || !std::isfinite(motion.max_displacement);
  if (!all_are_due_) {
    moved_ = (1.0 + kRounding) *
             (moved_ + 2.0 * motion.max_displacement + kRounding * (furthest_ + moved_));
    return;
  }
  moved_ = 0.0;
  furthest_ = 0.0;
  for (const Vec3& x : motion.position) furthest_ = std::max(furthest_, x.cwiseAbs().maxCoeff());
  is_new_ = false;
}

void DeferredPairs::find(const NearCells& near, const Vec3& centre, double range, Positions x,
                         NextCheck& next_check, std::vector<geometry::CellId>& found) {
  const std::size_t before = found.size();
  const bool is_due = all_are_due_ || !(moved_ < next_check.wake);
  if (!is_due && next_check.count == 1 && wake_[near.first] < 0.0) {  // most often
    wake_[near.first] += 1.0;
    found.push_back(cells_[near.first]);
    return;
  }
  const std::uint32_t end = near.first + (is_due ? near.count : next_check.count);
  double wake = is_due ? std::numeric_limits<double>::infinity() : next_check.wake;
  std::uint32_t next = near.first;
  for (std::uint32_t i = near.first; i < end; ++i) {
    if (all_are_due_ || wake_[i] >= 0.0) {
      if (all_are_due_ || !(moved_ < wake_[i])) {
        const double clearance = geometry::clearance(*surface_, cells_[i], centre, range, x);
        wake_[i] = clearance > 0.0 ? moved_ + clearance : -kStepsInRange;
      }
      if (wake_[i] > 0.0) {
        wake = std::min(wake, wake_[i]);
        continue;
      }
    }
    wake_[i] += 1.0;
    found.push_back(cells_[i]);
    std::swap(cells_[i], cells_[next]);
    std::swap(wake_[i], wake_[next]);
    ++next;
  }
  next_check = {wake, next - near.first};
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
}

}  // namespace plekton::contact

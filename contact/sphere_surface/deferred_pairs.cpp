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
  make_room(check_at_, cells.size());
  cells_.assign(cells.begin(), cells.end());
  check_at_.assign(cells.size(), 0.0);
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
  const bool is_due = all_are_due_ || !(moved_ < next_check.at);
  if (!is_due && next_check.count == 1 && check_at_[near.first] < 0.0) {  // most often
    check_at_[near.first] += 1.0;
    found.push_back(cells_[near.first]);
    return;
  }
  const std::uint32_t end = near.first + (is_due ? near.count : next_check.count);
  double check_at = is_due ? std::numeric_limits<double>::infinity() : next_check.at;
  std::uint32_t next = near.first;
  for (std::uint32_t i = near.first; i < end; ++i) {
    if (all_are_due_ || check_at_[i] >= 0.0) {
      if (all_are_due_ || !(moved_ < check_at_[i])) {
        const double clearance = geometry::clearance(*surface_, cells_[i], centre, range, x);
        check_at_[i] = clearance > 0.0 ? moved_ + clearance : -kStepsInRange;
      }
      if (check_at_[i] > 0.0) {
        check_at = std::min(check_at, check_at_[i]);
        continue;
      }
    }
    check_at_[i] += 1.0;
    found.push_back(cells_[i]);
    std::swap(cells_[i], cells_[next]);
    std::swap(check_at_[i], check_at_[next]);
    ++next;
  }
  next_check = {check_at, next - near.first};
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
}

}  // namespace plekton::contact

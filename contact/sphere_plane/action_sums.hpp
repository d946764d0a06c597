// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/plane_action.hpp"
#include "geometry/base/orderless_sum.hpp"

#include <array>
#include <cstddef>

namespace plekton::contact {

/// Sums of actions on a plane, the same however they are put together.
class ActionSums {
 public:
  void add(const PlaneAction& action) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      part(axis).add(action.force[axis]);
      part(3 + axis).add(action.moment[axis]);
    }
    part(6).add(action.push);
  }
  ActionSums& operator+=(const ActionSums& other) noexcept {
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] += other.parts_[i];
    return *this;
  }
  PlaneAction total() const noexcept {
    const auto vector = [this](std::size_t first) {
      return Vec3(parts_[first].value(), parts_[first + 1].value(), parts_[first + 2].value());
    };
    return {vector(0), vector(3), parts_[6].value()};
  }

 private:
  geometry::OrderlessSum& part(int i) noexcept { return parts_[static_cast<std::size_t>(i)]; }

  std::array<geometry::OrderlessSum, 7> parts_;
};

}  // namespace plekton::contact

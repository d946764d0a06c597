// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/segment_segment.hpp"

#include "geometry/closest/decide.hpp"
#include "geometry/closest/guess.hpp"

namespace plekton::geometry {

ClosestPoints segment_segment(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) noexcept {
  ++closest_counters().pairs;
  return closest::evaluate(a, b, closest::decide(a, b, closest::guess(a, b)));
}

}  // namespace plekton::geometry

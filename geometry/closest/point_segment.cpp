// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/point_segment.hpp"

#include "geometry/closest/decide.hpp"
#include "geometry/closest/guess.hpp"

namespace plekton::geometry {

ClosestPoints point_segment(const Vec3& p, const std::array<Vec3, 2>& b) noexcept {
  ++closest_counters().pairs;
  const closest::Corners a(&p, 1);
  return closest::evaluate(
      a, b, closest::decide_for_point(a, b, closest::guess_foot(p, b).witness_features));
}

}  // namespace plekton::geometry

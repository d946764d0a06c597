// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/bar_moments.hpp"

#include <numbers>

namespace plekton::dynamics {

// Along an axis from p to q the mean of x x^T is (p p^T + q q^T) / 3 + (p q^T + q p^T) / 6; across
// it, over a disc of radius r, r² / 4 of what is perpendicular.
VolumeMoments bar_moments(geometry::Positions points,
                          std::span<const std::array<geometry::NodeId, 2>> edges, double radius,
                          const Vec3& origin) noexcept {
  const double section = std::numbers::pi * radius * radius;
  VolumeMoments sum;
  for (const auto& edge : edges) {
    const Vec3 p = points[geometry::index_of(edge[0])] - origin;
    const Vec3 q = points[geometry::index_of(edge[1])] - origin;
    const double length = (q - p).norm();
    if (!(length > 0.0)) continue;
    const Vec3 along = (q - p) / length;
    const Mat3 ends = p * p.transpose() + q * q.transpose();
    const Mat3 mixed = p * q.transpose() + q * p.transpose();
    const Mat3 across = Mat3::Identity() - along * along.transpose();
    const double volume = section * length;
    sum += {volume, 0.5 * volume * (p + q),
            volume * (ends / 3.0 + mixed / 6.0 + 0.25 * radius * radius * across)};
  }
  return sum;
}

}  // namespace plekton::dynamics

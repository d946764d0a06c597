// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/largest_coordinate.hpp"
#include "geometry/closest/primitive_pairs.hpp"

#include <ostream>

namespace plekton::geometry {

/// A line for everything that keeps distances of a probe from being taken.
inline void list_probe_problems(const Probe& probe, std::ostream& problems) {
  if (probe.core.count < 1 || probe.core.count > 3) {
    problems << "the probe has " << probe.core.count << " corners; expected 1, 2 or 3\n";
    return;
  }
  if (!(probe.radius >= 0.0 && probe.radius < kLargestCoordinate))
    problems << "the probe has radius " << probe.radius << " m; expected from 0 to below 1e75\n";
  for (const Vec3& corner : probe.core.corners()) {
    if (!(corner.cwiseAbs().maxCoeff() < kLargestCoordinate && corner.allFinite())) {
      problems << "the probe has a corner at (" << corner.transpose()
               << ") m; coordinates must be finite and below 1e75\n";
    }
  }
}

}  // namespace plekton::geometry

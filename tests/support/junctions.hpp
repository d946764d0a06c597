// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

#include <algorithm>

/// Cylinders that meet in a node, and a ball dragged over them.
namespace plekton::test::dragged {

/// Cylinders of length 1 m from the origin, evenly in the plane z = 0, the first at this angle.
inline ProbedSurface junction(int branches, double first) {
  ProbedSurface star{{Vec3::Zero()}, {}, {}, kSurfaceRadius};
  for (int k = 0; k < branches; ++k) {
    const double angle = first + 2.0 * std::numbers::pi * k / branches;
    star.nodes.push_back(Vec3(std::cos(angle), std::sin(angle), 0.0));
    star.cylinders.push_back({0, k + 1});
  }
  return star;
}

/// How high over a place the centre is when its distance from the nearest branch is D.
inline double height_over(const ProbedSurface& star, const Vec3& place) {
  double nearest_squared = kDistance * kDistance;
  for (std::size_t k = 1; k < star.nodes.size(); ++k) {
    const double along = std::clamp(place.dot(star.nodes[k]), 0.0, 1.0);
    nearest_squared = std::min(nearest_squared, (place - along * star.nodes[k]).squaredNorm());
  }
  return std::sqrt(kDistance * kDistance - nearest_squared);
}

/// Over the junction, from place to place in the plane.
inline std::vector<Vec3> path_over(const ProbedSurface& star, const Vec3& from, const Vec3& to,
                                   int steps) {
  std::vector<Vec3> path = line(from, to, steps);
  for (Vec3& centre : path) centre.z() = height_over(star, centre);
  return path;
}

/// Sweeps over a junction in finer and finer steps: the force changes as much less as they are.
inline void expect_change_in_proportion(const ProbedSurface& star, const Vec3& from,
                                        const Vec3& to) {
  double last = 0.0;
  for (const int steps : {6000, 24000, 96000}) {
    ContactProbe probe(star, kSphereRadius, frictionless());
    const double jump = largest_jump(sweep(probe, path_over(star, from, to, steps)));
    // k_n times the way, twice at most: two overlaps change, each by at most the way.
    EXPECT_LE(jump, 2.0 * kNormalStiffness * (to - from).norm() / steps) << steps << " steps";
    if (last > 0.0) {
      EXPECT_NEAR(jump / last, 0.25, 0.05) << steps << " steps";
    }
    last = jump;
  }
}

}  // namespace plekton::test::dragged

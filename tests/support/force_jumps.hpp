// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

/// Whether the force on a ball follows its motion.
namespace plekton::test {

/// Largest change of the force from step to step along a straight way, in contacts of an overlap.
inline double largest_jump(const Complex& complex, double range, double overlap, const Vec3& from,
                           const Vec3& to, int steps) {
  const Surface surface = complex.surface();
  PatchFinder finder(surface);
  double jump = 0.0;
  Vec3 last = Vec3::Zero();
  for (int step = 0; step <= steps; ++step) {
    const Vec3 centre = from + static_cast<double>(step) / steps * (to - from);
    const auto cells = cells_near(surface, centre, range, complex.x);
    const Vec3 force = total_contact(finder, centre, range, cells, complex.x).force;
    if (step > 0) jump = std::max(jump, (force - last).norm() / overlap);
    last = force;
  }
  return jump;
}

/// Per step the force changes by a share of the contact that falls with the step.
/// @param hand_over  what may be left of a jump, in contacts: where the end of a hole passes from
///                   top to top (ring_weights.hpp)
/// @param steps      so many that the force goes about straight on in each of them
inline void expect_no_jump(const Complex& complex, double range, double overlap, const Vec3& from,
                           const Vec3& to, double hand_over = 0.0, int steps = 200) {
  const double coarse = largest_jump(complex, range, overlap, from, to, steps);
  const double fine = largest_jump(complex, range, overlap, from, to, 10 * steps);
  EXPECT_LE(fine, 0.2 * coarse + hand_over) << coarse << " -> " << fine;
}

}  // namespace plekton::test

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

/// The force changes in proportion to the step, ten times less in steps ten times as short, once
/// these are so short that it goes about straight on in each of them.
/// @param steps      of the longest; at most a thousand times as many
/// @param hand_over  what may be left of a jump, in contacts
inline void expect_no_jump(const Complex& complex, double range, double overlap, const Vec3& from,
                           const Vec3& to, int steps = 200,
                           double hand_over = 0.0) {
  double coarse = largest_jump(complex, range, overlap, from, to, steps);
  double fine = 0.0;
  for (const int times : {10, 100, 1000}) {
    fine = largest_jump(complex, range, overlap, from, to, times * steps);
    if (fine <= 0.11 * coarse + hand_over) return;
    coarse = fine;
  }
  ADD_FAILURE() << "it still changes by " << fine << " contacts in one of " << 1000 * steps
                << " steps";
}

}  // namespace plekton::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/contact_surfaces.hpp"

#include <functional>
#include <optional>

namespace plekton::geometry_check {

/// A ball that touches a surface.
struct Touch {
  const geometry::Surface& surface;
  const std::vector<geometry::Vec3>& x;  ///< m, nodes of the surface
  geometry::Vec3 centre;                 ///< m, of the ball
  double range;                          ///< m, radius of the ball + radius of the surface
};

/// What is checked: force (m, of a contact that pushes with its overlap) on the ball; none where it
/// promises nothing.
using ForceRule = std::function<std::optional<geometry::Vec3>(const Touch&)>;

/// Patches of contact/sphere_surface/patch.hpp; none where passes close a ring, because how fast
/// shares of a hole change depends on the ring.
std::optional<geometry::Vec3> force_of_patches(const Touch& touch);

struct ForceTally {
  int trials = 0;      ///< both ends of the step had a force
  int violations = 0;  ///< the force changed by more than the step allows
};

/// Moves balls over a surface by steps of 1e-10 to 1e-5 m.
///
/// The force of a contact with one convex cell or seam is (range - d) n, whose gradient has no
/// eigenvalue above max(1, range / d - 1) in size. The rule adds and subtracts such forces, of at
/// most all cells in range and their sides and corners, each as often as cells meet there. So a
/// step changes the force by at most number * max(1, range / d) * step, and a rule that switches a
/// contact on or off at any depth is found out.
/// @param complex  its cells have radius 0.1 m
ForceTally check_force(const test::Complex& complex, const ForceRule& rule, test::Random& random,
                       int balls);

}  // namespace plekton::geometry_check

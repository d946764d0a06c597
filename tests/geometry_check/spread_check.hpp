// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/spread_surface.hpp"

#include <functional>
#include <optional>
#include <vector>

/// What contacts promise that spread over many features: wires, nets and sheets that wrap a ball,
/// lie flat under it, are folded, or have holes. Springs have 1 N/m.
namespace plekton::geometry_check {

/// What all patches of a ball do.
struct SpreadPush {
  double energy = 0.0;                              ///< J
  geometry::Vec3 on_ball = geometry::Vec3::Zero();  ///< N
  std::vector<geometry::Vec3> on_nodes;             ///< N
  geometry::Vec3 away = geometry::Vec3::Zero();     ///< from all foot points to the ball, added up
  double deepest = 0.0;                             ///< m, overlap
  double sum = 0.0;                                 ///< N, sizes of the forces of all terms

  double force() const;  ///< N, sizes of the forces on the ball and on nodes
};

/// What is checked.
using SpreadRule = std::function<SpreadPush(const geometry::Surface&, const geometry::Vec3& centre,
                                            const std::vector<geometry::Vec3>& x)>;

/// Patches of contact/sphere_surface/patch.hpp.
SpreadPush push_of_patches(const geometry::Surface& surface, const geometry::Vec3& centre,
                           const std::vector<geometry::Vec3>& x);

/// The force on the ball and on every node is the energy's slope, to 1e-7 of the sum of their
/// sizes. None if the energy is smooth nowhere near the touch (slope.hpp).
std::optional<bool> has_gradient(const SpreadTouch& touch, const SpreadRule& rule,
                                 test::Random& random);

/// The energy is that of the deepest contact at least: of bars exactly, of facets but for 0.2 %
/// (contact/counting/cycle_weights.hpp).
bool counts_one(const SpreadTouch& touch, const SpreadRule& rule);

/// Where all that is in range lies before a plane through the ball's centre, the ball is pushed
/// away from it.
bool is_pushed_away(const SpreadTouch& touch, const SpreadRule& rule);

/// Where the energy is smooth, a tenth and a hundredth of a step change the forces by a tenth and a
/// hundredth. Everywhere a step of 1e-3 of the overlap, the steepest thousandth of it and the
/// steepest millionth change the force on the ball by no more than as many contacts as terms may
/// stand for (force_check.hpp), and as wires turn (contact/counting/wrap.hpp); and by what it
/// jumps where two tops tie (contact/counting/cycle_weights.hpp).
bool follows(const SpreadTouch& touch, const SpreadRule& rule, test::Random& random);

}  // namespace plekton::geometry_check

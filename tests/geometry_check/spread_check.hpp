// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/spread_surface.hpp"

/// What contacts promise that spread over many features: wires, nets and sheets that wrap a ball,
/// lie flat under it, are folded, or have holes. Springs have 1 N/m.
namespace plekton::geometry_check {

/// The force on the ball and on every node is the energy's slope, to 1e-7 of the largest that the
/// deepest contact may push with, times the root of the number of terms.
bool has_gradient(const SpreadTouch& touch, test::Random& random);

/// The energy is that of the deepest contact at least: of bars exactly, of facets but for 0.2 %
/// (contact/counting/ring_weights.hpp).
bool counts_one(const SpreadTouch& touch);

/// Where all that is in range lies before a plane through the ball's centre, the ball is pushed
/// away from it.
bool is_pushed_away(const SpreadTouch& touch);

/// Steps of 1e-3, 1e-4 and 1e-5 of the overlap change the force in proportion: by no more than as
/// many contacts as terms may stand for (force_check.hpp), and as wires turn
/// (contact/counting/wrap.hpp).
bool follows(const SpreadTouch& touch, test::Random& random);

}  // namespace plekton::geometry_check

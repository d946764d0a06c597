// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/spread_check.hpp"

namespace plekton::geometry_check {

/// Bars in one plane that meet at the origin, and a ball that rolls over their node.
struct Knot {
  test::Complex complex;
  bool is_of_straight_wires;  ///< every bar goes on in line beyond the node
  double depth;               ///< m, of the ball in the plane
  geometry::Vec3 way;         ///< unit, in the plane
};

/// A straight wire, with or without a side arm; two that cross; an even junction; any arms.
Knot any_knot(test::Random& random);

/// On the way over the node the ball has the energy of the pieces of wires that are in range
/// (tests/support/contact_rule_reference.hpp), exactly where straight wires cross. Where bars end at
/// the node it is no less, and by no more than kMostOfKnots more: wires that go on at an angle wrap
/// the ball a little (contact/counting/wrap.hpp).
bool rolls_evenly(const Knot& knot, const SpreadRule& rule);

/// Of the energy of one contact. What up to six bars get whose angles and lengths are let climb,
/// with the ball (check_test.cpp): 6.6 %, of three bars of the least length, each twice. Even
/// junctions get 2.7 %.
inline constexpr double kMostOfKnots = 0.067;

/// How much more than the pieces a node has at a place of the ball, in energies of one contact.
double excess_of_knot(const Knot& knot, const geometry::Vec3& foot, const SpreadRule& rule);

}  // namespace plekton::geometry_check

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <span>

/// What bars that wrap around something get back, a sphere or another structure, because what hangs
/// together in range is one contact (patch.hpp, surface_surface/nearest.hpp): each node that comes
/// into range takes from its bars what they have together, and a wrap would give way.
///
/// The rule that does not depend on where a bar is cut is additive: at a level s, the part of it
/// nearer than s, a bar counts by the angle of the half circle of radius s over its chord, over pi
/// (Abel's kernel, which counts a straight line as one). Beside the nodes that is one contact a bar
/// less one a node; at a node it is more by a sum over the bars, of
///
///     atan(y / t) / pi,    y = -r . e,    t^2 = s^2 - d^2,
///
/// with the separation r, of length d, from the other body to the node, and e the bar's direction,
/// unit, from the node: y is how far along the bar its foot is. Two bars in line with each other
/// have nothing more; less, if they bend away; and one contact, if both go down from a node that is
/// just in range. In the mean over the levels of a linear spring, with a range R and
/// t^2 = 2 d (s - d), in which terms of the order of the overlap over the distance are left out,
///
///     a(y / T) = [atan h + h (5/3 + h^2) - h^2 (2 + h^2) atan(1 / h)] / pi    with h = y / T,
///                                                                 T^2 = 2 d (R - d).
///
/// Bars count in it as far as they hold each other in balance along the surface: by the weights w
/// with the least |sum of w p|^2 + c sum of (w - 1)^2, where p are their directions along it. So a
/// node counts all bars of a straight wire, a crossing and a junction of three even wires, and not
/// what ends on a wire beside it, or the bars of a corner: a sphere that rolls over one feels no
/// bump.
///
///     x = sum of w a(y / T);    W = phi(d) (1 + c^2) x^3 / (x^2 + c^2 X^2)  for x > 0,
///
/// where phi is the energy of one contact. X is what x would be, were the feet in the middles of
/// the bars as they are in a wrap: X^2 = (n / 2)^2 L^2 / (L^2 + (3 pi T / 8)^2), which has its
/// limits for n bars of the mean square length L^2 both long and short against T. So a wrap gets
/// all of x back, whatever its mesh: half of a drum with 12 to 640 bars has the force of the
/// integral over the chain to 0.4 % up to overlaps of a twentieth of its radius; under a law after
/// Hertz meshes differ about as much as under a linear spring. And W starts as x^3, so that forces
/// on nodes are Lipschitz where wires pass through straight; the smaller c = kTurn, the less a wrap
/// is off that is not quite even, and the stiffer nodes are there: up to
/// 0.53 / c (T / L)^2 sqrt(1 + (3 pi T / 8 L)^2) contacts where bars are in line. With twice of c
/// the belt is off by up to 1.4 %.
///
/// W is a function of the separation and the bars alone; forces are its gradient.
namespace plekton::contact {

using geometry::Vec3;

constexpr double kTurn = 0.1;

/// A bar of a node.
struct WrapArm {
  Vec3 bar;                    ///< m, from the node to the other end
  Vec3 by_bar = Vec3::Zero();  ///< 1/m, derivative of what the node gets back
  // Working space.
  Vec3 direction, along;
  double length, foot, seen, slope;
};

/// How many contacts a node gets back, (1 + c^2) x^3 / (x^2 + c^2 X^2).
struct WrapShare {
  double contacts = 0.0;
  Vec3 by_separation = Vec3::Zero();  ///< 1/m
};

/// Nothing out of range, and where the separation has no length.
/// @param separation  m, to the node from the nearest point of the other body
/// @param range       m, where the energy of one contact ends
/// @param arms        all bars of the node; get the derivatives by them
WrapShare wrap_share(const Vec3& separation, double range, std::span<WrapArm> arms);

}  // namespace plekton::contact

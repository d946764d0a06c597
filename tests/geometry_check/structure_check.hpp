// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/any_structures.hpp"

#include <functional>
#include <optional>
#include <vector>

/// What structures promise that touch each other or themselves: nets, sheets with edges or rims in
/// common, sheets on their own mirror images, folded ones, ridges and rims of holes. Springs have 1
/// N/m. A configuration in which nothing touches is left out, and one whose cores meet, but for
/// those that are meant to cross.
namespace plekton::geometry_check {

/// What is checked: what a scene of structures does with its nodes there (m).
using StructureRule =
    std::function<StructurePush(StructureScene& scene, const std::vector<geometry::Vec3>& x)>;

/// contact/surface_surface/structure_contacts.hpp.
StructurePush push_of_structures(StructureScene& scene, const std::vector<geometry::Vec3>& x);

/// The forces on all nodes are the energy's slope, to 1e-7 of the sum of their sizes: of sheets on
/// each other as they come nearer, also where their edges coincide, and of all where every node has
/// gone by 1e-6 to 1e-4 m.
///
/// Nothing is claimed of ways along which edges that coincide come apart: the energy has a kink
/// there (tests/validation/README.md, S11), and the force at the tie itself need not be that of
/// either side. None if the energy is smooth nowhere near.
std::optional<bool> have_gradient(const Structures& structures, const StructureRule& rule,
                                  test::Random& random);

/// Forces and their moments add up to 0, to 1e-12 of the sum of their sizes (times 1 m). With bars
/// every node has gone by 1e-6 to 1e-4 m, and they do to 1e-10: where one lies along an edge and
/// crosses it at an angle t, what it has by its length over both facets pushes nodes with 1 / t of
/// their force, here 1e5, which cancels but for its rounding. Nothing is claimed of bars at the tie
/// itself: seen are 2e-8.
std::optional<bool> are_balanced(const Structures& structures, const StructureRule& rule,
                                 test::Random& random);

/// The energy is no less than that of pieces alone (tests/support/structure_rule_reference.hpp),
/// where facets touch at points and bars cross; but for what bars share with points beside their
/// nearest ones (contact/surface_surface/tilt_share.hpp).
///
/// Facets that lie flat count by their area, which may be less than one contact: nothing is claimed
/// of them.
std::optional<bool> count_pieces(const Structures& structures, const StructureRule& rule);

/// Where the energy is smooth, a tenth and a hundredth of a step change the forces by a tenth and a
/// hundredth. Everywhere a step, the steepest thousandth of it and the steepest millionth change the
/// energy of facets by no more than forces can that are a few times those seen.
///
/// Nothing like that is claimed of bars: the energy of one that is level but for 3e-4 falls by up
/// to the rise along it times the force where its end passes over the rim of a facet, or over
/// another bar that it is perpendicular to (contact/surface_surface/nearest.hpp).
std::optional<bool> follow(const Structures& structures, const StructureRule& rule,
                           test::Random& random);

/// On a way of 0.1 m, through each other, the energy of shells nowhere changes by more than 1 % of
/// it within 0.1 um.
///
/// Nothing is claimed of sheets with rims: their energy leaps by more on one of 2000 such ways, where
/// another way out becomes the shortest, which leads over a rim or does not
/// (contact/surface_surface/rim_share.hpp); nor of bars, as above.
std::optional<bool> keep_energy(const Structures& structures, const StructureRule& rule,
                                test::Random& random);

}  // namespace plekton::geometry_check

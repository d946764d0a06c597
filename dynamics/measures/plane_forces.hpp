// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/measures/force_and_moment.hpp"

#include <span>

/// What bodies do to planes, or would.
namespace plekton::dynamics {

/// What acts on one plane.
/// @param x      m, where the nodes were in that step
/// @param about  m, point of the moment
ForceAndMoment force_on_plane(const contact::Contacts& contacts, geometry::Positions x,
                              std::size_t plane, const Vec3& about);

/// N, how much of what acts on one plane is out of the space of the bodies.
double push_on_plane(const contact::Contacts& contacts, std::size_t plane);

/// By plane. @param reactions  one for each, zero
void add_plane_reactions(const contact::Contacts& contacts, std::span<PlaneReaction> reactions);

/// W, what bodies do to planes that turn about their axes.
/// @param x  m, where the nodes were in that step
double power_on_turning(const contact::Contacts& contacts, std::span<const contact::Plane> planes,
                        geometry::Positions x);

/// What all bodies that a plane would touch would do to it if it were a way (m) further along its
/// normal.
/// @param x  m, where the nodes are then
PlanePress press_on_plane(const contact::Contacts& contacts, std::span<const contact::Plane> planes,
                          std::size_t plane, double way, geometry::Positions x);

/// m/s, of the planes: of one that turns, the fastest where the nodes are.
double fastest_on_planes(std::span<const contact::Plane> planes, geometry::Positions x);

}  // namespace plekton::dynamics

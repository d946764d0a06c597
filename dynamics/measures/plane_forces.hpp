// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/loads/plane_servo.hpp"

#include <span>

/// What bodies do to planes, or would.
namespace plekton::dynamics {

/// W, what bodies do to planes that turn about their axes.
double power_on_turning(const contact::Contacts& contacts, std::span<const contact::Plane> planes);

/// What all bodies that a plane would touch would do to it if it were a way (m) further along its
/// normal.
/// @param x  m, where the nodes are then
PlanePress press_on_plane(const contact::Contacts& contacts, std::span<const contact::Plane> planes,
                          std::size_t plane, double way, geometry::Positions x);

/// m/s, of the planes: of one that turns, the fastest where the nodes are.
double fastest_on_planes(std::span<const contact::Plane> planes, geometry::Positions x);

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "geometry/neighbor/exclusion_groups.hpp"

#include <vector>

/// What follows from a scene, whatever its contact law.
namespace plekton::dynamics {

/// m, of any element; infinite where there is none.
double largest_radius(const geometry::Elements& elements);

/// m, by node: what it may move in one step before nothing could notice it any more. A sphere its
/// own radius, so that it cannot jump over what it should touch; other nodes the largest radius.
/// @param largest  m, largest_radius() of all there were at the start
std::vector<double> furthest_in_a_step(const Scene& scene, double largest);

/// m, smallest radius of a cylinder or facet; infinite where there is none.
double thinnest_structure(const geometry::Elements& elements);

/// Smallest radius (m) of what moves past others: of the spheres where there are some. Infinite if
/// there are no elements.
double pace_radius(const geometry::Elements& elements);

/// m, of the lists: what was asked for, or else a fifth of the pace radius.
/// @param asked  m; 0: choose
double chosen_skin(const Scene& scene, double asked);

/// Radius (m) of the ball around each node; 0 where there is none.
std::vector<double> node_radii(const Scene& scene, const geometry::Surface& surface);

/// By node. One that is held in place, or follows a rigid body that is, does not have to be kept
/// out of walls; what a servo drives presses on them, also where its other axes are held.
std::vector<bool> free_nodes(const Scene& scene);

/// kg, by node, as contacts see it: of what follows a rigid body its whole mass, infinite where its
/// translation is held.
std::vector<double> contact_masses(const Scene& scene);

/// Nodes of one rigid body do not touch each other.
geometry::ExclusionGroups rigid_groups(const Scene& scene);

/// The axis along or about which a servo moves its body.
Held driven_axis(const BodyServo& servo) noexcept;

/// By node, what is held by itself, prescribed by motions or driven by servos of rigid bodies.
std::vector<Held> held_with_loads(const Scene& scene);

/// The scene with prescribed motions held.
Scene held_as_prescribed(Scene scene);

/// The same, without the room that lists have which have grown: up to as much again.
Scene to_compute_with(Scene scene);

/// J, of what is free; of rigid bodies the translation alone.
double kinetic_energy(const NodeState& state, const NodeProperties& properties);

/// Mass times place (kg m) of the free nodes along the axes they are free in, at a time before now
/// (s).
Vec3 free_moment(const NodeState& state, const NodeProperties& properties, double before);

}  // namespace plekton::dynamics

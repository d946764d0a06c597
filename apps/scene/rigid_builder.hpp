// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// Adds the surface of a rigid body to the scene, among the membranes, and makes it a body.
/// @throws geometry::MeshError for a mesh that cannot be used; InputError for a body without volume
/// and without a mass
void add_rigid_surface(const RigidBodySettings& body, const MembraneSettings& surface,
                       BuiltScene& built);

/// Adds the spheres of a rigid body, among the grains, likewise.
void add_rigid_spheres(const RigidBodySettings& body, const GrainSettings& spheres,
                       BuiltScene& built);

/// Adds what loads prescribe to what is held of the rigid bodies.
/// @param scenario  whose loads are in the scene
/// @throws InputError listing every rigid body that is free along or about some axis and has no mass
void hold_as_loaded(const Scenario& scenario, BuiltScene& built);

}  // namespace plekton::apps

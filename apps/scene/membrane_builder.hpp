// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

namespace plekton::apps {

/// Imports the mesh of a membrane or makes its shape, and adds it to a scene.
/// @throws geometry::MeshError for a mesh or shape that cannot be used, InputError where no node is
/// held though some should be.
BuiltMembrane add_membrane(const MembraneSettings& settings, BuiltScene& built);

}  // namespace plekton::apps

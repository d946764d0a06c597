// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace plekton::apps {

/// What of a body begins inside of a closed membrane: grains, or nodes of a membrane. It may be
/// meant, as grains in a bag are; nothing need overlap there, so nothing else would tell.
struct EnclosedBody {
  std::string name;   ///< as in "grains.sand"
  std::string in;     ///< as in "membranes.bag"
  std::string parts;  ///< "grains" or "nodes"
  std::size_t inside = 0;
  std::size_t all = 0;
};

/// Of a simulation that has not made a step. Closed is a membrane whose facets have no rim; which
/// side a point is on is decided exactly (geometry/query/enclosure.hpp).
/// @param scene  that of the simulation, which may be without the elements of what is not there
std::vector<EnclosedBody> enclosed_bodies(const BuiltScene& built, const dynamics::Scene& scene);

/// Bodies that begin wholly inside of a rigid body that is solid, by its mass: as they do when a
/// mesh in millimetres is read as metres. With the sizes of both.
/// @param scene  likewise
std::vector<std::string> warnings_about_solids(const Scenario& scenario, const BuiltScene& built,
                                               const dynamics::Scene& scene);

/// A line for each, as in "inside at the start: 12 of 40 grains of grains.sand in membranes.bag".
std::string listing_of(const std::vector<EnclosedBody>& bodies);

}  // namespace plekton::apps

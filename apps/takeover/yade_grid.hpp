// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace plekton::apps::yade {

/// Grid nodes that connections and PFacets join, as one membrane: one thickness, one material of its
/// contacts, one section of its beams. Nodes are numbered within the grid, in the order of YADE's ids.
struct Grid {
  std::vector<std::size_t> nodes;                ///< among the nodes of the scene
  std::vector<std::array<std::size_t, 2>> bars;  ///< that are no side of a facet
  std::vector<std::array<std::size_t, 3>> facets;
  double radius = 0.0;
  int material = -1;           ///< of its contacts
  double young_modulus = 0.0;  ///< Pa, of its beams, by their normal stiffness
  double poisson_ratio = 0.0;  ///< by bending and torsion
  double density = 0.0;        ///< kg/m³, of round bars that have the mass of its nodes
  double strength = 0.0;       ///< Pa, N / (pi r²) at which a beam fails; 0: none does
  bool is_fragile = true;      ///< it breaks there at once; otherwise it yields
  bool bends = true;           ///< false: bars that only stretch
};

/// All grids of a scene, those with the lowest ids first.
/// @param notes  Gets a line for all that a membrane cannot say of them.
std::vector<Grid> grids_of(const Scene& scene, std::vector<std::string>& notes);

}  // namespace plekton::apps::yade

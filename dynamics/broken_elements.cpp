// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/broken_elements.hpp"

#include "dynamics/model/erase_elements.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace plekton::dynamics {
namespace {

using geometry::Cylinder;
using geometry::Facet;

using geometry::NodeSets;
using geometry::sides_of;
using geometry::sorted;
using Edge = std::array<NodeId, 2>;

NodeSets<2> edges_that_hold(const Scene& scene, const BeamBonds& bonds) {
  NodeSets<2> holding;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    if (!bonds.is_broken(i)) holding.add(scene.bonds[i].nodes);
  }
  holding.sort();
  return holding;
}

struct TornFacet {
  Facet facet;
  contact::MaterialId material;
};

NodeSets<3> sheets_that_hold(const SheetFacets& sheets) {
  NodeSets<3> holding;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    if (!sheets.is_broken(i)) holding.add(sheets.nodes(i));
  }
  holding.sort();
  return holding;
}

/// Edges and facets by their nodes.
struct Sets {
  NodeSets<2> edges;
  NodeSets<3> facets;
};

/// Facets that broke, or have a broken edge and no sheet that carries them without it.
std::vector<TornFacet> take_out_facets(Scene& scene, const Sets& broken,
                                       const NodeSets<3>& sheets) {
  std::vector<TornFacet> torn;
  const auto is_broken = [&](const Edge& side) { return broken.edges.contains(side); };
  erase_elements(scene.elements.facets, scene.facet_materials,
                 [&](const Facet& facet, contact::MaterialId material) {
                   const auto sides = sides_of(facet);
                   const bool is_torn = std::any_of(sides.begin(), sides.end(), is_broken) &&
                                        !sheets.contains(facet.nodes);
                   if (!is_torn && !broken.facets.contains(facet.nodes)) return false;
                   torn.push_back({facet, material});
                   return true;
                 });
  return torn;
}

/// Cylinders along the sides of torn facets that a bond holds.
void add_rims(Scene& scene, std::span<const TornFacet> torn, const NodeSets<2>& holding) {
  NodeSets<2> there;
  for (const Facet& facet : scene.elements.facets) {
    for (const Edge& side : sides_of(facet)) there.add(side);
  }
  for (const Cylinder& cylinder : scene.elements.cylinders) there.add(cylinder.nodes);
  there.sort();
  std::vector<std::pair<Edge, std::size_t>> rims;  // with their facet
  for (std::size_t i = 0; i < torn.size(); ++i) {
    for (const Edge& side : sides_of(torn[i].facet)) {
      if (holding.contains(side) && !there.contains(side)) rims.emplace_back(sorted(side), i);
    }
  }
  std::sort(rims.begin(), rims.end());
  const auto is_same = [](const auto& p, const auto& q) { return p.first == q.first; };
  rims.erase(std::unique(rims.begin(), rims.end(), is_same), rims.end());
  for (const auto& [nodes, i] : rims)
    scene.add_cylinder(nodes[0], nodes[1], torn[i].facet.radius, torn[i].material);
}

Sets sets_of(const Scene& scene, const BrokenParts& broken, const Sets& holding) {
  Sets sets;
  for (const std::size_t bond : broken.bonds) {
    if (!holding.edges.contains(scene.bonds[bond].nodes)) sets.edges.add(scene.bonds[bond].nodes);
  }
  for (const Edge& cylinder : broken.cylinders) sets.edges.add(cylinder);
  for (const auto& facet : broken.facets) {
    if (!holding.facets.contains(facet)) sets.facets.add(facet);
  }
  sets.edges.sort();
  sets.facets.sort();
  return sets;
}

}  // namespace

bool take_out_broken(Scene& scene, const BrokenParts& broken, const BeamBonds& bonds,
                     const SheetFacets& sheets) {
  const Sets holding{edges_that_hold(scene, bonds), sheets_that_hold(sheets)};
  const Sets sets = sets_of(scene, broken, holding);
  if (sets.edges.empty() && sets.facets.empty()) return false;
  const bool cylinders_are_gone =
      erase_elements(scene.elements.cylinders, scene.cylinder_materials,
                     [&](const Cylinder& cylinder, contact::MaterialId) {
                       return sets.edges.contains(cylinder.nodes);
                     });
  const std::vector<TornFacet> torn = take_out_facets(scene, sets, holding.facets);
  if (!torn.empty()) add_rims(scene, torn, holding.edges);
  return cylinders_are_gone || !torn.empty();
}

}  // namespace plekton::dynamics

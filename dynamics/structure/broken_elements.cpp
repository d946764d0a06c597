// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/broken_elements.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace plekton::dynamics {
namespace {

using geometry::Cylinder;
using geometry::Facet;

template <std::size_t N>
using Nodes = std::array<NodeId, N>;

template <std::size_t N>
Nodes<N> sorted(Nodes<N> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Sets of nodes, in any order of each.
template <std::size_t N>
class NodeSets {
 public:
  void add(const Nodes<N>& nodes) { sets_.push_back(sorted(nodes)); }
  /// After the last add.
  void sort() { std::sort(sets_.begin(), sets_.end()); }
  bool contains(const Nodes<N>& nodes) const {
    return std::binary_search(sets_.begin(), sets_.end(), sorted(nodes));
  }
  bool empty() const noexcept { return sets_.empty(); }

 private:
  std::vector<Nodes<N>> sets_;
};

std::array<Nodes<2>, 3> sides_of(const Facet& facet) {
  const auto& [a, b, c] = facet.nodes;
  return {{{a, b}, {b, c}, {c, a}}};
}

NodeSets<2> edges_that_hold(const Scene& scene, const BeamBonds& bonds) {
  NodeSets<2> holding;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    if (!bonds.is_broken(i)) holding.add(scene.bonds[i].nodes);
  }
  holding.sort();
  return holding;
}

/// Elements and their materials, without those that are gone.
template <class Element, class IsGone>
bool erase(std::vector<Element>& elements, std::vector<contact::MaterialId>& materials,
           IsGone is_gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (is_gone(elements[i], materials[i])) continue;
    elements[kept] = elements[i];
    materials[kept++] = materials[i];
  }
  const bool some_are_gone = kept < elements.size();
  elements.resize(kept);
  materials.resize(kept);
  return some_are_gone;
}

struct TornFacet {
  Facet facet;
  contact::MaterialId material;
};

std::vector<TornFacet> take_out_facets(Scene& scene, const NodeSets<2>& broken_edges) {
  NodeSets<3> sheets;
  for (const SheetFacet& facet : scene.sheet_facets) sheets.add(facet.nodes);
  sheets.sort();
  std::vector<TornFacet> torn;
  const auto is_broken = [&](const Nodes<2>& side) { return broken_edges.contains(side); };
  erase(scene.elements.facets, scene.facet_materials,
        [&](const Facet& facet, contact::MaterialId material) {
          const auto sides = sides_of(facet);
          if (sheets.contains(facet.nodes) || std::none_of(sides.begin(), sides.end(), is_broken))
            return false;
          torn.push_back({facet, material});
          return true;
        });
  return torn;
}

/// Cylinders along the sides of torn facets that a bond holds.
void add_rims(Scene& scene, std::span<const TornFacet> torn, const NodeSets<2>& holding) {
  NodeSets<2> there;
  for (const Facet& facet : scene.elements.facets) {
    for (const Nodes<2>& side : sides_of(facet)) there.add(side);
  }
  for (const Cylinder& cylinder : scene.elements.cylinders) there.add(cylinder.nodes);
  there.sort();
  std::vector<std::pair<Nodes<2>, std::size_t>> rims;  // with their facet
  for (std::size_t i = 0; i < torn.size(); ++i) {
    for (const Nodes<2>& side : sides_of(torn[i].facet)) {
      if (holding.contains(side) && !there.contains(side)) rims.emplace_back(sorted(side), i);
    }
  }
  std::sort(rims.begin(), rims.end());
  const auto is_same = [](const auto& p, const auto& q) { return p.first == q.first; };
  rims.erase(std::unique(rims.begin(), rims.end(), is_same), rims.end());
  for (const auto& [nodes, i] : rims)
    scene.add_cylinder(nodes[0], nodes[1], torn[i].facet.radius, torn[i].material);
}

}  // namespace

bool take_out_broken(Scene& scene, std::span<const std::size_t> broken, const BeamBonds& bonds) {
  const NodeSets<2> holding = edges_that_hold(scene, bonds);
  NodeSets<2> broken_edges;
  for (const std::size_t bond : broken) {
    if (!holding.contains(scene.bonds[bond].nodes)) broken_edges.add(scene.bonds[bond].nodes);
  }
  broken_edges.sort();
  if (broken_edges.empty()) return false;
  const bool cylinders_are_gone = erase(scene.elements.cylinders, scene.cylinder_materials,
                                        [&](const Cylinder& cylinder, contact::MaterialId) {
                                          return broken_edges.contains(cylinder.nodes);
                                        });
  const std::vector<TornFacet> torn = take_out_facets(scene, broken_edges);
  if (!torn.empty()) add_rims(scene, torn, holding);
  return cylinders_are_gone || !torn.empty();
}

}  // namespace plekton::dynamics

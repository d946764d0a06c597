// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_elements.hpp"

#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace plekton::dynamics {

namespace {

/// @param elements  as they are made, without what is absent; becomes what is left of them
/// @returns whether any are others than they were made
template <class Element>
bool take_table(const Scene& before, const std::vector<Element>& there,
                const std::vector<contact::MaterialId>& there_materials, const Scene& now,
                std::vector<Element>& elements, std::vector<contact::MaterialId>& materials) {
  geometry::NodeSets<Element{}.nodes.size()> were, made;
  for (const Element& element : there) were.add(element.nodes);
  for (const Element& element : elements) made.add(element.nodes);
  were.sort();
  made.sort();
  std::vector<Element> kept;
  std::vector<contact::MaterialId> kept_materials;
  const auto keep = [&](const Element& element, contact::MaterialId material) {
    kept.push_back(element);
    kept_materials.push_back(material);
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!before.is_there(elements[i].nodes[0]) || were.contains(elements[i].nodes))
      keep(elements[i], materials[i]);
  }
  const std::size_t of_made = kept.size();
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (now.is_there(there[i].nodes[0]) && !made.contains(there[i].nodes))
      keep(there[i], there_materials[i]);
  }
  const bool others = kept.size() != elements.size() || of_made != kept.size();
  elements = std::move(kept);
  materials = std::move(kept_materials);
  return others;
}

}  // namespace

bool are_same_there(const Scene& a, const Scene& b) {
  for (std::size_t i = 0; i < std::min(a.state.size(), b.state.size()); ++i) {
    const auto node = geometry::id_at<NodeId>(i);
    if (a.is_there(node) != b.is_there(node)) return false;
  }
  return true;
}

bool take_elements(const Scene& before, Scene& now) {
  const bool are_other_facets = take_table(before, before.elements.facets, before.facet_materials,
                                           now, now.elements.facets, now.facet_materials);
  const bool are_other_cylinders =
      take_table(before, before.elements.cylinders, before.cylinder_materials, now,
                 now.elements.cylinders, now.cylinder_materials);
  return are_other_facets || are_other_cylinders;
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <cstddef>
#include <vector>

namespace plekton::dynamics {

/// Leaves out the elements for which is_gone(element, material), with their materials.
/// @returns whether there were any
template <class Element, class IsGone>
bool erase_elements(std::vector<Element>& elements, std::vector<contact::MaterialId>& materials,
                    const IsGone& is_gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (is_gone(elements[i], materials[i])) continue;
    elements[kept] = elements[i];
    materials[kept++] = materials[i];
  }
  const bool are_fewer = kept < elements.size();
  elements.resize(kept);
  materials.resize(kept);
  return are_fewer;
}

/// Leaves out the facets and cylinders that are not there (Scene::is_absent).
/// @returns whether there were any
inline bool erase_absent(Scene& scene) {
  const auto is_absent = [&scene](const auto& element, contact::MaterialId) {
    return !scene.is_there(element.nodes[0]);
  };
  const bool had_facets = erase_elements(scene.elements.facets, scene.facet_materials, is_absent);
  const bool had_cylinders =
      erase_elements(scene.elements.cylinders, scene.cylinder_materials, is_absent);
  return had_facets || had_cylinders;
}

}  // namespace plekton::dynamics

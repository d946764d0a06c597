// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/contact_scene.hpp"

#include "dynamics/model/scene_figures.hpp"

#include <vector>

namespace plekton::dynamics {

namespace {

/// Of what the structures are made.
std::vector<contact::MaterialId> materials_of_structures(const Scene& scene,
                                                         const geometry::Surface& surface) {
  std::vector<contact::MaterialId> materials(surface.structure_count());
  for (std::size_t i = 0; i < scene.elements.facets.size(); ++i) {
    materials[index_of(surface.structure_of(scene.elements.facets[i].nodes[0]))] =
        scene.facet_materials[i];
  }
  for (std::size_t i = 0; i < scene.elements.cylinders.size(); ++i) {
    materials[index_of(surface.structure_of(scene.elements.cylinders[i].nodes[0]))] =
        scene.cylinder_materials[i];
  }
  return materials;
}

}  // namespace

contact::ContactScene contact_scene(const Scene& scene, const geometry::Surface& surface,
                                    double asked_skin, bool self_contact) {
  return {.spheres = scene.elements.spheres,
          .surface = surface,
          .materials = scene.materials,
          .of_spheres = scene.sphere_materials,
          .of_structures = materials_of_structures(scene, surface),
          .masses = contact_masses(scene),
          .skin = chosen_skin(scene, asked_skin),
          .meets_planes = free_nodes(scene),
          .rest = self_contact ? geometry::Positions(scene.state.position) : geometry::Positions(),
          .groups = rigid_groups(scene)};
}

bool may_touch(const Scene& scene, const geometry::Surface& surface, bool self_contact) noexcept {
  return !scene.elements.spheres.empty() || !scene.planes.empty() ||
         surface.structure_count() > 1 || self_contact;
}

}  // namespace plekton::dynamics

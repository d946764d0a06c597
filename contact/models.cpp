// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"

#include "contact/scene_contacts.hpp"

#include <utility>

namespace plekton::contact {

ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties) {
  return model_of<LinearFrictional>(properties);
}

ContactModel any_law(const PairProperties<AnyLaw>& properties, const AnyLaw::Properties& others) {
  return [properties, others](ContactScene scene) -> std::unique_ptr<Contacts> {
    return std::make_unique<SceneContacts>(
        scene.spheres, scene.surface,
        ContactMaterials{MaterialPairs(std::move(scene.materials), properties, others),
                         std::move(scene.of_spheres), std::move(scene.of_structures),
                         std::move(scene.masses)},
        scene.skin, scene.meets_planes, scene.rest, scene.groups);
  };
}

}  // namespace plekton::contact

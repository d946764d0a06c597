// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/among_ranks.hpp"

#include "contact/scene_contacts.hpp"

#include <stdexcept>
#include <utility>

namespace plekton::contact {

ContactModel among_ranks(ContactModel model, geometry::Ranks& ranks) {
  return [model = std::move(model), &ranks](ContactScene scene) {
    std::unique_ptr<Contacts> contacts = model(std::move(scene));
    auto* const of_scene = dynamic_cast<SceneContacts*>(contacts.get());
    if (of_scene == nullptr)
      throw std::invalid_argument(
          "among_ranks: got contacts of another kind; expected a model of contact/models.hpp");
    of_scene->share_among(ranks);
    return contacts;
  };
}

std::vector<RankShare> shares_of_ranks(const Contacts& contacts) {
  const auto* const of_scene = dynamic_cast<const SceneContacts*>(&contacts);
  return of_scene == nullptr ? std::vector<RankShare>() : of_scene->shares_of_ranks();
}

}  // namespace plekton::contact

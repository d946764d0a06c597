// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "contact/structure_contacts.hpp"

/// Which structures may touch, and with which parameters.
namespace plekton::contact {

template <ContactLaw Law>
std::vector<structure::Meeting<Law>> StructureContacts<Law>::find_meetings(
    const ContactMaterials<Law>& materials) const {
  std::vector<Meeting> meetings;
  const std::vector<double> masses = structure::mean_node_masses(*surface_, materials);
  const auto part = [&](std::size_t i) {
    const auto id = geometry::id_at<geometry::StructureId>(i);
    return BodyPart{materials.of_structures[i], surface_->radius(id), masses[i],
                    shape_of(*surface_, id)};
  };
  for (std::size_t i = 0; i < surface_->structure_count(); ++i) {
    for (std::size_t k = i; k < surface_->structure_count(); ++k) {
      const typename Law::Parameters parameters = materials.pairs.combine(part(i), part(k));
      meetings.push_back({without_attraction<Law>(parameters), part(i).radius, part(k).radius,
                          attraction_of<Law>(parameters)});
    }
  }
  return meetings;
}

template <ContactLaw Law>
void StructureContacts<Law>::make_meetings(const ContactMaterials<Law>& materials) {
  meetings_ = find_meetings(materials);
  take_parameters(materials);
  for (const Meeting& meeting : meetings_) {
    springs_.push_back(structure::NormalSpring::of<Law>(
        meeting.parameters, meeting.radius_first + meeting.radius_second, &meeting.attraction));
  }
}

template <ContactLaw Law>
void StructureContacts<Law>::take_parameters(const ContactMaterials<Law>& materials) {
  if (meetings_.empty()) return;
  std::vector<Meeting> meetings = find_meetings(materials);
  for (std::size_t i = 0; i < meetings.size(); ++i)
    meetings_[i] = meetings[i];  // springs point there
  glues_ = std::any_of(meetings_.begin(), meetings_.end(),
                       [](const Meeting& of) { return glues<Law>(of.parameters); });
}

}  // namespace plekton::contact

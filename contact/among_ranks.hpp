// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/rank_share.hpp"
#include "contact/contact_model.hpp"
#include "geometry/base/ranks.hpp"

#include <vector>

namespace plekton::contact {

/// The same contacts, computed by several processes: each has the whole scene, makes the same calls
/// and gets the same answers, to the bit; contacts between spheres are shared out by blocks.
/// @param model  as contact/models.hpp makes it
/// @param ranks  must outlive the contacts
/// @returns a model whose contacts are refused with std::invalid_argument where the given one makes
///          contacts of another kind
ContactModel among_ranks(ContactModel model, geometry::Ranks& ranks);

/// What each rank does alone, since the last list; nothing where there is nothing to share: one
/// process, or too few spheres near each other.
std::vector<RankShare> shares_of_ranks(const Contacts& contacts);

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_model.hpp"
#include "contact/laws/any_law.hpp"
#include "contact/material_pairs.hpp"

namespace plekton::contact {

/// LinearFrictional between all pairs.
/// @param properties  of pairs of materials that say more than their materials do
ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties = {});

/// Any law of this folder, by the properties of a pair; LinearFrictional where there are none.
ContactModel any_law(const PairProperties<AnyLaw>& properties = {});

}  // namespace plekton::contact

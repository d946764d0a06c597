// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_model.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/law_table.hpp"

namespace plekton::contact {

// What makes contacts of these models throws std::invalid_argument listing every problem of the
// properties: pairs of materials that are none, numbers out of their ranges, a law that is none, or
// one that answers with stiffnesses that are not finite.

/// LinearFrictional between all pairs.
/// @param properties  of pairs of materials that say more than their materials do
ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties);

/// For each pair of materials any law, also of one's own.
/// @param properties  by pair of materials; AnyLaw::of<Law>() and with_parts<Law>() make them
/// @param others      of the pairs that have none of their own
ContactModel any_law(const PairProperties<AnyLaw>& properties,
                     const AnyLaw::Properties& others = {});

/// One law between all pairs, also one's own.
/// @param properties  of pairs of materials, for laws that have any
template <ContactLaw Law>
ContactModel model_of(const PairProperties<Law>& properties = {}) {
  PairProperties<AnyLaw> all;
  for (const auto& [pair, of_pair] : properties) all[pair] = AnyLaw::of<Law>(of_pair);
  return any_law(all, AnyLaw::of<Law>());
}

}  // namespace plekton::contact

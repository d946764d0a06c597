// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_law.hpp"
#include "contact/contact_row.hpp"

namespace plekton::contact {

/// By what part a tangential force at its limit may look smaller than it: far above the rounding of
/// splitting a force along the normal, far below what a step changes.
constexpr double kSlipTolerance = 1e-9;

/// What the law knows of a contact whose forces are filled in already. A contact without friction
/// slips.
/// @param elastic_force  N, magnitude of the elastic normal force
template <ContactLaw Law>
void set_state(ContactRow& row, const typename Law::Parameters& parameters,
               const typename Law::History& history, double elastic_force) {
  row.elastic_force = elastic_force;
  row.is_bonded = holds<Law>(history);
  if constexpr (TellsTangentialLimit<Law>) {
    const double limit = Law::tangential_limit(parameters, elastic_force, history);
    row.is_slipping = row.tangential_force.norm() >= (1.0 - kSlipTolerance) * limit;
  }
}

}  // namespace plekton::contact

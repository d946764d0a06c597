// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"
#include "contact/tracking/contact_record.hpp"

namespace plekton::contact {

/// By what part a tangential force at its limit may look smaller than it: far above the rounding of
/// splitting a force along the normal, far below what a step changes.
constexpr double kSlipTolerance = 1e-9;

/// Whether a tangential force (N) is as large as it may be; false under laws that do not tell.
/// @param elastic_force  N, magnitude of the elastic normal force
template <ContactLaw Law>
bool is_at_limit(const typename Law::Parameters& parameters, const typename Law::History& history,
                 double elastic_force, const Vec3& tangential_force) {
  const double limit = Law::tangential_limit(parameters, elastic_force, history);
  return tangential_force.norm() >= (1.0 - kSlipTolerance) * limit;
}

/// What the law knows of a contact whose forces are filled in already. A contact without friction
/// slips.
/// @param elastic_force  N, magnitude of the elastic normal force
template <ContactLaw Law>
void set_state(ContactRecord& row, const typename Law::Parameters& parameters,
               const typename Law::History& history, double elastic_force) {
  row.elastic_force = elastic_force;
  row.is_bonded = holds<Law>(history);
  row.is_slipping = is_at_limit<Law>(parameters, history, elastic_force, row.tangential_force);
}

}  // namespace plekton::contact

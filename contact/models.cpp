// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"

#include "contact/contacts_under.hpp"

namespace plekton::contact {

ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties) {
  return model_under<LinearFrictional>(properties);
}

ContactModel any_law(const PairProperties<AnyLaw>& properties, const AnyLaw::Properties& others) {
  return model_under<AnyLaw>(properties, others);
}

}  // namespace plekton::contact

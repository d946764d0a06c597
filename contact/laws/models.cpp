// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/laws/models.hpp"

#include "contact/contacts_under.hpp"

namespace plekton::contact {

ContactModel linear_frictional(const PairProperties<LinearFrictional>& properties) {
  return model_of<LinearFrictional>(properties);
}

ContactModel any_law(const PairProperties<AnyLaw>& properties) {
  return model_of<AnyLaw>(properties);
}

}  // namespace plekton::contact

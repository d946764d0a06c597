// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_table.hpp"

#include "contact/law/linear_frictional.hpp"

namespace plekton::contact {

static_assert(ContactLaw<AnyLaw> && HasMoments<AnyLaw> && HasInteractionRange<AnyLaw>);

AnyLaw::Properties::Properties() noexcept {
  keep(LawTable<LinearFrictional>::functions, LinearFrictional::Properties{});
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/laws/any_law.hpp"

#include "contact/laws/linear_frictional.hpp"

namespace plekton::contact {

static_assert(ContactLaw<AnyLaw> && HasMoments<AnyLaw> && HasReach<AnyLaw> &&
              HasAttraction<AnyLaw> && HasBonds<AnyLaw> && HasStart<AnyLaw> &&
              TellsTangentialLimit<AnyLaw>);

AnyLaw::Properties::Properties() noexcept {
  keep(Table<LinearFrictional>::functions, LinearFrictional::Properties{});
}

}  // namespace plekton::contact

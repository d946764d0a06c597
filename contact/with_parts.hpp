// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/dashpot.hpp"
#include "contact/law/rolling_twisting.hpp"
#include "contact/law/sum.hpp"
#include "contact/law_table.hpp"

namespace plekton::contact {

/// A law with resistance to rolling and a dashpot, as far as there are any: what a pair does not
/// have costs it nothing.
template <ContactLaw Law>
AnyLaw::Properties with_parts(const PropertiesOf<Law>& law,
                              const RollingTwisting::Properties& rolling,
                              const Dashpot::Properties& dashpot) {
  using Rolling = Sum<Law, RollingTwisting>;
  // Numbers out of their ranges are there too: they are refused when contacts are made.
  const bool rolls = rolling.rolling_stiffness != 0.0 || rolling.twisting_stiffness != 0.0;
  const bool is_damped = dashpot.damping_ratio != 0.0;
  if (rolls && is_damped) return AnyLaw::of<Sum<Rolling, Dashpot>>({{law, rolling}, dashpot});
  if (rolls) return AnyLaw::of<Rolling>({law, rolling});
  if (is_damped) return AnyLaw::of<Sum<Law, Dashpot>>({law, dashpot});
  return AnyLaw::of<Law>(law);
}

}  // namespace plekton::contact

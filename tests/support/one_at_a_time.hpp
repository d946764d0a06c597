// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/contact_law.hpp"

namespace plekton::test {

/// A law as it would be written for one contact at a time: the plain twin of one for contacts side
/// by side, whose numbers for any Real it hides.
template <contact::ContactLaw Law>
struct OneAtATime : Law {
  using ParametersOf = void;
  using HistoryOf = void;
};

}  // namespace plekton::test

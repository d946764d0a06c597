// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shipped_laws.hpp"

namespace plekton::contact {

template struct LawLoops<LinearFrictional>;
template struct LawLoops<WithRolling<LinearFrictional>>;
template struct LawLoops<WithDashpot<LinearFrictional>>;
template struct LawLoops<WithBoth<LinearFrictional>>;

}  // namespace plekton::contact

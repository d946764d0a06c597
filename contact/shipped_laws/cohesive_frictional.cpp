// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shipped_laws.hpp"

namespace plekton::contact {

template struct LawLoops<CohesiveFrictional>;
template struct LawLoops<WithRolling<CohesiveFrictional>>;
template struct LawLoops<WithDashpot<CohesiveFrictional>>;
template struct LawLoops<WithBoth<CohesiveFrictional>>;

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shipped_laws.hpp"

namespace plekton::contact {

template struct LawLoops<HertzMindlin>;
template struct LawLoops<WithRolling<HertzMindlin>>;
template struct LawLoops<WithDashpot<HertzMindlin>>;
template struct LawLoops<WithBoth<HertzMindlin>>;

}  // namespace plekton::contact

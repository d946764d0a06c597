// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/shipped_laws.hpp"

namespace plekton::contact {

template struct LawLoops<DmtAdhesion>;
template struct LawLoops<WithRolling<DmtAdhesion>>;
template struct LawLoops<WithDashpot<DmtAdhesion>>;
template struct LawLoops<WithBoth<DmtAdhesion>>;

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/cohesive_frictional.hpp"
#include "contact/law/dashpot.hpp"
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/rolling_twisting.hpp"
#include "contact/law/sum.hpp"
#include "contact/law_loops.hpp"

/// The laws that come with the library, whose loops are compiled once, in shipped_laws/:
/// with_parts.hpp asks for no others. A new one joins here and has a file there.
namespace plekton::contact {

template <ContactLaw Law>
using WithRolling = Sum<Law, RollingTwisting>;
template <ContactLaw Law>
using WithDashpot = Sum<Law, Dashpot>;
template <ContactLaw Law>
using WithBoth = Sum<Sum<Law, RollingTwisting>, Dashpot>;

extern template struct LawLoops<LinearFrictional>;
extern template struct LawLoops<WithRolling<LinearFrictional>>;
extern template struct LawLoops<WithDashpot<LinearFrictional>>;
extern template struct LawLoops<WithBoth<LinearFrictional>>;
extern template struct LawLoops<HertzMindlin>;
extern template struct LawLoops<WithRolling<HertzMindlin>>;
extern template struct LawLoops<WithDashpot<HertzMindlin>>;
extern template struct LawLoops<WithBoth<HertzMindlin>>;
extern template struct LawLoops<DmtAdhesion>;
extern template struct LawLoops<WithRolling<DmtAdhesion>>;
extern template struct LawLoops<WithDashpot<DmtAdhesion>>;
extern template struct LawLoops<WithBoth<DmtAdhesion>>;
extern template struct LawLoops<CohesiveFrictional>;
extern template struct LawLoops<WithRolling<CohesiveFrictional>>;
extern template struct LawLoops<WithDashpot<CohesiveFrictional>>;
extern template struct LawLoops<WithBoth<CohesiveFrictional>>;

}  // namespace plekton::contact

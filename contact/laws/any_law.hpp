// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/laws/cohesive_frictional.hpp"
#include "contact/laws/dashpot.hpp"
#include "contact/laws/dmt_adhesion.hpp"
#include "contact/laws/hertz_mindlin.hpp"
#include "contact/laws/linear_frictional.hpp"
#include "contact/laws/one_of.hpp"
#include "contact/laws/rolling_twisting.hpp"
#include "contact/laws/sum.hpp"

namespace plekton::contact {

/// Any of the laws of this folder that push: each pair of materials has its own.
using AnyBaseLaw = OneOf<LinearFrictional, HertzMindlin, DmtAdhesion, CohesiveFrictional>;

/// With resistance to rolling and a dashpot. Scenes in which all pairs are LinearFrictional are
/// faster with that.
using AnyLaw = Sum<Sum<AnyBaseLaw, RollingTwisting>, Dashpot>;

}  // namespace plekton::contact

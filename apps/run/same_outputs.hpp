// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "geometry/base/state_archive.hpp"

namespace plekton::apps {

/// Refuses a scenario whose reactions and measures have the names of others: histories that go on
/// would be of one thing up to the checkpoint, and of another one after it.
/// @param state  of a checkpoint of the run whose files go on
/// @throws InputError naming what it was and what it is
void require_same_outputs(const geometry::StateTree& state, const Scenario& now);

}  // namespace plekton::apps

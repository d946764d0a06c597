// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/read_sections.hpp"

namespace plekton::apps {

/// Reads a table [[rigid_bodies]] into a scenario: the body, and what it is made of, a surface among
/// the membranes or spheres among the grains. To be read after the former and before the latter:
/// grains are placed clear of it.
void read_rigid_body(Section section, const Known& known, Scenario& scenario);

/// Complains about rigid bodies that have the name of a membrane or of grains: histories and results
/// call bodies by their names.
void require_own_names(Section& root, const Scenario& scenario);

}  // namespace plekton::apps

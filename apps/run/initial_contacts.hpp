// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/overlap.hpp"
#include "apps/scenario/scenario.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// What touches at the start.
struct InitialContacts {
  std::vector<BodyOverlap> overlaps;  ///< the deepest first, against the radius
  std::vector<std::size_t> bonds;     ///< how many hold, by table [[contacts]]
};

/// Those of a simulation that has made no step, also where forces cancel.
std::vector<contact::ContactRecord> first_contacts(const dynamics::Simulation& simulation);

/// Looks at the contacts that a simulation begins with. Overlaps that may be rounding of coordinates
/// do not count.
InitialContacts initial_contacts(const Scenario& scenario, const BuiltScene& built,
                                 const dynamics::Simulation& simulation,
                                 std::span<const contact::ContactRecord> rows);

/// Bonds that were asked for and of which there are none, and overlaps that are deep.
std::vector<std::string> warnings_about(const InitialContacts& contacts, const Scenario& scenario);

/// Who is in whom, where overlaps are impossible.
Problems impossible_starts(const InitialContacts& contacts, const Scenario& scenario);

/// @throws InputError listing these, if there are any
void require_possible_start(const InitialContacts& contacts, const Scenario& scenario);

}  // namespace plekton::apps

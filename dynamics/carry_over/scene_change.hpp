// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"

#include <vector>

namespace plekton::dynamics {

/// What of one scene is what of another that goes on from it (Simulation::go_on_from). Nodes of
/// structures have the same ids in both. Each list of places is as long as there were bodies of that
/// kind; one that is made by default goes with an empty scene alone.
struct SceneChange {
  contact::BodyPlaces places;      ///< of what was there before among what is there now
  std::vector<bool> moved_planes;  ///< by plane of now: it is where its scene has it, though it was
                                   ///< there before; empty: none
};

}  // namespace plekton::dynamics

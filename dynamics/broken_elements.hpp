// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace plekton::dynamics {

class SheetFacets;

/// What broke in a step.
struct BrokenParts {
  std::vector<std::size_t> bonds;                ///< by their places in the scene
  std::vector<std::array<NodeId, 2>> cylinders;  ///< by their nodes, where no bond holds
  std::vector<std::array<NodeId, 3>> facets;     ///< by their nodes

  bool empty() const noexcept { return bonds.empty() && cylinders.empty() && facets.empty(); }
  void clear() noexcept {
    bonds.clear();
    cylinders.clear();
    facets.clear();
  }
};

/// Takes the elements out of a scene that broke or are gone with bonds that broke. What is left
/// keeps its order; nodes keep their masses.
///
/// An edge is broken when a bond between its nodes broke and none that holds is left between them,
/// or a cylinder along it broke.
/// - The cylinders along a broken edge are gone.
/// - The facets with a broken edge are torn: they are gone too, but for those of a sheet (a sheet
///   facet on the same nodes that holds), which carries them without the bond. Facets that broke
///   are torn.
/// - Another side of a torn facet that is no side of a facet that is left stays as a cylinder of
///   the facet's radius and material where a bond holds along it; without one it is gone.
///   Cylinders that come into being in this way follow those there are.
///
/// What contacts store changes at once, and what it falls by is lost in tracking (Energy). It may
/// grow, and the tracking of the ledger falls then: that energy is made. A ball's contact is the
/// part of a surface in its range that hangs together, counted at every level, with phi(d) the
/// energy of one contact at a distance. When a cylinder goes that the ball lies on,
/// - its minimum d0 is gone, with phi(d0), and where the parts on either side stay in range each
///   goes on by itself: the saddles d1, d2 at its nodes, which counted -1, count no more, or its
///   nodes are minima themselves, if they were none nor saddles. Both parts are then whole contacts
///   up to the level where they hang together otherwise, if at all. A ball on the middle of a
///   straight wire goes from phi(d0) to 2 phi(d1), up to twice as much where the nodes are as near;
/// - if it closed a cycle, what the hole gave back goes with it: a jump by -phi at the distance at
///   which the hole began, about that of the furthest saddle of the cycle. It has
///   the other sign and is small where the cycle closes just inside the range.
/// So one cylinder with a minimum makes at most phi(d1) + phi(d2) - phi(d0), but for what holes
/// beside it that become one share out anew.
/// @param bonds, sheets  of the scene; tell which hold
/// @returns whether anything is gone
bool take_out_broken(Scene& scene, const BrokenParts& broken, const BeamBonds& bonds,
                     const SheetFacets& sheets);

}  // namespace plekton::dynamics

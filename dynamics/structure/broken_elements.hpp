// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/scene.hpp"
#include "dynamics/structure/beam_bond.hpp"

#include <span>

namespace plekton::dynamics {

/// Takes the elements out of a scene that are gone with bonds that broke. What is left keeps its
/// order; nodes keep their masses.
///
/// An edge is broken when a bond between its nodes broke and none that holds is left between them.
/// - The cylinders along a broken edge are gone.
/// - The facets with a broken edge are torn: they are gone too, but for those of a sheet (a sheet
///   facet on the same nodes), which carries them without the bond.
/// - Another side of a torn facet that is no side of a facet that is left stays as a cylinder of
/// the
///   facet's radius and material where a bond holds along it; without one it is gone. Cylinders
///   that come into being in this way follow those there are.
/// @param broken  bonds that have just broken, by their places in the scene
/// @param bonds   of the scene; tells which hold
/// @returns whether anything is gone
bool take_out_broken(Scene& scene, std::span<const std::size_t> broken, const BeamBonds& bonds);

}  // namespace plekton::dynamics

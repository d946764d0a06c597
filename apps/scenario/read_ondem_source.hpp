// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/read_sections.hpp"

/// Bodies from a file of the ON-DEM network (VTKHDF), whichever program wrote it.
namespace plekton::apps {

/// Places, radii, velocities and orientations of grains, from the keys ondem, ondem_block and
/// ondem_material, of which the first is there. Members of clumps are left out.
void read_ondem_grains(Section& section, const Known& known, GrainSettings& grains);

/// The shape of a membrane and how its nodes move, from the keys ondem and ondem_membrane, of which
/// the first is there.
void read_ondem_membrane(Section& section, const Known& known, MembraneSettings& membrane);

}  // namespace plekton::apps

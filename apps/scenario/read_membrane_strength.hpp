// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/read_sections.hpp"

namespace plekton::apps {

/// Reads when the beams or bars of a membrane yield and break, and the curves of wires, after its
/// shape and mode.
void read_membrane_strength(Section& section, MembraneSettings& membrane);

}  // namespace plekton::apps

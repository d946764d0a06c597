// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/read_sections.hpp"

/// What a membrane is made from: the key `mesh` and those of its repair, or the table `shape`.
namespace plekton::apps {

/// Reads `mesh` or `shape` into the settings, with the keys that go with one of them only. After a
/// problem the settings have neither.
void read_membrane_source(Section& section, const Known& known, MembraneSettings& membrane);

/// The keys of a table `shape`, finished; nothing after a problem with its kind.
std::optional<ShapeSettings> read_shape(Section section);

}  // namespace plekton::apps

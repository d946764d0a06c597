// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scenario/section.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

/// What a load acts on, by name. Each function complains about names that are not there.
namespace plekton::apps {

/// The membrane that the key `membrane` names; nothing after a problem.
std::optional<std::size_t> read_membrane_name(Section& section, const Scenario& scenario);

/// The rigid body that the key `rigid_body` names; nothing after a problem.
std::optional<std::size_t> read_rigid_body_name(Section& section, const Scenario& scenario);

/// The plane that the key `plane` names; nothing after a problem.
std::optional<std::size_t> read_plane_name(Section& section, const Scenario& scenario);

/// The planes that a list of names says, those that are there.
std::vector<std::size_t> read_plane_names(Section& section, std::string_view key,
                                          const Scenario& scenario);

/// The two planes, or the two rigid bodies, that the key `between` names.
StrainEnd read_two_bodies(Section& section, const Scenario& scenario);

/// The planes that the key `between` names, in pairs that follow each other.
std::vector<std::array<std::size_t, 2>> read_plane_pairs(Section& section,
                                                         const Scenario& scenario);

/// All nodes of the body that the key `membrane`, `grains` or `rigid_body` names.
NodeSetSettings read_whole_body(Section& section, const Scenario& scenario);

/// The same but for rigid bodies.
NodeSetSettings read_flexible_body(Section& section, const Scenario& scenario);

/// As the key `nodes` says it. Not of a box.
std::string_view word_of(SetWhich which);

/// From the keys `membrane` or `grains`, and `nodes`.
NodeSetSettings read_node_set(Section& section, const Scenario& scenario);

/// The same of a membrane alone.
NodeSetSettings read_membrane_nodes(Section& section, const Scenario& scenario);

/// The same of a membrane or a rigid body alone: grains may be gone, or elsewhere, in a later stage.
NodeSetSettings read_tied_nodes(Section& section, const Scenario& scenario);
NodeSetSettings read_tied_body(Section& section, const Scenario& scenario);

}  // namespace plekton::apps

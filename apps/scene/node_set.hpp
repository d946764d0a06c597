// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scene/build_scene.hpp"

#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// The nodes of a set, ascending. None if the set is empty.
///
/// A side is where a coordinate of the body is least or greatest, and a box holds what is in it, to
/// 1e-9 of the body's size.
std::vector<geometry::NodeId> nodes_of(const NodeSetSettings& set, const BuiltScene& built);

/// The box (m) that holds the nodes of a side, which is not `all`, `rim` or `box`.
/// @param nodes  of the body, at least one
geometry::Box box_of_side(SetWhich side, const std::vector<geometry::NodeId>& nodes,
                          geometry::Positions x);
/// A box (m) that may have been said by the coordinates of nodes: wider by 1e-9 of the size of their
/// body on each side, as numbers of meshes are rounded, on one side down and up on the other.
/// @param places  m, of the nodes of the body, at least one
geometry::Box with_rounding(const geometry::Box& box, std::span<const Vec3> places);
/// Whether a place is in a box (m), its sides included.
bool is_within(const geometry::Box& box, const Vec3& place);

/// What a table of [[rigid_bodies]] came to.
const BuiltRigidBody& rigid_body_of(std::size_t table, const BuiltScene& built);

/// The name of the body whose nodes are meant.
const std::string& name_of(const NodeSetSettings& set, const BuiltScene& built);

/// What is wrong with a set that has no nodes, and what to do.
std::string nothing_of(const NodeSetSettings& set, const BuiltScene& built);

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/node_set.hpp"

#include "geometry/primitives/box.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::NodeId;

/// Of the size of a body: rounding of a mesh that was turned, or spaced out.
constexpr double kTolerance = 1e-9;

/// m.
std::vector<Vec3> places_of(const std::vector<NodeId>& nodes, geometry::Positions x) {
  std::vector<Vec3> places;
  for (const NodeId node : nodes) places.push_back(x[index_of(node)]);
  return places;
}

std::vector<NodeId> nodes_of_body(const NodeSetSettings& set, const BuiltScene& built) {
  std::vector<NodeId> nodes;
  if (!set.of_grains) {
    const BuiltMembrane& membrane = built.membranes[set.body];
    for (std::size_t i = 0; i < membrane.nodes; ++i)
      nodes.push_back(geometry::id_at<NodeId>(membrane.first_node + i));
    return nodes;
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i < set.body; ++i) first += built.grains[i].count;
  for (std::size_t i = 0; i < built.grains[set.body].count; ++i)
    nodes.push_back(built.scene.elements.spheres[first + i].nodes[0]);
  return nodes;
}

}  // namespace

geometry::Box box_of_side(SetWhich side, const std::vector<NodeId>& nodes, geometry::Positions x) {
  geometry::Box box = geometry::bounding_box(places_of(nodes, x), 0.0);
  const int number = static_cast<int>(side) - static_cast<int>(SetWhich::x_min);
  const double tolerance = kTolerance * (box.upper - box.lower).norm();
  if (number % 2 == 0)
    box.upper[number / 2] = box.lower[number / 2] + tolerance;
  else
    box.lower[number / 2] = box.upper[number / 2] - tolerance;
  return box;
}

geometry::Box with_rounding(const geometry::Box& box, std::span<const Vec3> places) {
  const geometry::Box body = geometry::bounding_box(places, 0.0);
  const Vec3 tolerance = Vec3::Constant(kTolerance * (body.upper - body.lower).norm());
  return {box.lower - tolerance, box.upper + tolerance};
}

bool is_within(const geometry::Box& box, const Vec3& place) {
  return (place.array() >= box.lower.array()).all() && (place.array() <= box.upper.array()).all();
}

std::vector<NodeId> nodes_of(const NodeSetSettings& set, const BuiltScene& built) {
  if (set.rigid_body) return {rigid_body_of(*set.rigid_body, built).node};
  const geometry::Positions x = built.scene.state.position;
  std::vector<NodeId> nodes = nodes_of_body(set, built);
  if (set.which == SetWhich::all || nodes.empty()) return nodes;
  if (set.which == SetWhich::rim) {
    const BuiltMembrane& membrane = built.membranes[set.body];
    std::erase_if(
        nodes, [&](NodeId node) { return !membrane.on_rim[index_of(node) - membrane.first_node]; });
    return nodes;
  }
  const geometry::Box box = set.which == SetWhich::box ? with_rounding(set.box, places_of(nodes, x))
                                                       : box_of_side(set.which, nodes, x);
  std::erase_if(nodes, [&](NodeId node) { return !is_within(box, x[index_of(node)]); });
  return nodes;
}

// They are built in another order than that of their tables: surfaces first.
const BuiltRigidBody& rigid_body_of(std::size_t table, const BuiltScene& built) {
  return *std::find_if(built.rigid_bodies.begin(), built.rigid_bodies.end(),
                       [&](const BuiltRigidBody& body) { return body.table == table; });
}

const std::string& name_of(const NodeSetSettings& set, const BuiltScene& built) {
  if (set.rigid_body) return rigid_body_of(*set.rigid_body, built).name;
  return set.of_grains ? built.grains[set.body].name : built.membranes[set.body].name;
}

std::string nothing_of(const NodeSetSettings& set, const BuiltScene& built) {
  const std::string& name = name_of(set, built);
  if (set.of_grains && built.grains[set.body].count == 0)
    return fmt::format(
        "\"{}\" has no node there: all of its grains have been taken out; take this "
        "out with them, or leave some of them",
        name);
  if (set.which == SetWhich::rim)
    return fmt::format(
        "\"{}\" is closed and has no rim; expected a side such as \"x_min\", or a "
        "box {{ min = [...], max = [...] }}",
        name);
  return fmt::format(
      "\"{}\" has no node there; the box counts in the scene, after scale, rotate "
      "and translate",
      name);
}

}  // namespace plekton::apps

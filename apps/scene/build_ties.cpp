// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_ties.hpp"

#include "apps/scene/node_set.hpp"
#include "geometry/closest/point_segment.hpp"
#include "geometry/closest/point_triangle.hpp"
#include "geometry/primitives/node_sets.hpp"
#include "geometry/query/box_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace plekton::apps {
namespace {

using dynamics::CablePlace;
using dynamics::FixedPoint;
using dynamics::MaterialPoint;
using geometry::index_of;
using geometry::NodeId;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Where a node is tied.
struct Found {
  std::variant<FixedPoint, MaterialPoint, CablePlace> to;
  std::vector<NodeId> nodes;    ///< of what it is tied to; none of space
  double distance = kInfinite;  ///< m
};

/// The nodes of a point, bar or facet that may be tied to.
using Target = std::vector<NodeId>;

/// N/m, of the bars, beams and sheets around each node, by NodeId; 0 where there are none.
std::vector<double> stiffness_around(const dynamics::Scene& scene) {
  std::vector<double> stiffness(scene.state.size(), 0.0);
  for (const dynamics::BeamBond& bond : scene.bonds) {
    for (const NodeId node : bond.nodes)
      stiffness[index_of(node)] += bond.section.young_modulus * bond.section.area / bond.length;
  }
  for (const dynamics::SheetFacet& facet : scene.sheet_facets) {
    for (const NodeId node : facet.nodes)
      stiffness[index_of(node)] += facet.section.tensile_stiffness / 3.0;
  }
  return stiffness;
}

/// Adds the ties of one table after the other and collects what is wrong with them.
class TieBuilder {
 public:
  TieBuilder(const Scenario& scenario, BuiltScene& built)
      : scenario_(scenario), built_(built), around_(stiffness_around(built.scene)) {}

  void add_all() {
    for (const TieSettings& settings : scenario_.ties) {
      current_ = &settings;
      add(settings);
    }
    problems_.throw_if_any();
  }

 private:
  void add(const TieSettings& settings) {
    if (!is_there(settings.from, "from")) return;
    if (settings.kind >= TieTo::nodes && !is_there(settings.to, "to")) return;
    const std::vector<NodeId> nodes = nodes_of_set(settings.from, "from");
    if (!list_targets(settings)) return;
    BuiltTies result{settings.name, built_.scene.ties.size(), 0, 0.0, kInfinite, 0.0,
                     settings.each};
    double nearest = kInfinite;
    for (const NodeId node : nodes) {
      const Found found = find(settings, node);
      nearest = std::min(nearest, found.distance);
      if (!(found.distance <= settings.within) || !std::isfinite(found.distance)) continue;
      const std::optional<dynamics::Tie> tie = tie_of(settings, node, found);
      if (!tie) return;
      result.longest_gap = std::max(result.longest_gap, found.distance);
      result.softest = std::min(result.softest, tie->stiffness);
      result.stiffest = std::max(result.stiffest, tie->stiffness);
      built_.scene.ties.push_back(*tie);
      ++result.count;
    }
    if (result.count == 0 && !nodes.empty()) warn_of_nothing(settings, nearest);
    built_.ties.push_back(std::move(result));
  }

  void warn_of_nothing(const TieSettings& settings, double nearest) {
    built_.warnings.push_back(
        std::isfinite(nearest)
            ? fmt::format("{}: ties nothing; the nearest place to tie to is {:.4g} m away, and "
                          "within is {:.4g} m",
                          settings.path, nearest, settings.within)
            : fmt::format("{}: ties nothing; its nodes are all there is to tie them to",
                          settings.path));
  }

  /// Nothing after a problem.
  std::optional<dynamics::Tie> tie_of(const TieSettings& settings, NodeId node,
                                      const Found& found) {
    dynamics::Tie tie{.node = node, .to = found.to};
    tie.rest_length = settings.rest_length.value_or(found.distance);
    tie.pushes = !settings.only_pulls;
    tie.strength = settings.strength;
    tie.brake_force = settings.brake_force;
    tie.stroke = settings.stroke;
    tie.friction = settings.friction;
    tie.slip_force = settings.slip_force;
    tie.stiffness = settings.stiffness.value_or(default_stiffness(node, found));
    if (std::isfinite(tie.stiffness) && tie.stiffness > 0.0) return tie;
    complain("stiffness",
             "missing; what it ties is rigid or has no bars, beams or sheets, so that none follows "
             "from that; expected a stiffness");
    return std::nullopt;
  }

  /// N/m, as much as the bars, beams and sheets around the softer end: so a tie hardly changes how
  /// stiff what it joins is, and does not shorten the time step much. Infinite without any.
  double default_stiffness(NodeId node, const Found& found) const {
    double softest = kInfinite;
    const auto look = [&](NodeId end) {
      if (around_[index_of(end)] > 0.0) softest = std::min(softest, around_[index_of(end)]);
    };
    look(node);
    for (const NodeId end : found.nodes) look(end);
    return softest;
  }

  Found find(const TieSettings& settings, NodeId node) {
    const Vec3& x = place(node);
    switch (settings.kind) {
      case TieTo::ground:
        return {FixedPoint{x}, {}, 0.0};
      case TieTo::point:
        return {FixedPoint{settings.point}, {}, (x - settings.point).norm()};
      case TieTo::nodes:
        return nearest_node(node);
      case TieTo::surface:
        return nearest_on_surface(node);
      case TieTo::body:
        return {dynamics::material_point(follower_at(x, *settings.to.rigid_body)), {}, 0.0};
      case TieTo::cable:
        break;
    }
    return nearest_on_cable(node);
  }

  /// A node of a rigid body at a place: what pulls it, pulls and turns the body.
  /// @param table  of the body, among [[rigid_bodies]]
  NodeId follower_at(Vec3 place, std::size_t table) {
    const NodeId follower = built_.scene.add_node(place, dynamics::Held::everything);
    const NodeId reference = rigid_body_of(table, built_).node;
    std::vector<dynamics::RigidBody>& bodies = built_.scene.rigid_bodies;
    std::find_if(bodies.begin(), bodies.end(), [&](const dynamics::RigidBody& body) {
      return body.node == reference;
    })->nodes.push_back(follower);
    return follower;
  }

  /// What the nodes of a table are tied to: points, segments or triangles, in a tree of boxes.
  /// @returns whether there was no problem
  bool list_targets(const TieSettings& settings) {
    targets_.clear();
    if (settings.kind == TieTo::nodes) {
      for (const NodeId node : nodes_of_set(settings.to, "to")) targets_.push_back({node});
    } else if (settings.kind == TieTo::surface) {
      if (!has_surface(settings.to)) return false;
      list_surface(settings.to);
    } else if (settings.kind == TieTo::cable) {
      cable_ = cable_of(settings.to.body);
      if (!cable_) return false;
      const dynamics::Cable& cable = built_.scene.cables[*cable_];
      of_cable_ = {cable.nodes.begin(), cable.nodes.end()};
      for (std::size_t s = 0; s < cable.segments(); ++s)
        targets_.push_back({cable.nodes[s], cable.nodes[(s + 1) % cable.nodes.size()]});
    }
    std::vector<geometry::ThickBox> boxes;
    for (const Target& target : targets_) {
      std::vector<Vec3> corners;
      for (const NodeId node : target) corners.push_back(place(node));
      boxes.push_back({geometry::bounding_box(corners, 0.0), 0.0});
    }
    tree_.rebuild(boxes);
    return true;
  }

  /// The nearest target, the first of several.
  /// @param found_at  (number of the target) -> Found, of any distance
  template <class FoundAt>
  Found nearest_target(NodeId node, const FoundAt& found_at) const {
    Found nearest;
    std::int32_t best = 0;
    const Vec3& x = place(node);
    tree_.for_each_nearer({x, x}, nearest.distance, [&](std::int32_t item) {
      Found found = found_at(static_cast<std::size_t>(item));
      const bool is_as_near = found.distance == nearest.distance && item < best;
      if (!(found.distance < nearest.distance) && !is_as_near) return;
      nearest = std::move(found);
      best = item;
    });
    return nearest;
  }

  Found nearest_node(NodeId node) const {
    return nearest_target(node, [&](std::size_t target) -> Found {
      const NodeId other = targets_[target][0];
      if (other == node) return {};
      return {dynamics::material_point(other), {other}, (place(other) - place(node)).norm()};
    });
  }

  Found nearest_on_surface(NodeId node) const {
    return nearest_target(node, [&](std::size_t target) -> Found {
      const Target& of = targets_[target];
      if (std::find(of.begin(), of.end(), node) != of.end()) return {};
      const std::array<NodeId, 3> nodes = {of[0], of[1], of.size() == 3 ? of[2] : of[0]};
      const geometry::ClosestPoints closest =
          of.size() == 3 ? geometry::point_triangle(
                               place(node), {place(nodes[0]), place(nodes[1]), place(nodes[2])})
                         : geometry::point_segment(place(node), {place(nodes[0]), place(nodes[1])});
      Found found{MaterialPoint{nodes, closest.weights_b}, {}, closest.distance};
      for (std::size_t k = 0; k < 3; ++k)
        if (closest.weights_b[static_cast<int>(k)] > 0.0) found.nodes.push_back(nodes[k]);
      return found;
    });
  }

  Found nearest_on_cable(NodeId node) const {
    if (of_cable_.contains(node)) return {};
    return nearest_target(node, [&](std::size_t target) -> Found {
      const Target& ends = targets_[target];
      const auto closest = geometry::point_segment(place(node), {place(ends[0]), place(ends[1])});
      return {CablePlace{*cable_, target, closest.weights_b[1]}, ends, closest.distance};
    });
  }

  // What there is of bodies.

  const Vec3& place(NodeId node) const { return built_.scene.state.position[index_of(node)]; }

  /// What a tie remembers begins with the first stage, and its forces need both its ends.
  bool is_there(const NodeSetSettings& set, std::string_view key) {
    const bool is_absent = set.rigid_body ? scenario_.rigid_bodies[*set.rigid_body].is_absent
                                          : scenario_.membranes[set.body].is_absent;
    if (!is_absent) return true;
    complain_at(set.place, key,
                fmt::format("\"{}\" is not there in all stages; ties hold what is there from the "
                            "first to the last",
                            set.rigid_body ? scenario_.rigid_bodies[*set.rigid_body].name
                                           : scenario_.membranes[set.body].name));
    return false;
  }

  /// The place of the membrane, or of the surface of a rigid body, among those that are built.
  std::optional<std::size_t> surface_of(const NodeSetSettings& set) const {
    if (!set.rigid_body) return set.body;
    for (std::size_t i = 0; i < scenario_.membranes.size(); ++i)
      if (scenario_.membranes[i].rigid_body == set.rigid_body) return i;
    return std::nullopt;
  }

  bool has_surface(const NodeSetSettings& set) {
    if (surface_of(set)) return true;
    complain("to", fmt::format("\"{}\" is of spheres and has no surface of facets; expected kind = "
                               "\"nodes\", which ties to its centre",
                               name_of(set, built_)));
    return false;
  }

  /// Facets, and bars that are no sides of facets.
  void list_surface(const NodeSetSettings& set) {
    const auto [first_facet, facet_count] = range_of(*surface_of(set), &BuiltMembrane::facets);
    const auto facets = std::span(built_.scene.elements.facets).subspan(first_facet, facet_count);
    for (const geometry::Facet& facet : facets)
      targets_.push_back({facet.nodes.begin(), facet.nodes.end()});
    const geometry::NodeSets<2> sides = geometry::set_of_sides(facets);
    const auto [first, count] = range_of(*surface_of(set), &BuiltMembrane::cylinders);
    for (std::size_t i = first; i < first + count; ++i) {
      const auto& nodes = built_.scene.elements.cylinders[i].nodes;
      if (!sides.contains(nodes)) targets_.push_back({nodes.begin(), nodes.end()});
    }
  }

  std::pair<std::size_t, std::size_t> range_of(std::size_t membrane,
                                               std::size_t BuiltMembrane::*count) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < membrane; ++i) first += built_.membranes[i].*count;
    return {first, built_.membranes[membrane].*count};
  }

  std::vector<NodeId> nodes_of_set(const NodeSetSettings& set, std::string_view key) {
    std::vector<NodeId> nodes = nodes_of(set, built_);
    if (nodes.empty())
      complain_at(set.place, fmt::format("{}.nodes", key),
                  set.which == SetWhich::rim
                      ? fmt::format("\"{}\" is closed and has no rim; expected a side such as "
                                    "\"x_min\", or a box {{ min = [...], max = [...] }}",
                                    name_of(set, built_))
                      : fmt::format("\"{}\" has no node there; the box counts in the scene, after "
                                    "scale, rotate and translate",
                                    name_of(set, built_)));
    return nodes;
  }

  /// The bars of a membrane as a cable; nothing after a problem.
  std::optional<std::size_t> cable_of(std::size_t membrane) {
    if (const auto known = cables_.find(membrane); known != cables_.end()) return known->second;
    std::map<NodeId, std::vector<NodeId>> beside;
    const auto [first, count] = range_of(membrane, &BuiltMembrane::cylinders);
    for (std::size_t i = first; i < first + count; ++i) {
      const auto& [a, b] = built_.scene.elements.cylinders[i].nodes;
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
    dynamics::Cable cable = chain_of(beside);
    const bool is_chain = std::all_of(beside.begin(), beside.end(),
                                      [](const auto& node) { return node.second.size() <= 2; }) &&
                          !beside.empty() && cable.nodes.size() == beside.size();
    if (!is_chain) {
      complain_at(current_->to.place, "to.membrane",
                  fmt::format("\"{}\" is no cable; expected a membrane of bars that follow each "
                              "other without branches, as shape = {{ kind = \"chain\", ... }}",
                              built_.membranes[membrane].name));
      return std::nullopt;
    }
    built_.scene.cables.push_back(std::move(cable));
    return cables_[membrane] = built_.scene.cables.size() - 1;
  }

  /// From the end with the lowest node, or from the lowest node of a ring, as far as it goes.
  static dynamics::Cable chain_of(const std::map<NodeId, std::vector<NodeId>>& beside) {
    dynamics::Cable cable;
    if (beside.empty()) return cable;
    const auto end = std::find_if(beside.begin(), beside.end(),
                                  [](const auto& node) { return node.second.size() == 1; });
    cable.is_closed = end == beside.end();
    NodeId before{-1};
    NodeId here = cable.is_closed ? beside.begin()->first : end->first;
    const NodeId start = here;
    do {
      cable.nodes.push_back(here);
      const std::vector<NodeId>& ways = beside.at(here);
      const auto on =
          std::find_if(ways.begin(), ways.end(), [&](NodeId other) { return other != before; });
      if (on == ways.end()) break;
      before = std::exchange(here, *on);
    } while (here != start && cable.nodes.size() < beside.size());
    return cable;
  }

  void complain(std::string_view key, const std::string& what) {
    complain_at(current_->to_place, key, what);
  }
  void complain_at(const Place& where, std::string_view key, const std::string& what) {
    problems_.add(where, fmt::format("{}.{}: {}", current_->path, key, what));
  }

  const Scenario& scenario_;
  BuiltScene& built_;
  Problems problems_;
  const TieSettings* current_ = nullptr;
  std::vector<double> around_;                 // N/m, by NodeId
  std::vector<Target> targets_;                // of this table
  geometry::BoxTree tree_;                     // of them
  std::optional<std::size_t> cable_;           // of kind cable
  std::set<NodeId> of_cable_;                  // its nodes
  std::map<std::size_t, std::size_t> cables_;  // by membrane
};

}  // namespace

void add_ties(const Scenario& scenario, BuiltScene& built) {
  if (!scenario.ties.empty()) TieBuilder(scenario, built).add_all();
}

}  // namespace plekton::apps

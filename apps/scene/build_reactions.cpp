// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_reactions.hpp"

#include "apps/scene/at_start.hpp"
#include "apps/scene/node_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

using dynamics::Held;

/// What touches others of a rigid body.
const std::vector<geometry::NodeId>& followers_of(geometry::NodeId reference,
                                                  const dynamics::Scene& scene) {
  return std::find_if(scene.rigid_bodies.begin(), scene.rigid_bodies.end(),
                      [&](const dynamics::RigidBody& body) { return body.node == reference; })
      ->nodes;
}

/// Why there is nothing to add up; empty if there is.
std::string problem_of(const ReactionSettings& settings, const BuiltReaction& reaction,
                       const std::vector<Held>& held, const BuiltScene& built) {
  const std::string& name = name_of(settings.nodes, built);
  if (reaction.nodes.empty())
    return settings.nodes.which == SetWhich::rim
               ? fmt::format(
                     "\"{}\" is closed and has no rim; expected a side such as \"x_min\", "
                     "or a box {{ min = [...], max = [...] }}",
                     name)
               : fmt::format(
                     "\"{}\" has no node there; the box counts in the scene, after scale, "
                     "rotate and translate",
                     name);
  if (settings.kind == ReactionKind::nodes) return {};
  const bool any_is_held =
      std::any_of(reaction.nodes.begin(), reaction.nodes.end(), [&](geometry::NodeId node) {
        return (held[geometry::index_of(node)] & Held::everything) != Held::nothing;
      });
  if (any_is_held) return {};
  return fmt::format(
      "none of these nodes of \"{}\" is held or moved, so nothing supports them; "
      "expected nodes of its `hold` or of a load of kind \"motion\", or kind = "
      "\"contacts\"",
      name);
}

/// What messages call that which ends the stage or the run.
std::string end_path(const Scenario& scenario) {
  return scenario.stage ? scenario.stage->path + ".end" : "stop";
}

void find_moved_nodes(const Scenario& scenario, BuiltScene& built, const StageBodies* bodies,
                      Problems& problems) {
  const StageEnd* const end = scenario.end();
  if (end == nullptr || !end->displacement || !end->displacement->nodes) return;
  const std::optional<NodeSetSettings>& nodes = end->displacement->nodes;
  const AtStart at_start(built, bodies ? &bodies->starts.back() : nullptr);
  built.moved_nodes = nodes_of(*nodes, built);
  if (built.moved_nodes.empty())
    problems.add(nodes->place,
                 fmt::format("{}.displacement: {}", end_path(scenario), nothing_of(*nodes, built)));
}

/// Those whose distance is to change have to be apart.
void require_distance(const Scenario& scenario, const BuiltScene& built, const StageBodies* bodies,
                      Problems& problems) {
  const StageEnd* const end = scenario.end();
  if (end == nullptr || !end->strain) return;
  const auto [a, b] = end->strain->of;
  const auto place_of = [&](std::size_t number) -> Vec3 {
    if (!end->strain->are_rigid_bodies)
      return bodies ? bodies->starts.back().planes[number] : built.scene.planes[number].point;
    const std::size_t node = geometry::index_of(rigid_body_of(number, built).node);
    return bodies ? bodies->starts.back().positions[node] : built.scene.state.position[node];
  };
  const Vec3 apart = place_of(b) - place_of(a);
  const double distance = end->strain->are_rigid_bodies
                              ? apart.norm()
                              : std::abs(apart.dot(built.scene.planes[a].normal));
  if (distance > 0.0) return;
  problems.add(end->strain->place,
               fmt::format("{}.strain.between: the two are at no distance from each other at the "
                           "start, of which no part can be told; expected two that are apart",
                           end_path(scenario)));
}

}  // namespace

void add_reactions(const Scenario& scenario, BuiltScene& built, const StageBodies* bodies) {
  Problems problems;
  const std::vector<Held> held =
      dynamics::held_with_motions(built.scene.properties.held, built.scene.loads.motions);
  for (std::size_t i = 0; i < scenario.output.reactions.size(); ++i) {
    const ReactionSettings& settings = scenario.output.reactions[i];
    const AtStart at_start(
        built, bodies ? &bodies->starts[scenario.stage->origins.reactions[i]] : nullptr);
    BuiltReaction reaction{settings.name, settings.kind, settings.plane, {}, settings.about};
    if (settings.kind != ReactionKind::plane) reaction.nodes = nodes_of(settings.nodes, built);
    if (settings.kind == ReactionKind::contacts && settings.nodes.rigid_body)
      reaction.nodes = followers_of(reaction.nodes.front(), built.scene);
    if (settings.kind == ReactionKind::support || settings.kind == ReactionKind::nodes) {
      const std::string problem = problem_of(settings, reaction, held, built);
      if (!problem.empty())
        problems.add(settings.nodes.place, fmt::format("{}.nodes: {}", settings.path, problem));
    }
    built.reactions.push_back(std::move(reaction));
  }
  find_moved_nodes(scenario, built, bodies, problems);
  require_distance(scenario, built, bodies, problems);
  problems.throw_if_any();
}

}  // namespace plekton::apps

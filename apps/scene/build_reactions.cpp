// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_reactions.hpp"

#include "apps/scene/at_start.hpp"
#include "apps/scene/node_set.hpp"
#include "dynamics/model/scene_figures.hpp"

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

bool holds_any(Held held) {
  return (held & Held::everything) != Held::nothing;
}

bool is_any_held(const std::vector<geometry::NodeId>& nodes, const std::vector<Held>& held) {
  return std::any_of(nodes.begin(), nodes.end(), [&](geometry::NodeId node) {
    return holds_any(held[geometry::index_of(node)]);
  });
}

/// By node, what is held by supports: not nodes that nothing turns, which are held so and not more.
std::vector<Held> held_by_supports(const BuiltScene& built) {
  std::vector<Held> held = dynamics::held_with_loads(built.scene);
  for (const BuiltMembrane& membrane : built.membranes) {
    if (membrane.turns_nodes) continue;
    const auto first = held.begin() + static_cast<std::ptrdiff_t>(membrane.first_node);
    std::replace(first, first + static_cast<std::ptrdiff_t>(membrane.nodes), Held::rotation,
                 Held::nothing);
  }
  return held;
}

/// Whether a beam or a sheet goes from some nodes to others.
bool is_section(const std::vector<geometry::NodeId>& nodes, const dynamics::Scene& scene) {
  std::vector<char> is_inside(scene.state.size(), 0);
  for (const geometry::NodeId node : nodes) is_inside[geometry::index_of(node)] = 1;
  const auto is_cut = [&](const auto& element) {
    return std::any_of(element.nodes.begin(), element.nodes.end(), [&](geometry::NodeId node) {
      return is_inside[geometry::index_of(node)] !=
             is_inside[geometry::index_of(element.nodes.front())];
    });
  };
  return std::any_of(scene.bonds.begin(), scene.bonds.end(), is_cut) ||
         std::any_of(scene.sheet_facets.begin(), scene.sheet_facets.end(), is_cut);
}

/// Why there is nothing to add up; empty if there is.
std::string problem_of(const ReactionSettings& settings, const BuiltReaction& reaction,
                       const std::vector<Held>& held, const BuiltScene& built) {
  if (reaction.nodes.empty()) return nothing_of(settings.nodes, built);
  if (settings.kind == ReactionKind::section)
    return is_section(reaction.nodes, built.scene)
               ? ""
               : fmt::format(
                     "no beam or sheet goes from these nodes of \"{}\" to others, so that "
                     "there is no section; expected a part of its nodes",
                     name_of(settings.nodes, built));
  if (settings.kind == ReactionKind::nodes || is_any_held(reaction.nodes, held)) return {};
  return fmt::format(
      "none of these nodes of \"{}\" is held or moved, so nothing supports them; "
      "expected nodes of its `hold` or of a load of kind \"motion\", a rigid body that a servo "
      "drives, or kind = \"contacts\"",
      name_of(settings.nodes, built));
}

/// How many of some nodes a stage frees at its start.
/// @param held   by node, with what loads hold
std::size_t count_freed(const std::vector<geometry::NodeId>& nodes, const StageSettings& stage,
                        const std::vector<Held>& held, const BuiltScene& built) {
  std::size_t count = 0;
  for (const NodeSetSettings& set : stage.freed) {
    const std::vector<geometry::NodeId> freed = nodes_of(set, built);
    count += static_cast<std::size_t>(
        std::count_if(nodes.begin(), nodes.end(), [&](geometry::NodeId node) {
          return !holds_any(held[geometry::index_of(node)]) &&
                 std::binary_search(freed.begin(), freed.end(), node);
        }));
  }
  return count;
}

/// Of supports that were there in an earlier stage, what this one has taken from them; else empty.
/// @param built  its nodes where they are at the start of the stage
std::string warning_about_freed(const StageSettings& stage, const ReactionSettings& settings,
                                const BuiltReaction& reaction, const std::vector<Held>& held,
                                const BuiltScene& built) {
  if (!is_any_held(reaction.nodes, held))
    return fmt::format(
        "{}: holds none of the nodes of {} any more, of kind \"support\", which is 0 from there "
        "on; "
        "kind \"nodes\" or \"contacts\" tells what acts on them",
        stage.path, settings.path);
  const std::size_t freed = count_freed(reaction.nodes, stage, held, built);
  if (freed == 0) return {};
  return fmt::format(
      "{}.free: frees {} of the {} nodes of {}, of kind \"support\", which adds up "
      "what the others bear from there on",
      stage.path, freed, reaction.nodes.size(), settings.path);
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
  const std::vector<Held> held = held_by_supports(built);
  for (std::size_t i = 0; i < scenario.output.reactions.size(); ++i) {
    const ReactionSettings& settings = scenario.output.reactions[i];
    const AtStart at_start(
        built, bodies ? &bodies->starts[scenario.stage->origins.reactions[i]] : nullptr);
    BuiltReaction reaction{settings.name, settings.kind, settings.plane, {}, settings.about};
    if (settings.kind != ReactionKind::plane) reaction.nodes = nodes_of(settings.nodes, built);
    if (settings.kind == ReactionKind::contacts && settings.nodes.rigid_body)
      reaction.nodes = followers_of(reaction.nodes.front(), built.scene);
    const bool is_later =
        bodies != nullptr && scenario.stage->origins.reactions[i] < scenario.stage->number;
    if (is_later && settings.kind == ReactionKind::support && !reaction.nodes.empty()) {
      const AtStart of_stage(built, &bodies->starts.back());
      std::string warning = warning_about_freed(*scenario.stage, settings, reaction, held, built);
      if (!warning.empty()) built.warnings.push_back(std::move(warning));
    } else if (settings.kind != ReactionKind::plane && settings.kind != ReactionKind::contacts) {
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_stage.hpp"

#include "apps/scene/build_loads.hpp"
#include "apps/scene/build_reactions.hpp"
#include "apps/scene/fixity.hpp"
#include "apps/scene/rigid_builder.hpp"
#include "apps/scene/stage_ends.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

namespace plekton::apps {
namespace {

using dynamics::Held;
using geometry::index_of;

std::vector<Vec3> points_of(const std::vector<contact::Plane>& planes) {
  std::vector<Vec3> points;
  for (const contact::Plane& plane : planes) points.push_back(plane.point);
  return points;
}

void add_conditions(const Scenario& stage, const StageBodies& bodies, BuiltScene& built) {
  built.scene.properties.held = bodies.held;
  add_loads(stage, built, &bodies);
  hold_as_loaded(stage, built);
  add_reactions(stage, built, &bodies);
}

/// Grains come last, in the order of their tables, after the spheres of rigid bodies, some of which
/// may have come or gone.
void take_new_grains(const Scenario& stage, const BuiltScene& built, StageBodies& bodies,
                     std::vector<Vec3>& positions) {
  std::size_t sphere = 0;
  for (std::size_t table = 0; table < built.grains.size(); ++table) {
    const bool is_rigid = stage.grains[table].rigid_body.has_value();
    const bool is_new = !is_rigid && table >= bodies.grains.size();
    if (is_new) bodies.grains.emplace_back();
    if (is_rigid) bodies.grains[table].clear();
    for (std::size_t i = 0; i < built.grains[table].count; ++i, ++sphere) {
      const geometry::Sphere& grain = built.scene.elements.spheres[sphere];
      if (is_new || is_rigid) bodies.grains[table].push_back(grain.radius);
      if (!is_new) continue;
      const std::size_t node = index_of(grain.nodes[0]);
      positions.push_back(built.scene.state.position[node]);
      bodies.held.push_back(built.scene.properties.held[node]);
      for (StageStart& start : bodies.starts) start.positions.push_back(positions.back());
    }
  }
}

/// Structures that come are where they are made; what comes or goes is held as they are made, or
/// where they are.
void take_presence(const BuiltScene& built, StageBodies& bodies, std::vector<Vec3>& positions) {
  const dynamics::Scene& scene = built.scene;
  const std::vector<bool> was_absent = std::exchange(bodies.is_absent, scene.is_absent);
  for (std::size_t node = 0; node < positions.size(); ++node) {
    const bool was = node < was_absent.size() && was_absent[node];
    const bool is = !scene.is_there(geometry::id_at<geometry::NodeId>(node));
    if (was == is) continue;
    bodies.held[node] = scene.properties.held[node];
    if (is) continue;
    positions[node] = scene.state.position[node];
    for (StageStart& start : bodies.starts) start.positions[node] = positions[node];
  }
}

/// Of bodies of which the stage says anew what is held.
void hold_as_told(const Scenario& stage, const BuiltScene& built, StageBodies& bodies) {
  for (const BuiltRigidBody& body : built.rigid_bodies) {
    if (!body.is_absent && stage.stage->origins.says_hold[body.table])
      bodies.held[index_of(body.node)] = stage.rigid_bodies[body.table].held | Held::by_body;
  }
}

/// What was known of each plane, and of those that are new what is known now.
/// @param origins  their places before; below 0: new
template <class Thing>
void take_new(const std::vector<Thing>& now, const std::vector<int>& origins,
              std::vector<Thing>& things) {
  std::vector<Thing> before = now;
  for (std::size_t i = 0; i < origins.size(); ++i)
    if (origins[i] >= 0) before[i] = things[static_cast<std::size_t>(origins[i])];
  things = std::move(before);
}

/// How a stage begins.
StageStart start_of(double time, const std::vector<Vec3>& positions,
                    const std::vector<contact::Plane>& planes) {
  StageStart start{time, positions, points_of(planes), {}};
  for (const contact::Plane& plane : planes) start.radii.push_back(plane.radius);
  return start;
}

}  // namespace

StageBodies first_stage(const BuiltScene& built) {
  StageBodies bodies;
  bodies.held = built.scene.properties.held;
  bodies.is_absent = built.scene.is_absent;
  std::size_t sphere = 0;
  for (const BuiltGrains& grains : built.grains) {
    bodies.grains.emplace_back();
    for (std::size_t i = 0; i < grains.count; ++i)
      bodies.grains.back().push_back(built.scene.elements.spheres[sphere++].radius);
  }
  bodies.starts.push_back(start_of(0.0, built.scene.state.position, built.scene.planes));
  return bodies;
}

BuiltScene build_stage(const Scenario& stage, const StageBodies& bodies,
                       std::span<const Vec3> positions, const HearSetUp& hear) {
  BuiltScene built = build_bodies(stage, {bodies.grains, positions}, hear);
  add_conditions(stage, bodies, built);
  return built;
}

namespace {

/// @param built  its bodies
BuiltScene begun(BuiltScene built, const Scenario& stage, StageBodies& bodies,
                 std::vector<Vec3>& positions, double time) {
  take_presence(built, bodies, positions);
  take_new_grains(stage, built, bodies, positions);
  hold_as_told(stage, built, bodies);
  std::vector<Vec3> as_built = std::exchange(built.scene.state.position, positions);
  fix_and_free(*stage.stage, built, bodies.held);
  require_apart(stage.stage->end, built);
  built.scene.state.position = std::move(as_built);
  StageStart begins = start_of(time, positions, built.scene.planes);
  // Of nothing that there was before, where these planes begin.
  for (StageStart& start : bodies.starts) {
    take_new(begins.planes, stage.stage->origins.planes, start.planes);
    take_new(begins.radii, stage.stage->origins.planes, start.radii);
  }
  bodies.stage = stage.stage->number;
  bodies.starts.push_back(std::move(begins));
  add_conditions(stage, bodies, built);
  return built;
}

bool is_among_grains(const NodeSetSettings& set) {
  return set.of_grains && set.which != SetWhich::all;
}

/// Whether only a run can find the nodes: of grains that are gone there are none.
bool is_unknown(const NodeSetSettings& set, const StageBodies& bodies) {
  const bool are_gone = set.body < bodies.grains.size() && bodies.grains[set.body].empty();
  return is_among_grains(set) && !are_gone;
}

/// Whether a load acts on such nodes.
bool is_unknown(const LoadSettings& settings, const StageBodies& bodies) {
  return std::visit(
      [&](const auto& load) {
        if constexpr (requires { load.nodes.of_grains; }) return is_unknown(load.nodes, bodies);
        return false;
      },
      settings.load);
}

template <class Thing, class Origin, class IsOut>
void erase(std::vector<Thing>& things, std::vector<Origin>& origins, IsOut is_out) {
  for (std::size_t i = things.size(); i-- > 0;) {
    if (!is_out(things[i])) continue;
    things.erase(things.begin() + static_cast<std::ptrdiff_t>(i));
    origins.erase(origins.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Without what looks for grains at places.
Scenario as_far_as_known(Scenario scenario, const StageBodies& bodies) {
  StageSettings& stage = *scenario.stage;
  const auto unknown = [&](const auto& thing) { return is_unknown(thing, bodies); };
  erase(scenario.loads, stage.origins.loads, unknown);
  erase(scenario.output.reactions, stage.origins.reactions, [&](const ReactionSettings& reaction) {
    return reaction.kind != ReactionKind::plane && unknown(reaction.nodes);
  });
  if (stage.end.displacement && stage.end.displacement->nodes &&
      unknown(*stage.end.displacement->nodes))
    stage.end.displacement.reset();
  std::erase_if(stage.fixed, unknown);
  std::erase_if(stage.freed, unknown);
  return scenario;
}

}  // namespace

BuiltScene begin_stage(const Scenario& stage, StageBodies& bodies, std::vector<Vec3>& positions,
                       double time, const HearSetUp& hear) {
  return begun(build_bodies(stage, {bodies.grains, positions}, hear), stage, bodies, positions,
               time);
}

BuiltScene try_stage(const Scenario& stage, StageBodies& bodies, std::vector<Vec3>& positions,
                     const HearSetUp& hear) {
  const Scenario known = as_far_as_known(stage, bodies);
  return begun(build_bodies(known, {bodies.grains, positions, false}, hear), known, bodies,
               positions, 0.0);
}

bool frees_grains_at_places(const StageSettings& stage) {
  return std::ranges::any_of(stage.freed, [](const auto& set) { return is_among_grains(set); });
}

}  // namespace plekton::apps

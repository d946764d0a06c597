// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_stage.hpp"

#include "apps/scene/build_loads.hpp"
#include "apps/scene/build_reactions.hpp"
#include "apps/scene/node_set.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <variant>

namespace plekton::apps {
namespace {

std::vector<Vec3> points_of(const std::vector<contact::Plane>& planes) {
  std::vector<Vec3> points;
  for (const contact::Plane& plane : planes) points.push_back(plane.point);
  return points;
}

void add_conditions(const Scenario& stage, const StageBodies& bodies, BuiltScene& built) {
  built.scene.properties.held = bodies.held;
  add_loads(stage, built, &bodies);
  add_reactions(stage, built, &bodies);
}

/// Grains come last, in the order of their tables.
void take_new_grains(const BuiltScene& built, StageBodies& bodies, std::vector<Vec3>& positions) {
  std::size_t sphere = 0;
  for (std::size_t table = 0; table < built.grains.size(); ++table) {
    const bool is_new = table >= bodies.grains.size();
    if (is_new) bodies.grains.emplace_back();
    for (std::size_t i = 0; i < built.grains[table].count; ++i, ++sphere) {
      if (!is_new) continue;
      const geometry::Sphere& grain = built.scene.elements.spheres[sphere];
      const std::size_t node = geometry::index_of(grain.nodes[0]);
      bodies.grains.back().push_back(grain.radius);
      positions.push_back(built.scene.state.position[node]);
      bodies.held.push_back(built.scene.properties.held[node]);
      for (StageStart& start : bodies.starts) start.positions.push_back(positions.back());
    }
  }
}

void fix_and_free(const StageSettings& stage, const BuiltScene& there, StageBodies& bodies) {
  Problems problems;
  const auto set_all = [&](const std::vector<NodeSetSettings>& sets, dynamics::Held held) {
    for (const NodeSetSettings& set : sets) {
      const std::vector<geometry::NodeId> nodes = nodes_of(set, there);
      if (nodes.empty())
        problems.add(set.place,
                     fmt::format("{}: has no node there at the start of the stage", stage.path));
      for (const geometry::NodeId node : nodes) bodies.held[geometry::index_of(node)] = held;
    }
  };
  set_all(stage.freed, dynamics::Held::nothing);
  set_all(stage.fixed, dynamics::Held::everything);
  problems.throw_if_any();
}

/// Of nothing that there was before, where these planes begin.
void note_new_planes(const Scenario& stage, const std::vector<Vec3>& points, StageBodies& bodies) {
  const std::vector<int>& origins = stage.stage->origins.planes;
  for (StageStart& start : bodies.starts) {
    std::vector<Vec3> planes;
    for (std::size_t i = 0; i < origins.size(); ++i)
      planes.push_back(origins[i] < 0 ? points[i]
                                      : start.planes[static_cast<std::size_t>(origins[i])]);
    start.planes = std::move(planes);
  }
}

}  // namespace

StageBodies first_stage(const BuiltScene& built) {
  StageBodies bodies;
  bodies.held = built.scene.properties.held;
  std::size_t sphere = 0;
  for (const BuiltGrains& grains : built.grains) {
    bodies.grains.emplace_back();
    for (std::size_t i = 0; i < grains.count; ++i)
      bodies.grains.back().push_back(built.scene.elements.spheres[sphere++].radius);
  }
  bodies.starts.push_back({0.0, built.scene.state.position, points_of(built.scene.planes)});
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
  take_new_grains(built, bodies, positions);
  std::vector<Vec3> as_built = std::exchange(built.scene.state.position, positions);
  fix_and_free(*stage.stage, built, bodies);
  built.scene.state.position = std::move(as_built);
  const std::vector<Vec3> planes = points_of(built.scene.planes);
  note_new_planes(stage, planes, bodies);
  bodies.stage = stage.stage->number;
  bodies.starts.push_back({time, positions, planes});
  add_conditions(stage, bodies, built);
  return built;
}

bool is_among_grains(const NodeSetSettings& set) {
  return set.of_grains && set.which != SetWhich::all;
}

/// Whether a load acts on nodes that only a run can find.
bool is_among_grains(const LoadSettings& settings) {
  return std::visit(
      [](const auto& load) {
        if constexpr (requires { load.nodes.of_grains; }) return is_among_grains(load.nodes);
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
Scenario as_far_as_known(Scenario scenario) {
  StageSettings& stage = *scenario.stage;
  const auto among_grains = [](const auto& thing) { return is_among_grains(thing); };
  erase(scenario.loads, stage.origins.loads, among_grains);
  erase(scenario.output.reactions, stage.origins.reactions, [](const ReactionSettings& reaction) {
    return reaction.kind != ReactionKind::plane && is_among_grains(reaction.nodes);
  });
  std::erase_if(stage.fixed, among_grains);
  std::erase_if(stage.freed, among_grains);
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
  const Scenario known = as_far_as_known(stage);
  return begun(build_bodies(known, {bodies.grains, positions, false}, hear), known, bodies,
               positions, 0.0);
}

}  // namespace plekton::apps

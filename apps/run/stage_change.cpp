// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stage_change.hpp"

#include "apps/run/initial_contacts.hpp"
#include "apps/run/run_state.hpp"
#include "apps/scene/build_stage.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::StateArchive;

bool is_removed(const RemovalSettings& removal, const Vec3& centre) {
  if (!(centre[2] > removal.above && centre[2] < removal.below)) return false;
  return !removal.box || ((centre.array() >= removal.box->lower.array()).all() &&
                          (centre.array() <= removal.box->upper.array()).all());
}

/// The bodies of a stage without those that the next one takes out.
class KeptBodies {
 public:
  KeptBodies(const StageSettings& stage, const PreparedRun& before) {
    const dynamics::Simulation& simulation = *before.simulation;
    const auto& spheres = simulation.elements().spheres;
    places_.nodes.assign(simulation.state().size(), 0);
    std::size_t sphere = 0;
    for (std::size_t table = 0; table < before.bodies.grains.size(); ++table) {
      bodies_.grains.emplace_back();
      for (const double radius : before.bodies.grains[table]) {
        const std::size_t node = index_of(spheres[sphere++].nodes[0]);
        const Vec3& centre = simulation.state().position[node];
        const bool is_out = std::any_of(
            stage.removals.begin(), stage.removals.end(), [&](const RemovalSettings& removal) {
              return removal.grains == table && is_removed(removal, centre);
            });
        if (is_out)
          places_.nodes[node] = -1;
        else
          bodies_.grains.back().push_back(radius);
      }
    }
    std::int32_t next = 0;
    for (std::int32_t& node : places_.nodes)
      if (node == 0) node = next++;
    bodies_.stage = before.bodies.stage;
    bodies_.held = kept(before.bodies.held);
    bodies_.is_absent = before.bodies.is_absent;
    for (const StageStart& start : before.bodies.starts)
      bodies_.starts.push_back({start.time, kept(start.positions), start.planes});
    positions_ = kept(simulation.state().position);
  }

  template <class Thing>
  std::vector<Thing> kept(const std::vector<Thing>& of_nodes) const {
    std::vector<Thing> left;
    for (std::size_t i = 0; i < of_nodes.size(); ++i)
      if (places_.nodes[i] >= 0) left.push_back(of_nodes[i]);
    return left;
  }

  StageBodies& bodies() noexcept { return bodies_; }
  std::vector<Vec3>& positions() noexcept { return positions_; }
  const contact::BodyPlaces& places() const noexcept { return places_; }

 private:
  contact::BodyPlaces places_;
  StageBodies bodies_;
  std::vector<Vec3> positions_;
};

/// A stage with its planes where they are.
Scenario with_planes_of_now(Scenario stage, const dynamics::Simulation& before) {
  const StageOrigins& origins = stage.stage->origins;
  for (std::size_t i = 0; i < stage.planes.size(); ++i) {
    if (origins.planes[i] >= 0 && !origins.moved_planes[i])
      stage.planes[i].point = before.planes()[static_cast<std::size_t>(origins.planes[i])].point;
  }
  return stage;
}

/// By the spheres of before, which are where their nodes are.
std::vector<std::int32_t> sphere_places(const std::vector<std::int32_t>& nodes,
                                        const dynamics::Simulation& before,
                                        const dynamics::Scene& now) {
  std::vector<std::int32_t> of_node(now.state.size(), -1);
  for (std::size_t i = 0; i < now.elements.spheres.size(); ++i)
    of_node[index_of(now.elements.spheres[i].nodes[0])] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> places;
  for (const geometry::Sphere& sphere : before.elements().spheres) {
    const std::int32_t node = nodes[index_of(sphere.nodes[0])];
    places.push_back(node < 0 ? -1 : of_node[static_cast<std::size_t>(node)]);
  }
  return places;
}

/// @param places  of nodes and spheres
dynamics::SceneChange change_to(const StageOrigins& origins, contact::BodyPlaces places,
                                const dynamics::Simulation& before, const dynamics::Scene& now) {
  // What comes begins as it is made.
  for (std::size_t node = 0; node < places.nodes.size(); ++node) {
    const std::int32_t place = places.nodes[node];
    if (place >= 0 && !before.scene().is_there(geometry::id_at<geometry::NodeId>(node)) &&
        now.is_there(geometry::NodeId{place}))
      places.nodes[node] = -1;
  }
  places.planes.assign(before.planes().size(), -1);
  for (std::size_t i = 0; i < origins.planes.size(); ++i)
    if (origins.planes[i] >= 0)
      places.planes[static_cast<std::size_t>(origins.planes[i])] = static_cast<std::int32_t>(i);
  return {std::move(places), origins.moved_planes};
}

/// Flags of grains, by those of now. @returns them
std::vector<bool> carry_flags(const StateArchive& from, const StateArchive& to, const char* name,
                              const contact::BodyPlaces& places, std::size_t spheres) {
  std::vector<bool> before, now(spheres, false);
  from(name, before);
  for (std::size_t i = 0; i < places.spheres.size(); ++i)
    if (places.spheres[i] >= 0) now[static_cast<std::size_t>(places.spheres[i])] = before[i];
  to(name, now);
  return now;
}

/// Which grains are lost, of those of now. What has come may be outside of where all began.
void carry_lost_grains(const StateArchive& from, const StateArchive& to,
                       const contact::BodyPlaces& places, const dynamics::Simulation& now) {
  const std::vector<geometry::Sphere>& spheres = now.elements().spheres;
  carry_flags(from, to, "is_through", places, spheres.size());
  const std::vector<bool> is_out = carry_flags(from, to, "is_out", places, spheres.size());
  std::vector<Vec3> positions = now.state().position;
  to("before", positions);
  Vec3 lower, upper;
  from("lower_bounds", lower);
  from("upper_bounds", upper);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (is_out[i]) continue;
    const Vec3& centre = positions[index_of(spheres[i].nodes[0])];
    lower = lower.cwiseMin((centre.array() - spheres[i].radius).matrix());
    upper = upper.cwiseMax((centre.array() + spheres[i].radius).matrix());
  }
  to("lower_bounds", lower);
  to("upper_bounds", upper);
}

/// What the run knows, of the bodies of now.
geometry::StateTree run_state(const geometry::StateTree& before, const contact::BodyPlaces& places,
                              const dynamics::Simulation& now) {
  const std::string group = std::string(kRunGroup) + "/";
  geometry::StateTree state;
  for (const auto& [name, array] : before.arrays)
    if (name.starts_with(group)) state.arrays[name] = array;
  const auto lost = [](const StateArchive& archive) {
    return archive.group(kRunGroup).group("lost_grains");
  };
  carry_lost_grains(lost(StateArchive::reader(before)), lost(StateArchive::writer(state)), places,
                    now);
  return state;
}

/// Whether the stage says of a plane that it is elsewhere, though perhaps by the words that it was
/// first described with.
bool moves_planes(const Scenario& stage, const dynamics::Simulation& before) {
  const StageOrigins& origins = stage.stage->origins;
  for (std::size_t i = 0; i < stage.planes.size(); ++i) {
    if (!origins.moved_planes[i] || origins.planes[i] < 0) continue;
    const auto then = static_cast<std::size_t>(origins.planes[i]);
    if (stage.planes[i].point != before.planes()[then].point) return true;
  }
  return false;
}

/// Contacts of what comes with a stage, and of grains with planes that come or are moved by it: what
/// was there before may be as deep in each other as it has been pressed.
std::vector<contact::ContactRecord> contacts_of_new(const dynamics::SceneChange& change,
                                                    dynamics::Simulation& now) {
  std::vector<bool> is_new_node(now.state().size(), true);
  for (const std::int32_t node : change.places.nodes)
    if (node >= 0) is_new_node[static_cast<std::size_t>(node)] = false;
  std::vector<bool> is_new_plane(now.planes().size(), true);
  for (const std::int32_t plane : change.places.planes) {
    if (plane < 0) continue;
    const auto i = static_cast<std::size_t>(plane);
    is_new_plane[i] = !change.moved_planes.empty() && change.moved_planes[i];
  }
  const auto is_any = [](const std::vector<bool>& all) {
    return std::find(all.begin(), all.end(), true) != all.end();
  };
  if (!is_any(is_new_node) && !is_any(is_new_plane)) return {};
  const auto is_new = [&](const contact::ContactBody& body) {
    if (body.feature.id < 0) return false;
    const geometry::FeatureNodes nodes = geometry::nodes_of(now.surface(), body.feature);
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](geometry::NodeId node) { return is_new_node[index_of(node)]; });
  };
  return now.next_contact_rows([&](const contact::ContactRecord& row) {
    if (row.b.kind != contact::BodyKind::plane) return is_new(row.a) || is_new(row.b);
    return is_new(row.a) || (row.a.kind == contact::BodyKind::sphere &&
                             is_new_plane[static_cast<std::size_t>(row.b.index)]);
  });
}

}  // namespace

StageOfState stage_of(const geometry::StateTree& state) {
  const auto archive = StateArchive::reader(state).group(kRunGroup).group(kStageGroup);
  if (!state.arrays.contains(std::string(kRunGroup) + "/" + kStageGroup + "/has_ended"))
    throw InputError("the checkpoint is one of a scenario without [[stages]]");
  StageOfState stage;
  stage.bodies.exchange(archive);
  archive("has_ended", stage.has_ended);
  return stage;
}

void require_something_free(const Scenario& stage, const dynamics::Simulation& simulation) {
  if (stage.simulation.time_step || std::isfinite(simulation.time_step())) return;
  throw InputError(fmt::format(
      "{}: nothing moves freely at its start, so no time step can be chosen; free or add "
      "something, give simulation.time_step, or end the run before it with --until",
      stage.stage->path));
}

PreparedRun prepare_stage(const Scenario& stage, const geometry::StateTree& state,
                          const HearSetUp& hear) {
  PreparedRun prepared;
  prepared.bodies = stage_of(state).bodies;
  std::vector<Vec3> positions;
  StateArchive::reader(state).group("nodes")("position", positions);
  prepared.built = build_stage(stage, prepared.bodies, positions, hear);
  if (hear) hear("looking for contacts", 0.0);
  prepared.simulation = simulation_of(stage, prepared.built);
  prepared.duration = stage.simulation.duration;
  return prepared;
}

StageBegin next_stage(const Scenario& stage, PreparedRun& before, const geometry::StateTree& state,
                      const HearSetUp& hear) {
  KeptBodies kept(*stage.stage, before);
  dynamics::Simulation& ended = *before.simulation;
  const Scenario now = with_planes_of_now(stage, ended);
  StageBegin begin;
  PreparedRun& next = begin.prepared;
  next.bodies = std::move(kept.bodies());
  next.built = begin_stage(now, next.bodies, kept.positions(), ended.time(), hear);
  contact::BodyPlaces places = kept.places();
  places.spheres = sphere_places(places.nodes, ended, next.built.scene);
  if (hear) hear("looking for contacts", 0.0);
  next.simulation = simulation_of(now, next.built);
  next.duration = stage.simulation.duration;
  try {
    if (stage.stage->origins.changes_nothing && !moves_planes(stage, ended)) {
      next.simulation->restore(ended.snapshot());
    } else {
      const dynamics::SceneChange change =
          change_to(stage.stage->origins, places, ended, next.simulation->scene());
      next.simulation->go_on_from(ended, change);
      require_possible_start(initial_contacts(now, next.built, *next.simulation,
                                              contacts_of_new(change, *next.simulation)),
                             now);
      require_something_free(stage, *next.simulation);
      choose_time_step(stage.simulation, *next.simulation);
    }
  } catch (const geometry::StateMismatch& error) {
    throw InputError(fmt::format("{}: {}", stage.stage->path, error.what()));
  }
  begin.run = run_state(state, places, *next.simulation);
  return begin;
}

}  // namespace plekton::apps

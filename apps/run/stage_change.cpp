// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stage_change.hpp"

#include "apps/run/enclosed_bodies.hpp"
#include "apps/run/initial_contacts.hpp"
#include "apps/run/lost_grains.hpp"
#include "apps/run/run_state.hpp"
#include "apps/scene/build_stage.hpp"
#include "apps/scene/node_set.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::StateArchive;

bool is_removed(const RemovalSettings& removal, const Vec3& centre) {
  if (!(centre[2] > removal.above && centre[2] < removal.below)) return false;
  return !removal.box || is_within(*removal.box, centre);
}

/// By table of grains: whether they are none of a rigid body.
std::vector<bool> tables_of_grains(const Scenario& stage) {
  std::vector<bool> tables;
  for (const GrainSettings& grains : stage.grains) tables.push_back(!grains.rigid_body);
  return tables;
}

/// The bodies of a stage without those that the next one takes out.
KeptBodies kept_bodies(const Scenario& stage, const PreparedRun& before) {
  return {before.bodies, tables_of_grains(stage), before.simulation->state().position,
          [&](std::size_t table, const Vec3& centre) {
            return std::ranges::any_of(stage.stage->removals, [&](const RemovalSettings& removal) {
              return removal.grains == table && is_removed(removal, centre);
            });
          }};
}

/// A stage with its planes where they are.
Scenario with_planes_of_now(Scenario stage, const dynamics::Simulation& before) {
  const StageOrigins& origins = stage.stage->origins;
  for (std::size_t i = 0; i < stage.planes.size(); ++i) {
    if (origins.planes[i] < 0) continue;
    const contact::Plane& then = before.planes()[static_cast<std::size_t>(origins.planes[i])];
    if (!origins.says_point[i]) stage.planes[i].point = then.point;
    if (!origins.says_radius[i] && !stage.planes[i].is_flat()) stage.planes[i].radius = then.radius;
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

/// Which grains are lost, and how.
struct LostFlags {
  std::vector<bool> is_through;  ///< by grain: it has passed through a membrane
  std::vector<bool> is_out;      ///< by grain: it has left the box around everything

  void exchange(const StateArchive& archive) {
    archive("is_through", is_through);
    archive("is_out", is_out);
  }
};

/// Those of before, of the grains of now.
LostFlags flags_of_now(const LostFlags& before, const contact::BodyPlaces& places,
                       std::size_t spheres) {
  LostFlags now{std::vector<bool>(spheres, false), std::vector<bool>(spheres, false)};
  for (std::size_t i = 0; i < places.spheres.size(); ++i) {
    if (places.spheres[i] < 0) continue;
    const auto place = static_cast<std::size_t>(places.spheres[i]);
    now.is_through[place] = before.is_through[i];
    now.is_out[place] = before.is_out[i];
  }
  return now;
}

/// How many lost grains of before are not there any more.
std::size_t count_removed(const LostFlags& before, const contact::BodyPlaces& places) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < places.spheres.size(); ++i)
    count += places.spheres[i] < 0 && (before.is_through[i] || before.is_out[i]) ? 1U : 0U;
  return count;
}

/// Elements without the grains that are lost.
geometry::Elements without(const std::vector<bool>& is_out, geometry::Elements elements) {
  std::vector<geometry::Sphere> left;
  for (std::size_t i = 0; i < is_out.size(); ++i)
    if (!is_out[i]) left.push_back(elements.spheres[i]);
  elements.spheres = std::move(left);
  return elements;
}

/// Which grains are lost, of those of now, and how many lost ones were taken out, which stay lost.
/// What has come may be outside of where all began, and roams as far around itself.
void carry_lost_grains(const StateArchive& from, const StateArchive& to,
                       const contact::BodyPlaces& places, const dynamics::Simulation& now) {
  const std::size_t spheres = now.elements().spheres.size();
  LostFlags before;
  std::size_t removed = 0;
  before.exchange(from);
  exchange_removed(from, removed);
  LostFlags lost = flags_of_now(before, places, spheres);
  removed += count_removed(before, places);
  lost.exchange(to);
  exchange_removed(to, removed);
  std::vector<Vec3> positions = now.state().position;
  to("before", positions);
  Vec3 lower, upper;
  from("lower_bounds", lower);
  from("upper_bounds", upper);
  const geometry::Box here =
      roaming_box(without(lost.is_out, now.elements()), positions, now.planes());
  lower = lower.cwiseMin(here.lower);
  upper = upper.cwiseMax(here.upper);
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
    if (stage.planes[i].point != before.planes()[then].point ||
        stage.planes[i].radius != before.planes()[then].radius)
      return true;
  }
  return false;
}

/// What comes with a stage: nodes, and planes that come or are moved by it.
struct Arrivals {
  std::vector<bool> nodes;
  std::vector<bool> planes;

  bool has(const contact::ContactBody& body, const dynamics::Simulation& simulation) const {
    if (body.feature.id < 0) return false;
    const geometry::FeatureNodes of = geometry::nodes_of(simulation.surface(), body.feature);
    return std::any_of(of.begin(), of.end(),
                       [&](geometry::NodeId node) { return nodes[index_of(node)]; });
  }
  bool are_any() const {
    const auto is_any = [](const std::vector<bool>& all) {
      return std::find(all.begin(), all.end(), true) != all.end();
    };
    return is_any(nodes) || is_any(planes);
  }
};

Arrivals arrivals_of(const dynamics::SceneChange& change, const dynamics::Simulation& now) {
  Arrivals arrivals{std::vector<bool>(now.state().size(), true),
                    std::vector<bool>(now.planes().size(), true)};
  for (const std::int32_t node : change.places.nodes)
    if (node >= 0) arrivals.nodes[static_cast<std::size_t>(node)] = false;
  for (const std::int32_t plane : change.places.planes) {
    if (plane < 0) continue;
    const auto i = static_cast<std::size_t>(plane);
    arrivals.planes[i] = !change.moved_planes.empty() && change.moved_planes[i];
  }
  return arrivals;
}

/// Contacts of what comes with a stage, and of grains with planes that come or are moved by it: what
/// was there before may be as deep in each other as it has been pressed.
bool is_of_new(const contact::ContactRecord& row, const Arrivals& arrivals,
               const dynamics::Simulation& now) {
  if (row.b.kind != contact::BodyKind::plane)
    return arrivals.has(row.a, now) || arrivals.has(row.b, now);
  return arrivals.has(row.a, now) || (row.a.kind == contact::BodyKind::sphere &&
                                      arrivals.planes[static_cast<std::size_t>(row.b.index)]);
}

std::vector<contact::ContactRecord> contacts_of_new(const Arrivals& arrivals,
                                                    dynamics::Simulation& now) {
  if (!arrivals.are_any()) return {};
  return now.next_contact_rows(
      [&](const contact::ContactRecord& row) { return is_of_new(row, arrivals, now); });
}

bool takes_all(const RemovalSettings& removal) {
  return !std::isfinite(removal.above) && !std::isfinite(removal.below) && !removal.box;
}

/// Whether the stage moves a plane.
bool moves(const Scenario& stage, std::size_t plane) {
  if (!stage.planes[plane].velocity.isZero(0.0)) return true;
  return std::ranges::any_of(stage.loads, [&](const LoadSettings& load) {
    const auto* const motion = std::get_if<dynamics::PlaneMotion>(&load.load);
    const auto* const servo = std::get_if<dynamics::PlaneServo>(&load.load);
    return (motion != nullptr && motion->plane == plane) ||
           (servo != nullptr && servo->plane == plane);
  });
}

/// What drives a plane that the stage places elsewhere goes on from there.
void move_starts(const Scenario& now, const dynamics::Simulation& before, StageBodies& bodies) {
  const StageOrigins& origins = now.stage->origins;
  for (std::size_t i = 0; i < now.planes.size(); ++i) {
    if (origins.planes[i] < 0 || !origins.says_point[i]) continue;
    const auto then = static_cast<std::size_t>(origins.planes[i]);
    const Vec3 way = now.planes[i].point - before.planes()[then].point;
    for (StageStart& start : bodies.starts) start.planes[then] += way;
  }
}

/// Grains of a table in the scene of before, and which of them stay.
struct GrainsOfTable {
  std::vector<geometry::NodeId> nodes;
  std::vector<bool> stays;
};

GrainsOfTable grains_of(std::size_t table, const PreparedRun& before,
                        const std::vector<std::int32_t>& nodes_now) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < table; ++i) first += before.built.grains[i].count;
  GrainsOfTable grains;
  for (std::size_t i = 0; i < before.built.grains[table].count; ++i) {
    const auto& sphere = before.simulation->elements().spheres[first + i];
    grains.nodes.push_back(sphere.nodes[0]);
    grains.stays.push_back(nodes_now[index_of(sphere.nodes[0])] >= 0);
  }
  return grains;
}

/// Whether all grains go that were the side of their table, though not all of the table.
/// @param places  m, by node, when they were that
bool loses_side(SetWhich side, const GrainsOfTable& grains, const std::vector<Vec3>& places) {
  if (grains.nodes.empty()) return false;
  const geometry::Box box = box_of_side(side, grains.nodes, places);
  bool is_any_left = false;
  for (std::size_t i = 0; i < grains.nodes.size(); ++i) {
    if (!grains.stays[i]) continue;
    if (is_within(box, places[index_of(grains.nodes[i])])) return false;
    is_any_left = true;
  }
  return is_any_left;
}

const NodeSetSettings* nodes_of(const LoadSettings& settings) {
  return std::visit(
      [](const auto& load) -> const NodeSetSettings* {
        if constexpr (requires { load.nodes.of_grains; }) return &load.nodes;
        return nullptr;
      },
      settings.load);
}

/// Loads and reactions of earlier stages keep to the grains that they began with: the next ones
/// would become the side that they name.
void require_sides(const Scenario& stage, const PreparedRun& before,
                   const std::vector<std::int32_t>& nodes_now) {
  const auto require = [&](const NodeSetSettings& set, std::size_t origin,
                           const std::string& path) {
    const bool is_side = set.which >= SetWhich::x_min && set.which <= SetWhich::z_max;
    if (!set.of_grains || set.rigid_body || !is_side || origin >= stage.stage->number) return;
    if (!loses_side(set.which, grains_of(set.body, before, nodes_now),
                    before.bodies.starts[origin].positions))
      return;
    throw InputError(fmt::format(
        "{}: takes out all of the grains of \"{}\" that {} names by their side; take it out too, "
        "or name it in this stage, where it then begins with those that are left",
        stage.stage->path, stage.grains[set.body].name, path));
  };
  const StageOrigins& origins = stage.stage->origins;
  for (std::size_t i = 0; i < stage.loads.size(); ++i)
    if (const NodeSetSettings* const set = nodes_of(stage.loads[i]))
      require(*set, origins.loads[i], stage.loads[i].path);
  for (std::size_t i = 0; i < stage.output.reactions.size(); ++i) {
    const ReactionSettings& reaction = stage.output.reactions[i];
    if (reaction.kind != ReactionKind::plane)
      require(reaction.nodes, origins.reactions[i], reaction.path);
  }
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
  KeptBodies kept = kept_bodies(stage, before);
  dynamics::Simulation& ended = *before.simulation;
  const Scenario now = with_planes_of_now(stage, ended);
  require_sides(now, before, kept.nodes());
  move_starts(now, ended, kept.bodies());
  StageBegin begin;
  PreparedRun& next = begin.prepared;
  next.bodies = std::move(kept.bodies());
  next.built = begin_stage(now, next.bodies, kept.positions(), ended.time(), hear);
  contact::BodyPlaces places;
  places.nodes = kept.nodes();
  places.spheres = sphere_places(places.nodes, ended, next.built.scene);
  if (hear) hear("looking for contacts", 0.0);
  next.simulation = simulation_of(now, next.built);
  next.duration = stage.simulation.duration;
  try {
    if (stage.stage->origins.changes_nothing && !moves_planes(now, ended)) {
      next.simulation->restore(ended.snapshot());
    } else {
      const dynamics::SceneChange change =
          change_to(stage.stage->origins, places, ended, next.simulation->scene());
      next.simulation->go_on_from(ended, change);
      require_possible_start(initial_contacts(now, next.built, *next.simulation,
                                              contacts_of_new(arrivals_of(change, *next.simulation),
                                                              *next.simulation)),
                             now);
      require_something_free(stage, *next.simulation);
      choose_time_step(stage, *next.simulation);
    }
  } catch (const geometry::StateMismatch& error) {
    throw InputError(fmt::format("{}: {}", stage.stage->path, error.what()));
  }
  begin.run = run_state(state, places, *next.simulation);
  return begin;
}

StagesAhead::StagesAhead(const Scenario& first, const BuiltScene& built)
    : bodies_(first_stage(built)), positions_(built.scene.state.position) {
  for (std::size_t i = 0; i < first.planes.size(); ++i) has_stayed_.push_back(!moves(first, i));
}

StageAhead StagesAhead::next(const Scenario& stage, const HearSetUp& hear) {
  KeptBodies kept(
      bodies_, tables_of_grains(stage), positions_, [&](std::size_t table, const Vec3&) {
        return std::ranges::any_of(stage.stage->removals, [&](const RemovalSettings& removal) {
          return removal.grains == table && takes_all(removal);
        });
      });
  bodies_ = std::move(kept.bodies());
  positions_ = std::move(kept.positions());
  const std::size_t nodes_before = positions_.size();
  const std::vector<bool> was_absent = bodies_.is_absent;
  StageAhead ahead;
  ahead.built = try_stage(stage, bodies_, positions_, hear);
  ahead.warnings = ahead.built.warnings;
  ahead.simulation = simulation_of(stage, ahead.built);
  for (std::string& warning : warnings_about_solids(stage, ahead.built, ahead.simulation->scene()))
    ahead.warnings.push_back(std::move(warning));
  find_planes(stage);
  look_at_arrivals(stage, nodes_before, was_absent, ahead);
  for (std::size_t i = 0; i < has_stayed_.size(); ++i)
    has_stayed_[i] = has_stayed_[i] && !moves(stage, i);
  return ahead;
}

void StagesAhead::find_planes(const Scenario& stage) {
  const StageOrigins& origins = stage.stage->origins;
  const auto is_placed = [&](std::size_t i) {
    return origins.says_point[i] && (stage.planes[i].is_flat() || origins.says_radius[i]);
  };
  const std::vector<bool> before = std::exchange(has_stayed_, {});
  for (std::size_t i = 0; i < stage.planes.size(); ++i)
    has_stayed_.push_back(origins.planes[i] < 0 || is_placed(i) ||
                          before[static_cast<std::size_t>(origins.planes[i])]);
}

/// Nobody knows where the grains of earlier stages will be; other bodies may have moved.
void StagesAhead::look_at_arrivals(const Scenario& stage, std::size_t nodes_before,
                                   const std::vector<bool>& was_absent, StageAhead& ahead) const {
  using contact::BodyKind;
  const dynamics::Simulation& now = *ahead.simulation;
  Arrivals arrivals{std::vector<bool>(positions_.size(), true),
                    std::vector<bool>(stage.planes.size(), false)};
  for (std::size_t node = 0; node < nodes_before; ++node)
    arrivals.nodes[node] = node < was_absent.size() && was_absent[node] &&
                           now.scene().is_there(geometry::id_at<geometry::NodeId>(node));
  if (!arrivals.are_any()) return;
  const auto is_known = [&](const contact::ContactBody& body) {
    return body.kind == BodyKind::plane ? bool{has_stayed_[static_cast<std::size_t>(body.index)]}
                                        : arrivals.has(body, now);
  };
  const auto is_old_grain = [&](const contact::ContactBody& body) {
    return body.kind == BodyKind::sphere && !arrivals.has(body, now);
  };
  std::vector<contact::ContactRecord> known, doubtful;
  for (const contact::ContactRecord& row : ahead.simulation->contact_rows()) {
    if (!is_of_new(row, arrivals, now)) continue;
    if (is_known(row.a) && is_known(row.b))
      known.push_back(row);
    else if (!is_old_grain(row.a) && !is_old_grain(row.b))
      doubtful.push_back(row);
  }
  require_possible_start(initial_contacts(stage, ahead.built, now, known), stage);
  const InitialContacts others = initial_contacts(stage, ahead.built, now, doubtful);
  for (const std::string& line : impossible_starts(others, stage).lines())
    ahead.warnings.push_back(line +
                             "; if it still is so when the stage begins, the run ends there");
}

}  // namespace plekton::apps

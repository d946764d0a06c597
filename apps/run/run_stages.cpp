// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_stages.hpp"

#include "apps/run/checkpoints.hpp"
#include "apps/run/run_state.hpp"
#include "apps/run/run_warnings.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <utility>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

Scenario scenario_in(const geometry::StateTree& state) {
  ScenarioText text;
  text.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  return parse_scenario(text.text, text.file, text.overrides);
}

template <class Table>
std::vector<std::string> names_of_tables(const std::vector<Table>& tables) {
  std::vector<std::string> names;
  for (const Table& table : tables) names.push_back(table.name);
  return names;
}

bool are_same_nodes(const NodeSetSettings& a, const NodeSetSettings& b) {
  return a.rigid_body == b.rigid_body && a.of_grains == b.of_grains && a.body == b.body &&
         a.which == b.which && a.box.lower == b.box.lower && a.box.upper == b.box.upper;
}

/// Whether the ties of both are between the same nodes.
bool tie_the_same(const TieSettings& a, const TieSettings& b) {
  return a.kind == b.kind && a.point == b.point && a.within == b.within &&
         are_same_nodes(a.from, b.from) && are_same_nodes(a.to, b.to);
}

/// Whether the grains of a table, or the spheres of a rigid body, are those of the other scenario.
bool are_same_grains(const Scenario& then, const Scenario& now, std::size_t table) {
  const GrainSettings& a = then.grains[table];
  const GrainSettings& b = now.grains[table];
  if (b.is_absent) return a.centres.size() == b.centres.size();  // It comes as this one says.
  return a.sizes == b.sizes && a.amount == b.amount && a.porosity == b.porosity &&
         a.stress == b.stress && a.centres == b.centres && a.radii == b.radii &&
         then.materials[a.material].density == now.materials[b.material].density;
}

/// Planes go on from where the run has left them, and as wide.
void require_same_planes(const Scenario& then, const Scenario& now) {
  const auto require = [&](bool holds, std::size_t i, const char* what) {
    if (holds) return;
    throw InputError(
        fmt::format("{}: {} has another {} than in the run that it is to go on from, which "
                    "has ended this "
                    "stage with it; leave it as it is there, or say another one in a later stage",
                    now.stage->path, now.planes[i].path(), what));
  };
  for (std::size_t i = 0; i < now.planes.size(); ++i) {
    const PlaneSettings &a = then.planes[i], &b = now.planes[i];
    require(a.form == b.form, i, "kind");
    require(a.point == b.point, i, "point");
    require(a.is_flat() || a.radius == b.radius, i, "radius");
  }
}

/// What goes on by its number has to be the same by its name, and of the same size.
void require_same_tables(const Scenario& then, const Scenario& now) {
  const auto require = [&](const char* what, const auto& before, const auto& after) {
    if (names_of_tables(before) == names_of_tables(after)) return;
    throw InputError(fmt::format(
        "{}: has other {} than the run that it is to go on from: there they are \"{}\", here "
        "\"{}\"; up to that stage they have to be the same",
        now.stage->path, what, fmt::join(names_of_tables(before), "\", \""),
        fmt::join(names_of_tables(after), "\", \"")));
  };
  require("grains", then.grains, now.grains);
  require("membranes", then.membranes, now.membranes);
  require("rigid bodies", then.rigid_bodies, now.rigid_bodies);
  require("planes", then.planes, now.planes);
  require_same_planes(then, now);
  require("ties", then.ties, now.ties);
  for (std::size_t i = 0; i < now.ties.size(); ++i) {
    if (tie_the_same(then.ties[i], now.ties[i])) continue;
    throw InputError(fmt::format(
        "{}: {} ties other nodes than in the run that it is to go on from; its from, to and within "
        "have to be the same",
        now.stage->path, now.ties[i].path));
  }
  for (std::size_t i = 0; i < now.grains.size(); ++i) {
    if (are_same_grains(then, now, i)) continue;
    throw InputError(fmt::format(
        "{}: {}.{} has other sizes, numbers or density than in the run that it is to go on from, "
        "which has made these grains; leave its keys, and those of its material, as they are there",
        now.stage->path, now.grains[i].rigid_body ? "rigid_bodies" : "grains", now.grains[i].name));
  }
}

/// The masses of membranes and rigid bodies that are there are those of the state.
void require_same_masses(const Scenario& then, const Scenario& now) {
  const auto refuse = [&](const std::string& path) {
    throw InputError(
        fmt::format("{}: {} has another mass, density or inertia than in the run that it is to go "
                    "on from; leave "
                    "these keys, and those of its material, as they are there",
                    now.stage->path, path));
  };
  const auto density_of = [](const Scenario& scenario, std::size_t material) {
    return scenario.materials[material].density;
  };
  for (std::size_t i = 0; i < now.membranes.size(); ++i) {
    const MembraneSettings &a = then.membranes[i], &b = now.membranes[i];
    if (b.is_absent) continue;  // it comes as this one says; surfaces of rigid bodies have no mass
    if (a.mass_mode != b.mass_mode || a.density != b.density || a.areal_mass != b.areal_mass)
      refuse("membranes." + b.name);
  }
  for (std::size_t i = 0; i < now.rigid_bodies.size(); ++i) {
    const RigidBodySettings &a = then.rigid_bodies[i], &b = now.rigid_bodies[i];
    if (b.is_absent) continue;
    const bool is_same_material =
        !b.membrane || density_of(then, then.membranes[*b.membrane].material) ==
                           density_of(now, now.membranes[*b.membrane].material);
    if (!is_same_material || a.mass != b.mass || a.density != b.density || a.inertia != b.inertia ||
        a.centre != b.centre || a.filling != b.filling)
      refuse(b.path);
  }
}

/// What has ended is what this scenario says it is.
void require_same_stages(const Scenario& then, const Scenario& now, const Scenario& ended) {
  for (std::size_t i = 0; i <= ended.stage->number; ++i) {
    const std::string& here = now.stages[i].stage->name;
    if (i < then.stages.size() && then.stages[i].stage->name == here) continue;
    throw InputError(fmt::format(
        "{}: stage {} is \"{}\" here and {} in the run that it is to go on from; the stages up to "
        "there have to be the same",
        ended.stage->path, i + 1, here,
        i < then.stages.size() ? fmt::format("\"{}\"", then.stages[i].stage->name) : "none"));
  }
}

bool are_same(const dynamics::TimeTable& a, const dynamics::TimeTable& b) {
  return std::ranges::equal(a.rows(), b.rows(), [](const auto& one, const auto& other) {
    return one.time == other.time && one.value == other.value;
  });
}

bool are_same(const std::optional<dynamics::AxisTurn>& a,
              const std::optional<dynamics::AxisTurn>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->point == b->point && a->axis == b->axis && a->angle == b->angle;
}

bool are_same(const dynamics::PlaneMotion& a, const dynamics::PlaneMotion& b) {
  return a.plane == b.plane && a.velocity == b.velocity && are_same(a.factor, b.factor);
}

bool are_same(const MotionSettings& a, const MotionSettings& b) {
  return are_same_nodes(a.nodes, b.nodes) && a.motion.held == b.motion.held &&
         a.motion.displacement == b.motion.displacement && a.motion.velocity == b.motion.velocity &&
         a.motion.angular_velocity == b.motion.angular_velocity &&
         are_same(a.motion.factor, b.motion.factor) && are_same(a.motion.turn, b.motion.turn);
}

/// Whether a load is no motion, or the same as one of the other scenario.
bool moves_the_same(const LoadSettings& now, const std::vector<LoadSettings>& then) {
  return std::visit(
      [&]<class Load>(const Load& load) {
        if constexpr (requires { are_same(load, load); })
          return std::ranges::any_of(then, [&](const LoadSettings& other) {
            const auto* const before = std::get_if<Load>(&other.load);
            return other.name == now.name && before != nullptr && are_same(*before, load);
          });
        return true;
      },
      now.load);
}

/// Places of what a motion moves count from where the motion began: with another one they would not
/// be where they are.
void require_same_motions(const Scenario& then, const Scenario& now) {
  for (const LoadSettings& load : now.loads) {
    if (moves_the_same(load, then.loads)) continue;
    throw InputError(
        fmt::format("{}: {} moves otherwise than in the run that it is to go on from, which has "
                    "ended this stage with it; leave it as it is there, or name it in a later "
                    "stage, where it then begins",
                    now.stage->path, load.path));
  }
}

/// The membranes and rigid bodies of a stage, as they are made.
BuiltScene surfaces_of(Scenario stage, const HearSetUp& hear) {
  std::erase_if(stage.grains, [](const GrainSettings& grains) { return !grains.rigid_body; });
  stage.ties.clear();
  return build_bodies(stage, {}, hear);
}

/// Where facets and bars of each membrane begin in a scene.
struct FirstElements {
  std::size_t facet = 0;
  std::size_t cylinder = 0;
};

template <class Element>
bool are_same(const std::vector<Element>& a, const std::vector<Element>& b, std::size_t first,
              std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i)
    if (a[i].nodes != b[i].nodes || a[i].radius != b[i].radius) return false;
  return true;
}

/// @param first  element of both, of membranes before which there is no other difference
bool are_same_surfaces(const BuiltScene& then, const BuiltScene& now, std::size_t membrane,
                       const FirstElements& first) {
  const BuiltMembrane& a = then.membranes[membrane];
  const BuiltMembrane& b = now.membranes[membrane];
  // One that is still to come does so as this scenario says: its number of nodes is known.
  if (!now.scene.is_there(geometry::id_at<geometry::NodeId>(b.first_node)))
    return a.nodes == b.nodes && a.facets == b.facets && a.cylinders == b.cylinders;
  if (a.nodes != b.nodes || a.facets != b.facets || a.cylinders != b.cylinders) return false;
  const auto points_of = [&](const BuiltScene& built) {
    return std::span(built.scene.state.position).subspan(a.first_node, a.nodes);
  };
  return std::ranges::equal(points_of(then), points_of(now)) &&
         are_same(then.scene.elements.facets, now.scene.elements.facets, first.facet, a.facets) &&
         are_same(then.scene.elements.cylinders, now.scene.elements.cylinders, first.cylinder,
                  a.cylinders);
}

/// @param thickness  m
std::string size_of(const BuiltMembrane& membrane, double thickness, const BuiltScene& built) {
  const Vec3& first = built.scene.state.position[membrane.first_node];
  return fmt::format(
      "{} nodes, the first at ({:.6g}, {:.6g}, {:.6g}) m, {} facets, {} bars, {:.6g} m thick",
      membrane.nodes, first[0], first[1], first[2], membrane.facets, membrane.cylinders, thickness);
}

/// @param now  the stage that has ended, as it is in the scenario that is to go on
void require_same_surfaces(const Scenario& then, const Scenario& now, const HearSetUp& hear) {
  if (now.membranes.empty()) return;
  const BuiltScene before = surfaces_of(then, hear), after = surfaces_of(now, hear);
  FirstElements first;
  for (std::size_t i = 0; i < after.membranes.size(); ++i) {
    const BuiltMembrane& membrane = after.membranes[i];
    if (!are_same_surfaces(before, after, i, first))
      throw InputError(fmt::format(
          "{}: {}.{} has another mesh, place or thickness than in the run that it is to go on "
          "from: "
          "there {}, here {}; leave its keys as they are there",
          now.stage->path, membrane.is_rigid ? "rigid_bodies" : "membranes", membrane.name,
          size_of(before.membranes[i], then.membranes[i].thickness, before),
          size_of(membrane, now.membranes[i].thickness, after)));
    first.facet += membrane.facets;
    first.cylinder += membrane.cylinders;
  }
}

/// @param fail  what is done before an error is thrown on: the stages before are told of
template <class Fail>
StageBegin begin_next(const Scenario& stage, PreparedRun& before, const geometry::StateTree& end,
                      const HearSetUp& hear, Fail&& fail) {
  try {
    return next_stage(stage, before, end, hear);
  } catch (const std::exception& error) {
    fail(error);
    throw;
  }
}

/// Name of the stage at whose end a state is; empty: at none.
std::string stage_ended_in(const geometry::StateTree& state) {
  const StageOfState of = stage_of(state);
  return of.has_ended ? scenario_in(state).stages.at(of.bodies.stage).stage->name : "";
}

/// @param ended    names of the stages of which there is one
/// @param damaged  what is wrong with checkpoints that cannot be read
[[noreturn]] void throw_no_end_of_stage(const fs::path& folder, const std::string& stage,
                                        const std::vector<std::string>& ended,
                                        const std::vector<std::string>& damaged) {
  std::string message = fmt::format(
      "{}: has no end of a stage \"{}\"; {}", folder.string(), stage,
      ended.empty() ? "it has none of any: plekton run of a scenario with [[stages]] writes them"
                    : fmt::format("it has those of \"{}\"", fmt::join(ended, "\", \"")));
  for (const std::string& problem : damaged) message += '\n' + problem;
  throw InputError(message);
}

}  // namespace

RunReport run_stages(const Scenario& scenario, PreparedRun first, const RunSettings& settings,
                     const StagesToRun& stages) {
  PreparedRun prepared = std::move(first);
  geometry::StateTree state;
  Resumption from{state, true, std::nullopt, true};
  std::optional<RunReport> before;
  while (true) {
    const Scenario& stage = scenario.stages[prepared.bodies.stage];
    if (stages.begins) stages.begins(stage, prepared);
    RunSettings of_stage = settings;
    geometry::StateTree end;
    of_stage.end_of_stage = &end;
    const std::size_t number = stage.stage->number;
    of_stage.has_next_stage = number < stages.last && !stage.stage->is_last;
    if (before) {
      of_stage.resume = &from;
      of_stage.stages_before = &*before;
    }
    before = run(stage, prepared, of_stage);
    const bool has_ended = before->status == RunStatus::finished && !before->ended_by.empty();
    if (!has_ended) return *before;
    if (stages.ends) stages.ends(stage, *before);
    if (!of_stage.has_next_stage) return *before;
    StageBegin next = begin_next(scenario.stages[number + 1], prepared, end, stages.hear,
                                 [&](const std::exception& error) {
                                   before->status = RunStatus::failed;
                                   before->message = error.what();
                                   add_warnings_to(*before);
                                   write_run_report(settings.out, *before);
                                 });
    prepared = std::move(next.prepared);
    state = std::move(next.run);
  }
}

geometry::StateTree end_of_stage(const fs::path& folder, const std::string& stage) {
  std::vector<fs::path> files = checkpoints_of(folder);
  std::vector<std::string> ended, damaged;
  for (; !files.empty(); files.pop_back()) {
    try {
      geometry::StateTree state = dynamics::read_checkpoint(files.back());
      const std::string name = stage_ended_in(state);
      if (name == stage) return state;
      if (!name.empty()) ended.push_back(name);
    } catch (const dynamics::CheckpointError& error) {
      damaged.emplace_back(error.what());
    }
  }
  std::reverse(ended.begin(), ended.end());
  throw_no_end_of_stage(folder, stage, ended, damaged);
}

bool is_same_but_for_output(const Scenario& scenario, const geometry::StateTree& state) {
  ScenarioText then;
  then.exchange(geometry::StateArchive::reader(state).group(kRunGroup));
  ScenarioText now = text_of(scenario);
  for (ScenarioText* const text : {&then, &now})
    std::erase_if(text->overrides,
                  [](const std::string& set) { return set.starts_with("output."); });
  return then.text == now.text && then.overrides == now.overrides;
}

PreparedRun ended_stage(const Scenario& scenario, const Scenario& stage,
                        const geometry::StateTree& state, const HearSetUp& hear) {
  const Scenario all = scenario_in(state);
  Scenario then = all.stages.at(stage_of(state).bodies.stage);
  require_same_stages(all, scenario, stage);
  require_same_tables(then, stage);
  require_same_masses(then, stage);
  require_same_motions(then, stage);
  require_same_surfaces(then, stage, hear);
  then.simulation.threads = scenario.simulation.threads;
  PreparedRun prepared = prepare_stage(then, state, hear);
  prepared.simulation->restore(state);
  return prepared;
}

}  // namespace plekton::apps

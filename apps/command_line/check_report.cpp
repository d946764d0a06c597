// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/check_report.hpp"

#include "apps/command_line/run_estimate.hpp"
#include "apps/command_line/start_listing.hpp"
#include "apps/command_line/step_advice.hpp"
#include "apps/run/enclosed_bodies.hpp"
#include "geometry/version.hpp"

#include <sstream>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Vec3& vector) {
  return {vector[0], vector[1], vector[2]};
}

Json membranes_of(const BuiltScene& built) {
  Json list = Json::array();
  for (const BuiltMembrane& membrane : built.membranes) {
    if (membrane.is_rigid) continue;
    list.push_back({{"name", membrane.name},
                    {"nodes", membrane.nodes},
                    {"held_nodes", membrane.held_nodes},
                    {"beams", membrane.beams},
                    {"facets", membrane.facets},
                    {"area_m2", membrane.area},
                    {"mass_kg", membrane.mass},
                    {"young_modulus_Pa", membrane.young_modulus},
                    {"mesh", membrane.report ? geometry::name_of(membrane.report->verdict)
                                             : std::string_view("generated")}});
  }
  return list;
}

Json grains_of(const BuiltScene& built) {
  Json list = Json::array();
  for (const BuiltGrains& grains : built.grains) {
    if (grains.is_rigid) continue;
    list.push_back({{"name", grains.name},
                    {"count", grains.count},
                    {"smallest_radius_m", grains.smallest},
                    {"largest_radius_m", grains.largest},
                    {"mass_kg", grains.mass}});
  }
  return list;
}

Json rigid_bodies_of(const BuiltScene& built) {
  Json list = Json::array();
  for (const BuiltRigidBody& body : built.rigid_bodies) {
    list.push_back({{"name", body.name},
                    {"mass_kg", body.mass.mass},
                    {"centre_m", list_of(body.mass.centre)},
                    {"principal_moments_kg_m2", list_of(body.moments)},
                    {"volume", body.volume},
                    {"free_axes", list_of(dynamics::free_axes(body.held))},
                    {"free_turns", list_of(dynamics::free_turns(body.held))}});
  }
  return list;
}

Json ties_of(const BuiltScene& built) {
  Json list = Json::array();
  for (const BuiltTies& ties : built.ties) {
    list.push_back({{"name", ties.name},
                    {"count", ties.count},
                    {"longest_gap_m", ties.longest_gap},
                    {"stiffness_N_per_m", {ties.softest, ties.stiffest}}});
  }
  return list;
}

Json boxes_of(const Scenario& scenario, const PreparedRun& prepared) {
  Json list = Json::array();
  for (const NamedBox& body : boxes_at_start(scenario, prepared)) {
    Json& json = list.emplace_back(Json{{"of", body.name},
                                        {"lower_m", list_of(body.box.lower)},
                                        {"upper_m", list_of(body.box.upper)}});
    if (!body.comes_in.empty()) json["comes_in"] = body.comes_in;
  }
  return list;
}

Json time_step_of(const Scenario& scenario, const PreparedRun& prepared) {
  const dynamics::Simulation& simulation = *prepared.simulation;
  return {{"time_step_s", simulation.time_step()},
          {"critical_s", simulation.critical_step().dt},  // null where nothing is stiff and free
          {"motion_ratio", simulation.motion_ratio()},
          {"advice", step_advice(scenario, prepared)}};
}

Json bonds_of(const Scenario& scenario, const InitialContacts& start) {
  Json list = Json::array();
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    const PairSettings& pair = scenario.contacts[i];
    if (!contact::bonds_of(pair.contact)) continue;
    list.push_back(
        {{"materials", {scenario.materials[pair.first].name, scenario.materials[pair.second].name}},
         {"count", start.bonds[i]}});
  }
  return list;
}

Json overlaps_of(const Scenario& scenario, const InitialContacts& start) {
  Json list = Json::array();
  for (const BodyOverlap& overlap : start.overlaps) {
    list.push_back({{"of", {name_of(overlap, 0, scenario), name_of(overlap, 1, scenario)}},
                    {"depth_m", overlap.depth},
                    {"ratio", overlap.ratio},
                    {"place_m", list_of(overlap.place)}});
  }
  return list;
}

Json enclosed_in(const PreparedRun& prepared) {
  Json list = Json::array();
  for (const EnclosedBody& body : enclosed_bodies(prepared.built, prepared.simulation->scene()))
    list.push_back({{"of", {body.name, body.in}}, {"inside", body.inside}, {"all", body.all}});
  return list;
}

Json estimate_of(const RunEstimate& estimate) {
  // Numbers that are not finite become null.
  Json json = {{"steps", {estimate.steps.low, estimate.steps.high}},
               {"frames", estimate.frames},
               {"timed_steps", estimate.timed_steps},
               {"wall_time_s", {estimate.wall_time.low, estimate.wall_time.high}},
               {"bytes", {estimate.bytes.low, estimate.bytes.high}}};
  if (!estimate.stage.empty()) json["stage"] = estimate.stage;
  if (!estimate.failure.empty()) json["failure"] = estimate.failure;
  return json;
}

}  // namespace

Json check_report(const Scenario& scenario, PreparedRun& prepared) {
  Json report = {{"plekton", kVersion},
                 {"scenario", scenario.file.string()},
                 {"problems", Json::array()},
                 {"warnings", prepared.built.warnings},
                 {"membranes", membranes_of(prepared.built)},
                 {"grains", grains_of(prepared.built)},
                 {"rigid_bodies", rigid_bodies_of(prepared.built)},
                 {"ties", ties_of(prepared.built)},
                 {"planes", prepared.simulation->planes().size()},
                 {"boxes", boxes_of(scenario, prepared)},
                 {"time_step", time_step_of(scenario, prepared)},
                 {"bonds", bonds_of(scenario, prepared.start)},
                 {"overlaps", overlaps_of(scenario, prepared.start)},
                 {"inside", enclosed_in(prepared)}};
  // Last, since it moves the simulation on.
  report["estimate"] = estimate_of(estimate_run(scenario, prepared));
  return report;
}

Json check_report(const std::string& message) {
  std::vector<std::string> problems;
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(' ') && !problems.empty())
      problems.back() += '\n' + line;
    else
      problems.push_back(line);
  }
  return {{"plekton", kVersion}, {"problems", problems}};
}

}  // namespace plekton::apps

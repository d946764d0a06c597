// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_report.hpp"

#include "apps/run/build_info.hpp"
#include "apps/run/run_warnings.hpp"
#include "dynamics/output/file.hpp"
#include "geometry/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

using Json = nlohmann::ordered_json;

Json options_of(const RunReport& report) {
  return {{"scenario", report.scenario},
          {"set", report.overrides},
          {"duration_s", report.duration ? Json(*report.duration) : Json()},
          {"threads", report.threads},
          {"ranks", report.ranks},
          {"seed", report.seed},
          {"damping", report.damping}};
}

Json names_of(const TableNames& names) {
  return {{"materials", names.materials},
          {"grains", names.grains},
          {"membranes", names.membranes},
          {"planes", names.planes}};
}

Json overlap_of(const DeepestOverlap& overlap) {
  const Vec3& x = overlap.place;
  return {{"of", {overlap.a, overlap.b}},
          {"depth_m", overlap.depth},
          {"ratio", overlap.ratio},
          {"place_m", {x[0], x[1], x[2]}},
          {"time_s", overlap.time}};
}

Json counts_of(const RunReport& report) {
  return {{"grains", report.grains},
          {"nodes", report.nodes},
          {"facets", report.facets},
          {"cylinders", report.cylinders},
          {"bonds", report.bonds},
          {"planes", report.planes},
          {"broken_bonds", report.broken_bonds},
          {"torn_facets", report.torn_facets},
          {"ties", report.ties},
          {"broken_ties", report.broken_ties},
          {"contacts", report.contacts},
          {"frames", report.frames}};
}

Json timing_of(const RunReport& report) {
  return {{"simulated_time_s", report.simulated_time}, {"steps", report.steps},
          {"time_step_s", report.time_step},           {"start_up_s", report.start_up_time},
          {"wall_time_s", report.wall_time},           {"output_s", report.output_time},
          {"ms_per_step", ms_per_step(report)}};
}

Json energy_of(const dynamics::Energy& energy) {
  return {{"kinetic_J", energy.kinetic},           {"contact_elastic_J", energy.contact_elastic},
          {"bond_elastic_J", energy.bond_elastic}, {"sheet_elastic_J", energy.sheet_elastic},
          {"gravity_J", energy.gravity},           {"friction_J", energy.friction},
          {"tracking_J", energy.tracking},         {"bond_dissipated_J", energy.bond_dissipated},
          {"damping_J", energy.damping},           {"external_work_J", energy.external_work},
          {"initial_J", energy.initial},           {"closure_error_J", energy.closure_error()},
          {"turnover_J", energy.turnover()}};
}

Json exact_decisions_of(const RunReport& report) {
  const geometry::SignCounters& counters = report.exact_decisions;
  return {{"double_double", counters.double_double},
          {"interval", counters.interval},
          {"exact", counters.exact},
          {"exact_per_node_and_step", exact_decisions_per_node(report)}};
}

Json json_of(const std::vector<Check>& certificate) {
  Json rows = Json::array();
  for (const Check& check : certificate) {
    rows.push_back({{"name", check.name},
                    {"value", check.text.empty() ? Json(check.value) : Json(check.text)},
                    {"limit", check.limit},  // null where there is none
                    {"verdict", check.is_red() ? "red" : "green"}});
    if (!check.advice.empty()) rows.back()["advice"] = check.advice;
  }
  return rows;
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

Json states_of(const StateHashes& states) {
  Json hashes = Json::array();
  for (const StateHash& state : states.all())
    hashes.push_back({state.step, state.time, hash_text(state.hash)});
  return {{"interval_steps", states.interval()},
          {"chain", hash_text(states.chain())},
          {"step_time_hash", std::move(hashes)}};
}

}  // namespace

std::string_view name_of(RunStatus status) noexcept {
  constexpr std::array<std::string_view, 4> kNames = {"finished", "at_rest", "interrupted",
                                                      "failed"};
  return kNames[static_cast<std::size_t>(status)];
}

TableNames names_of(const Scenario& scenario) {
  TableNames names;
  for (const MaterialSettings& material : scenario.materials)
    names.materials.push_back(material.name);
  for (const GrainSettings& grains : scenario.grains) names.grains.push_back(grains.name);
  for (const MembraneSettings& membrane : scenario.membranes)
    names.membranes.push_back(membrane.name);
  if (scenario.stage)
    names.planes = scenario.names_of_stages.planes;
  else
    for (const PlaneSettings& plane : scenario.planes) names.planes.push_back(plane.name);
  return names;
}

std::string to_json(const RunReport& report) {
  const BuildInfo build = build_info();
  Json json = {{"plekton", kVersion},
               {"revision", build.revision},
               {"compiler", build.compiler},
               {"vector_width", report.vector_width},
               {"date", report.date},
               {"host", report.host},
               {"status", name_of(report.status)},
               {"interrupted", report.status == RunStatus::interrupted}};
  if (!report.message.empty()) json["message"] = report.message;
  if (!report.stopped_by.empty()) json["stopped_by"] = report.stopped_by;
  json["options"] = options_of(report);
  if (report.resumed) json["resumed_s"] = *report.resumed;
  json["names"] = names_of(report.names);
  json["counts"] = counts_of(report);
  json["timing"] = timing_of(report);
  json["largest_overlap_ratio"] = report.largest_overlap_ratio;
  if (report.deepest_overlap) json["deepest_overlap"] = overlap_of(*report.deepest_overlap);
  json["pass_throughs"] = report.pass_throughs;
  json["most_crossings"] = report.most_crossings;
  json["dt_over_critical"] = report.dt_over_critical;
  json["largest_motion_ratio"] = report.largest_motion_ratio;
  json["energy_closure"] = report.energy_closure;
  json["tracking_ratio"] = report.tracking_ratio;
  json["energy"] = energy_of(report.energy);
  json["lost_grains"] = report.lost_grains;
  json["lost"] = {{"through_membranes", report.lost_through_membranes},
                  {"out_of_bounds", report.lost_out_of_bounds}};
  json["momentum_drift"] = {{"linear", report.momentum.linear},
                            {"angular", report.momentum.angular}};
  json["exact_decisions"] = exact_decisions_of(report);
  json["certificate"] = json_of(certificate_of(report));
  json["states"] = states_of(report.states);
  if (!report.stages.empty()) {
    json["stages"] = Json::array();
    for (const std::string& stage : report.stages) json["stages"].push_back(Json::parse(stage));
  }
  json["warnings"] = report.warnings;
  // A path need not be UTF-8; what is not becomes a replacement character.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string to_json(const EndedStage& stage, const RunReport& report) {
  const Json json = {{"name", stage.name},
                     {"ended_by", stage.ended_by},
                     {"start_s", stage.start},
                     {"end_s", report.simulated_time},
                     {"steps_so_far", report.steps},
                     {"grains", report.grains},
                     {"planes", report.planes},
                     {"contacts", report.contacts},
                     {"energy", energy_of(report.energy)},
                     {"certificate", json_of(certificate_of_motion(report))}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_run_report(const std::filesystem::path& folder, const RunReport& report) {
  dynamics::OutputFile file(folder / "run.json");
  file.write(to_json(report));
  file.commit();
}

void remove_report(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::remove(folder / "run.json", ignored);
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/summary.hpp"

#include "apps/run/run_warnings.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "geometry/mesh/repair/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

std::string line_of(const BuiltMembrane& m) {
  return fmt::format(
      "membrane {}: {} nodes ({} held), {} beams, {} facets, {}mass {:.4g} kg, {} "
      "of E = {:.4g} Pa; {}\n",
      m.name, m.nodes, m.held_nodes, m.beams, m.facets,
      m.area > 0.0 ? fmt::format("area {:.4g} m2, ", m.area) : "", m.mass,
      m.beams > 0 ? "beams" : "sheet", m.young_modulus,
      m.report ? fmt::format("mesh {}", geometry::name_of(m.report->verdict)) : "generated");
}

std::string line_of(const BuiltGrains& g) {
  return fmt::format("grains {}: {} of {:.4g} to {:.4g} m radius, mass {:.4g} kg\n", g.name,
                     g.count, g.smallest, g.largest, g.mass);
}

/// "x, y" of the axes along or about which something is free.
std::string axes_of(const Vec3& free) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (free[axis] > 0.0) text += std::string(text.empty() ? "" : ", ") + "xyz"[axis];
  }
  return text.empty() ? "nothing" : text;
}

/// Along and about what it is free, or when it comes.
std::string freedom_of(const BuiltRigidBody& body, const Scenario& scenario, std::size_t stage) {
  if (!body.is_absent)
    return fmt::format("free along {}, about {}", axes_of(dynamics::free_axes(body.held)),
                       axes_of(dynamics::free_turns(body.held)));
  const std::string name = stage_that_brings(scenario, &Scenario::rigid_bodies, body.table, stage);
  return name.empty() ? "not there any more" : "comes in stage " + name;
}

/// @param stage  its number, where there are some
std::string line_of(const BuiltRigidBody& body, const Scenario& scenario, std::size_t stage) {
  const Vec3& centre = body.mass.centre;
  return fmt::format(
      "rigid body {}: mass {:.4g} kg, centre ({:.4g}, {:.4g}, {:.4g}) m, principal moments of "
      "inertia {:.4g}, {:.4g}, {:.4g} kg m2, {}; {}\n",
      body.name, body.mass.mass, centre[0], centre[1], centre[2], body.moments[0], body.moments[1],
      body.moments[2], body.volume, freedom_of(body, scenario, stage));
}

std::string line_of(const BuiltTies& ties) {
  if (ties.count == 0) return fmt::format("ties {}: none\n", ties.name);
  const std::string stiffness = ties.softest < ties.stiffest
                                    ? fmt::format("{:.3g} to {:.3g}", ties.softest, ties.stiffest)
                                    : fmt::format("{:.3g}", ties.softest);
  return fmt::format("ties {}: {}, longest gap at the start {:.4g} m, {} N/m\n", ties.name,
                     ties.count, ties.longest_gap, stiffness);
}

/// The time step at the start, the critical one with all contacts that may come, and what limits
/// the step where that is not what is stiff. A chosen step follows what touches, and may be longer
/// until more does.
std::string line_of_step(const PreparedRun& prepared, bool is_stage) {
  const dynamics::Simulation& simulation = *prepared.simulation;
  const double dt = simulation.time_step();
  const double ratio = simulation.motion_ratio();
  return fmt::format(
      "time step: {:.4g} s{}; critical with all contacts that may come: {:.4g} s; {:.0f} steps "
      "in {} at this one{}\n",
      dt, simulation.chooses_time_step() ? " to begin with, for what touches now" : "",
      simulation.critical_step().dt, std::ceil(prepared.duration / dt),
      is_stage ? "this stage at the most" : "all",
      ratio > 0.9 * dynamics::kLargestMotion
          ? fmt::format("; something moves by {:.3g} % of the smallest radius in each",
                        100.0 * ratio)
          : "");
}

/// Short times with their digits, long ones in minutes and hours.
std::string wall_text(double seconds) {
  return seconds < 60.0 ? fmt::format("{:.3g} s", seconds) : duration_text(seconds);
}

}  // namespace

std::string summary_of(const Scenario& scenario, const PreparedRun& prepared) {
  std::string text;
  for (const BuiltMembrane& membrane : prepared.built.membranes)
    if (!membrane.is_rigid) text += line_of(membrane);
  for (const BuiltGrains& grains : prepared.built.grains)
    if (!grains.is_rigid) text += line_of(grains);
  for (const BuiltRigidBody& body : prepared.built.rigid_bodies)
    text += line_of(body, scenario, prepared.bodies.stage);
  for (const BuiltTies& ties : prepared.built.ties) text += line_of(ties);
  if (!prepared.simulation->planes().empty())
    text += fmt::format("planes: {}\n", prepared.simulation->planes().size());
  text += line_of_step(prepared, scenario.stage.has_value());
  for (const std::string& warning : prepared.built.warnings) text += "warning: " + warning + '\n';
  return text;
}

std::string summary_of(const dynamics::ExactStep& step) {
  if (!std::isfinite(step.dt))
    return "critical step by power iteration: none; nothing is stiff and free as the scene is "
           "now\n";
  return fmt::format(
      "critical step by power iteration: {:.4g} s (to {:.1g} %, {} products), of the scene as it "
      "is "
      "now: with its {} contacts of grains and planes, those between membranes by bounds at their "
      "nodes (not counted), and none that may come\n",
      step.dt, 100.0 * step.error, step.products, step.contacts);
}

std::string summary_of(const RunReport& report) {
  std::string text = fmt::format("{} at {:.4g} s after {} steps in {} ({:.3g} ms each)\n",
                                 name_of(report.status), report.simulated_time, report.steps,
                                 wall_text(report.wall_time), ms_per_step(report));
  text += fmt::format(
      "contacts {}, largest overlap {:.3g} % of the radius, energy closure {:.2g} %, lost grains "
      "{}\n",
      report.contacts, 100.0 * report.largest_overlap_ratio, 100.0 * report.energy_closure,
      report.lost_grains);
  const geometry::SignCounters& decisions = report.exact_decisions;
  text += fmt::format("momentum drift {:.2g}\n",
                      std::max(report.momentum.linear, report.momentum.angular));
  text += fmt::format(
      "decisions beyond doubles: {} by pairs, {} by intervals, {} exact ({:.2g} a node and step)\n",
      decisions.double_double, decisions.interval, decisions.exact,
      exact_decisions_per_node(report));
  if (report.broken_bonds > 0)
    text += fmt::format("broken bonds: {} of {}\n", report.broken_bonds, report.bonds);
  if (report.broken_ties > 0)
    text += fmt::format("broken ties: {} of {}\n", report.broken_ties, report.ties);
  if (report.torn_facets > 0) text += fmt::format("torn facets: {}\n", report.torn_facets);
  text += fmt::format("state hashes {}, chain {:016x}\n", report.states.all().size(),
                      report.states.chain());
  for (const std::string& warning : report.warnings) text += "warning: " + warning + '\n';
  return text + summary_of(certificate_of(report)) + '\n';
}

}  // namespace plekton::apps

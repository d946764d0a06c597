// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace plekton::apps {
namespace {

constexpr double kServoTolerance = 0.02;

/// The planes that a list of two names, whichever way they face.
std::array<std::size_t, 2> read_two_planes(Section& section, const Scenario& scenario) {
  const std::vector<std::string> names = section.texts("between");
  std::array<std::size_t, 2> planes{};
  if (names.size() != 2) {
    if (!names.empty())
      section.complain("between",
                       fmt::format("got {} names; expected those of two planes", names.size()));
    return planes;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = std::find_if(scenario.planes.begin(), scenario.planes.end(),
                                    [&](const PlaneSettings& p) { return p.name == names[i]; });
    if (found == scenario.planes.end())
      section.complain("between", fmt::format("there is no plane \"{}\" in this stage", names[i]));
    else
      planes[i] = static_cast<std::size_t>(found - scenario.planes.begin());
  }
  return planes;
}

ServoEnd read_servo_end(Section section, const Scenario& scenario) {
  ServoEnd end;
  end.load = section.text("load");
  end.tolerance = section.quantity("tolerance", {kNumber, kPositive}, kServoTolerance);
  section.finish();
  for (const LoadSettings& load : scenario.loads) {
    const auto* const servo = std::get_if<dynamics::PlaneServo>(&load.load);
    if (load.name != end.load || servo == nullptr) continue;
    end.plane = servo->plane;
    return end;
  }
  if (!end.load.empty())
    section.complain(
        "load", fmt::format("there is no load \"{}\" of kind \"servo\" in this stage", end.load));
  return end;
}

StageEnd read_end(Section section, const Scenario& scenario) {
  StageEnd end;
  if (section.has("duration")) end.duration = section.quantity("duration", {kTime, kPositive});
  if (section.has("kinetic_energy"))
    end.kinetic_energy = section.quantity("kinetic_energy", {kEnergy, kPositive});
  if (section.has("unbalanced_force"))
    end.unbalanced_force = section.quantity("unbalanced_force", {kNumber, kPositive});
  if (const auto servo = section.optional_table("servo"))
    end.servo = read_servo_end(*servo, scenario);
  if (auto table = section.optional_table("displacement")) {
    end.displacement = {read_plane_name(*table, scenario).value_or(0),
                        table->quantity("distance", {kLength, kPositive})};
    table->finish();
  }
  if (auto table = section.optional_table("strain")) {
    end.strain = {read_two_planes(*table, scenario),
                  table->quantity("strain", {kNumber, kPositive})};
    table->finish();
  }
  if (section.has("after")) end.after = section.quantity("after", {kTime, kNotNegative});
  section.finish();
  return end;
}

void require_end(Section& section, const StageSettings& stage) {
  const StageEnd& end = stage.end;
  const bool has_other =
      end.kinetic_energy || end.unbalanced_force || end.servo || end.displacement || end.strain;
  if (!end.duration && !has_other)
    section.complain("end",
                     "missing or empty; expected end = { duration = \"0.1 s\" } or one or more of "
                     "kinetic_energy, unbalanced_force, servo, displacement, strain");
  else if (!end.duration && !stage.max_duration)
    section.complain("max_duration",
                     "missing; expected the time after which the stage has failed, for its end may "
                     "never come; or a duration in its end");
  if (end.duration && stage.max_duration)
    section.complain("max_duration",
                     "has no meaning beside a duration in its end: the first of them ends it");
}

RemovalSettings read_removal(Section section, const Scenario& scenario) {
  RemovalSettings removal;
  const NodeSetSettings body = read_flexible_body(section, scenario);
  removal.grains = body.body;
  if (!body.of_grains && section.has("membrane"))
    section.complain("membrane",
                     "membranes stay in all stages; expected grains, a plane or a load");
  if (section.has("above")) removal.above = section.quantity("above", {kLength});
  if (section.has("below")) removal.below = section.quantity("below", {kLength});
  if (auto box = section.optional_table("box")) removal.box = read_box(*box);
  section.finish();
  return removal;
}

std::vector<NodeSetSettings> read_sets(Section& stage, std::string_view key,
                                       const Scenario& scenario) {
  std::vector<NodeSetSettings> sets;
  for (Section& section : stage.tables(key)) {
    sets.push_back(read_flexible_nodes(section, scenario));
    section.finish();
  }
  return sets;
}

}  // namespace

StageSettings read_stage(Section section, const Scenario& scenario) {
  StageSettings stage;
  stage.path = section.path();
  stage.place = section.place();
  stage.name = section.name("name");
  if (auto end = section.optional_table("end")) stage.end = read_end(*end, scenario);
  if (section.has("max_duration"))
    stage.max_duration = section.quantity("max_duration", {kTime, kPositive});
  require_end(section, stage);
  for (Section& removal : section.tables("remove"))
    stage.removals.push_back(read_removal(removal, scenario));
  stage.fixed = read_sets(section, "fix", scenario);
  stage.freed = read_sets(section, "free", scenario);
  section.finish();
  return stage;
}

}  // namespace plekton::apps

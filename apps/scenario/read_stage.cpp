// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace plekton::apps {
namespace {

constexpr double kServoTolerance = 0.02;

ServoEnd read_servo_end(Section section, const Scenario& scenario) {
  ServoEnd end;
  end.load = section.text("load");
  end.tolerance = section.quantity("tolerance", {kNumber, kPositive}, kServoTolerance);
  section.finish();
  std::size_t body_servos = 0;
  for (const LoadSettings& load : scenario.loads) {
    const auto* const servo = std::get_if<dynamics::PlaneServo>(&load.load);
    const bool drives_body = std::holds_alternative<BodyServoSettings>(load.load);
    if (load.name == end.load && (servo != nullptr || drives_body)) {
      if (servo != nullptr)
        end.plane = servo->plane;
      else
        end.body_servo = body_servos;
      return end;
    }
    if (drives_body) ++body_servos;
  }
  if (!end.load.empty())
    section.complain("load",
                     fmt::format("there is no load \"{}\" of kind \"servo\" here", end.load));
  return end;
}

DisplacementEnd read_displacement_end(Section& section, const Scenario& scenario) {
  DisplacementEnd end;
  if (section.has("plane"))
    end.plane = read_plane_name(section, scenario).value_or(0);
  else
    end.nodes = read_node_set(section, scenario);
  end.distance = section.quantity("distance", {kLength, kPositive});
  return end;
}

ForceEnd read_force_end(Section section, const Scenario& scenario) {
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  ForceEnd end;
  end.reaction = section.text("reaction");
  const auto& reactions = scenario.output.reactions;
  const bool is_there =
      std::any_of(reactions.begin(), reactions.end(),
                  [&](const ReactionSettings& one) { return one.name == end.reaction; });
  if (!end.reaction.empty() && !is_there)
    section.complain("reaction", fmt::format("there is no reaction \"{}\" here; expected one of "
                                             "[[output.reactions]]",
                                             end.reaction));
  end.axis = static_cast<int>(section.choice("component", kAxes));
  end.is_above = section.has("above");
  if (end.is_above) end.force = section.quantity("above", {kForce});
  if (section.has("below")) {
    if (end.is_above) section.complain("below", "got above and below; expected one of them");
    end.force = section.quantity("below", {kForce});
  } else if (!end.is_above) {
    section.complain("above", "missing; expected above or below, a force to be reached");
  }
  section.finish();
  return end;
}

constexpr std::string_view kConditions =
    "kinetic_energy, unbalanced_force, servo, displacement, strain, force";

bool has_condition(const StageEnd& end) {
  return end.kinetic_energy || end.unbalanced_force || end.servo || end.displacement ||
         end.strain || end.force;
}

/// All but a duration.
StageEnd read_conditions(Section& section, const Scenario& scenario) {
  StageEnd end;
  if (section.has("kinetic_energy"))
    end.kinetic_energy = section.quantity("kinetic_energy", {kEnergy, kPositive});
  if (section.has("unbalanced_force"))
    end.unbalanced_force = section.quantity("unbalanced_force", {kNumber, kPositive});
  if (const auto servo = section.optional_table("servo"))
    end.servo = read_servo_end(*servo, scenario);
  if (auto table = section.optional_table("displacement")) {
    end.displacement = read_displacement_end(*table, scenario);
    table->finish();
  }
  if (auto table = section.optional_table("strain")) {
    end.strain = read_two_bodies(*table, scenario);
    end.strain->strain = table->quantity("strain", {kNumber, kPositive});
    table->finish();
  }
  if (const auto table = section.optional_table("force"))
    end.force = read_force_end(*table, scenario);
  if (section.has("after")) end.after = section.quantity("after", {kTime, kNotNegative});
  return end;
}

StageEnd read_end(Section section, const Scenario& scenario) {
  StageEnd end = read_conditions(section, scenario);
  if (section.has("duration")) end.duration = section.quantity("duration", {kTime, kPositive});
  section.finish();
  return end;
}

void require_end(Section& section, const StageSettings& stage) {
  const StageEnd& end = stage.end;
  if (!end.duration && !has_condition(end))
    section.complain(
        "end", fmt::format("missing or empty; expected end = {{ duration = \"0.1 s\" }} or one "
                           "or more of {}",
                           kConditions));
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
                     "a membrane is taken out as a whole; expected { membrane = NAME }");
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
    sets.push_back(read_node_set(section, scenario));
    section.finish();
  }
  return sets;
}

}  // namespace

StageEnd read_stop(Section section, const Scenario& scenario) {
  if (section.has("duration"))
    section.complain("duration", "is that of the run, simulation.duration; leave it out here");
  StageEnd stop = read_conditions(section, scenario);
  section.finish();
  if (!has_condition(stop))
    section.complain("kinetic_energy",
                     fmt::format("missing; expected one or more of {}", kConditions));
  return stop;
}

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

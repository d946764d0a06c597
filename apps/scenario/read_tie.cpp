// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <array>

namespace plekton::apps {
namespace {

void refuse_same_body(Section& section, const Scenario& scenario, const NodeSetSettings& from,
                      const std::optional<std::size_t>& to) {
  if (!to || to != from.rigid_body) return;
  section.complain("rigid_body",
                   fmt::format("ties \"{}\" to itself; expected another body than that of from",
                               scenario.rigid_bodies[*to].name));
}

/// A rigid body that holds nodes where they are on it.
NodeSetSettings read_holder(Section& section, const Scenario& scenario,
                            const NodeSetSettings& from) {
  NodeSetSettings holder;
  holder.place = section.place_of("rigid_body");
  holder.rigid_body = read_rigid_body_name(section, scenario);
  refuse_same_body(section, scenario, from, holder.rigid_body);
  holder.rigid_body = holder.rigid_body.value_or(0);
  return holder;
}

void read_to(Section section, const Scenario& scenario, TieSettings& tie) {
  constexpr std::array<std::string_view, 6> kKinds = {"ground",  "point", "nodes",
                                                      "surface", "cable", "body"};
  const std::optional<std::size_t> kind = section.known_choice("kind", kKinds);
  if (!kind) return;
  tie.kind = static_cast<TieTo>(*kind);
  switch (tie.kind) {
    case TieTo::ground:
      break;
    case TieTo::point:
      tie.point = section.vector("place", {kLength});
      break;
    case TieTo::nodes:
      tie.to = read_tied_nodes(section, scenario);
      break;
    case TieTo::surface:
      tie.to = read_tied_body(section, scenario);
      refuse_same_body(section, scenario, tie.from, tie.to.rigid_body);
      break;
    case TieTo::cable:
      tie.to.place = section.place_of("membrane");
      tie.to.body = read_membrane_name(section, scenario).value_or(0);
      tie.friction = section.quantity("friction", {kNumber, kNotNegative}, 0.0);
      tie.slip_force = section.quantity("slip_force", {kForce, kNotNegative}, 0.0);
      break;
    case TieTo::body:
      tie.to = read_holder(section, scenario, tie.from);
      break;
  }
  section.finish();
}

void read_brake(Section section, TieSettings& tie) {
  tie.brake_force = section.quantity("force", {kForce, kPositive});
  tie.stroke = section.quantity("stroke", {kLength, kPositive});
  section.finish();
  if (tie.kind == TieTo::cable)
    section.complain("force",
                     "a tie that slides on a cable has no brake of its own; expected slip_force in "
                     "its `to`, the force at which it slides");
}

}  // namespace

TieSettings read_tie(Section section, const Scenario& scenario, std::size_t number) {
  TieSettings tie;
  section.tell_default("name", "ties N");
  tie.name = section.name("name", fmt::format("ties {}", number));
  tie.path = section.path();
  tie.place = section.place();
  if (auto from = section.table("from")) {
    tie.from = read_tied_nodes(*from, scenario);
    from->finish();
  } else if (!section.has("from")) {
    section.complain("from",
                     "missing; expected whose nodes are tied, as { membrane = NAME, nodes = "
                     "\"rim\" }");
  }
  tie.to_place = section.place_of("to");
  if (auto to = section.table("to"))
    read_to(*to, scenario, tie);
  else if (!section.has("to"))
    section.complain("to", "missing; expected to what they are tied, as { kind = \"ground\" }");
  if (section.has("within")) tie.within = section.quantity("within", {kLength, kPositive});
  section.tell_default("stiffness", "that of what is tied");
  if (section.has("stiffness"))
    tie.stiffness = section.quantity("stiffness", {kStiffness, kPositive});
  section.tell_default("rest_length", "the distance at the start");
  if (section.has("rest_length"))
    tie.rest_length = section.quantity("rest_length", {kLength, kNotNegative});
  tie.strength = section.quantity("strength", {kForce, kPositive}, tie.strength);
  if (auto brake = section.optional_table("brake")) read_brake(*brake, tie);
  const bool must_pull = tie.kind == TieTo::cable || tie.brake_force < dynamics::Tie::kNever;
  section.tell_default("only_pulls", "false; true on a cable and with a brake");
  tie.only_pulls = section.truth("only_pulls", must_pull);
  if (must_pull && !tie.only_pulls)
    section.complain("only_pulls", "got false, but on a cable and with a brake a tie only pulls");
  tie.each = section.truth("each", false);
  section.finish();
  return tie;
}

}  // namespace plekton::apps

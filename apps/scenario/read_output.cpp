// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_load_targets.hpp"
#include "apps/scenario/read_measure.hpp"
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plekton::apps {
namespace {

constexpr std::array<std::string_view, 5> kReactionKinds = {"plane", "support", "contacts", "nodes",
                                                            "section"};

/// All nodes of the body that the key `membrane` or `grains` names.
NodeSetSettings read_body(Section& section, const Scenario& scenario) {
  if (section.has("nodes"))
    section.complain("nodes",
                     "contacts are those of a whole body; for the supports of some nodes expected "
                     "kind = \"support\"");
  return read_whole_body(section, scenario);
}

/// The name of what a reaction is of, as it is written.
std::string name_of_target(Section& section, const ReactionSettings& reaction) {
  std::string_view key = "plane";
  if (reaction.kind != ReactionKind::plane) key = reaction.nodes.of_grains ? "grains" : "membrane";
  if (reaction.nodes.rigid_body) key = "rigid_body";
  return section.has(key) ? section.text(key) : "";
}

ReactionSettings read_reaction(Section section, const Scenario& scenario,
                               const std::vector<ReactionSettings>& earlier) {
  ReactionSettings reaction;
  reaction.path = section.path();
  section.tell_default("name", "that of its body");
  const std::string name = section.name("name", "");
  if (section.has("about")) reaction.about = section.vector("about", {kLength});
  const auto kind = section.known_choice("kind", kReactionKinds);
  if (!kind) return reaction;
  reaction.kind = static_cast<ReactionKind>(*kind);
  if (reaction.kind == ReactionKind::plane)
    reaction.plane = read_plane_name(section, scenario).value_or(0);
  if (reaction.kind == ReactionKind::support || reaction.kind == ReactionKind::nodes)
    reaction.nodes = read_node_set(section, scenario);
  if (reaction.kind == ReactionKind::contacts) reaction.nodes = read_body(section, scenario);
  if (reaction.kind == ReactionKind::section)
    reaction.nodes = read_membrane_nodes(section, scenario);
  reaction.name = name.empty() ? name_of_target(section, reaction) : name;
  const bool taken =
      std::any_of(earlier.begin(), earlier.end(), [&](const ReactionSettings& other) {
        return !reaction.name.empty() && other.name == reaction.name;
      });
  if (taken)
    section.complain("name",
                     fmt::format("\"{}\" is a reaction already, and names a column; expected "
                                 "a name of its own",
                                 reaction.name));
  section.finish();
  return reaction;
}

/// Between hashes of the state: few enough entries in run.json for any run, and no time to speak
/// of.
constexpr std::int64_t kHashInterval = 10000;
constexpr std::int64_t kLongestHashInterval = 1'000'000'000'000;

}  // namespace

OutputSettings read_output(Section section, const Scenario& scenario) {
  const double duration = scenario.simulation.duration;
  OutputSettings output;
  section.tell_default("interval", "duration / 100");
  section.tell_default("history_interval", "duration / 1000");
  section.tell_default("reactions_interval", "history_interval");
  output.interval = section.quantity("interval", {kTime, kPositive}, duration / 100.0);
  output.history_interval =
      section.quantity("history_interval", {kTime, kPositive}, duration / 1000.0);
  output.reactions_interval =
      section.quantity("reactions_interval", {kTime, kPositive}, output.history_interval);
  if (section.has("checkpoint_interval"))
    output.checkpoint_interval = section.quantity("checkpoint_interval", {kTime, kPositive});
  if (section.has("checkpoint_wall_interval"))
    output.checkpoint_wall_interval =
        section.quantity("checkpoint_wall_interval", {kTime, kPositive});
  output.hash_interval = section.integer("hash_interval", 1, kLongestHashInterval, kHashInterval);
  output.grains = section.truth("grains", output.grains);
  output.membranes = section.truth("membranes", output.membranes);
  output.contacts = section.truth("contacts", output.contacts);
  output.contact_list = section.truth("contact_list", output.contact_list);
  for (Section& reaction : section.tables("reactions"))
    output.reactions.push_back(read_reaction(reaction, scenario, output.reactions));
  for (Section& measure : section.tables("measures"))
    output.measures.push_back(read_measure(measure, scenario, output.measures));
  section.finish();
  return output;
}

}  // namespace plekton::apps

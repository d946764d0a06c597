// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/reactions.hpp"

#include "geometry/critical/product_features.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace plekton::apps {
namespace {

using dynamics::ForceAndMoment;
using geometry::index_of;

constexpr std::array<dynamics::OutputField, 3> kReactionFields = {{
    {"force", "N", "what the plane, the supports, the body, the nodes or the section bear"},
    {"moment", "N m", "about the point of the plane, the origin, or the point `about`"},
    {"position", "m", "of the point of the plane, or the mean of the nodes, at that time"},
}};

/// Numbers of a reaction in a row.
constexpr std::size_t kNumbers = 3 * kReactionFields.size();

/// The bodies that have some nodes. Structures come apart where bonds break, down to single nodes,
/// but nodes stay with their body.
class BodySet {
 public:
  BodySet(const BuiltReaction& reaction, const dynamics::Simulation& simulation)
      : simulation_(simulation), is_node_(simulation.state().size()) {
    for (const geometry::NodeId node : reaction.nodes) is_node_[index_of(node)] = true;
  }

  bool has(const contact::ContactBody& body) const {
    if (body.kind == contact::BodyKind::plane) return false;
    if (body.kind == contact::BodyKind::structure)
      return is_node_[index_of(nodes_of(simulation_.surface(), body.feature).ids[0])];
    const auto sphere = static_cast<std::size_t>(body.index);
    return is_node_[index_of(simulation_.elements().spheres[sphere].nodes[0])];
  }

 private:
  const dynamics::Simulation& simulation_;
  std::vector<bool> is_node_;
};

Vec3 about(const BuiltReaction& reaction) {
  return reaction.about.value_or(Vec3::Zero());
}

ForceAndMoment of_contacts(const BuiltReaction& reaction,
                           std::span<const contact::ContactRecord> contacts,
                           const dynamics::Simulation& simulation) {
  const BodySet bodies(reaction, simulation);
  return dynamics::contact_force_on(
      contacts, [&](const contact::ContactBody& body) { return bodies.has(body); },
      about(reaction));
}

/// Weight included; what is held bears it too.
ForceAndMoment on_nodes(const BuiltReaction& reaction, const dynamics::Simulation& simulation) {
  const std::vector<Vec3> positions = simulation.force_positions();
  const dynamics::NodeForces& forces = simulation.forces();
  ForceAndMoment sum;
  for (const geometry::NodeId node : reaction.nodes) {
    const std::size_t i = index_of(node);
    const Vec3 weight = simulation.properties().mass[i] * simulation.gravity();
    sum.add(positions[i] - about(reaction), forces.force[i] + weight, forces.torque[i]);
  }
  return sum;
}

ForceAndMoment on_plane(const BuiltReaction& reaction, const dynamics::Simulation& simulation) {
  const ForceAndMoment value = simulation.plane_reaction(reaction.plane);
  if (!reaction.about) return value;
  ForceAndMoment moved;
  moved.add(simulation.force_point(reaction.plane) - *reaction.about, value.force, value.moment);
  return moved;
}

/// m, where it was at the time of the forces.
Vec3 position_of(const BuiltReaction& reaction, const dynamics::Simulation& simulation) {
  if (reaction.kind == ReactionKind::plane) return simulation.force_point(reaction.plane);
  const std::vector<Vec3> positions = simulation.force_positions();
  Vec3 sum = Vec3::Zero();
  for (const geometry::NodeId node : reaction.nodes) sum += positions[index_of(node)];
  return sum / static_cast<double>(reaction.nodes.size());
}

}  // namespace

std::span<const dynamics::OutputField> reaction_fields() {
  return kReactionFields;
}

ReactionValue reaction_in(const dynamics::Simulation& simulation, const BuiltReaction& reaction,
                          std::span<const contact::ContactRecord> contacts) {
  ReactionValue result{{}, position_of(reaction, simulation)};
  if (reaction.kind == ReactionKind::plane) result.value = on_plane(reaction, simulation);
  if (reaction.kind == ReactionKind::support)
    result.value = simulation.support_reaction(reaction.nodes, about(reaction));
  if (reaction.kind == ReactionKind::section)
    result.value = simulation.section_force(reaction.nodes, about(reaction));
  if (reaction.kind == ReactionKind::nodes) result.value = on_nodes(reaction, simulation);
  if (reaction.kind == ReactionKind::contacts)
    result.value = of_contacts(reaction, contacts, simulation);
  return result;
}

Reactions::Reactions(const std::filesystem::path& folder,
                     const std::vector<BuiltReaction>& reactions,
                     const std::vector<std::string>& of_all_stages, const WrittenFiles* before)
    : reactions_(reactions), names_(of_all_stages) {
  if (names_.empty())
    for (const BuiltReaction& reaction : reactions_) names_.push_back(reaction.name);
  lists_contacts_ = std::any_of(reactions_.begin(), reactions_.end(), [](const auto& reaction) {
    return reaction.kind == ReactionKind::contacts;
  });
  HistoryColumns columns;
  for (const std::string& name : names_) columns.add_vectors(name, kReactionFields);
  open(folder, kReactionsFile, columns, before);
}

void Reactions::add(dynamics::Simulation& simulation) {
  std::vector<contact::ContactRecord> contacts;
  if (lists_contacts_) contacts = simulation.list_contacts();
  constexpr double kNotThere = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row(1 + kNumbers * names_.size(), kNotThere);
  row[0] = simulation.time();
  for (const BuiltReaction& reaction : reactions_) {
    const auto name = std::find(names_.begin(), names_.end(), reaction.name);
    double* const at = &row[1 + kNumbers * static_cast<std::size_t>(name - names_.begin())];
    const auto [value, position] = reaction_in(simulation, reaction, contacts);
    std::copy_n(value.force.data(), 3, at);
    std::copy_n(value.moment.data(), 3, at + 3);
    std::copy_n(position.data(), 3, at + 6);
  }
  add_row(row);
}

}  // namespace plekton::apps

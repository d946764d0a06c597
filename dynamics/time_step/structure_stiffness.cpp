// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/structure_stiffness.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::dynamics {

void StructureStiffness::find(const contact::Contacts& contacts, const NodeProperties& properties,
                              const StiffestMotion::Places& places, double moved) {
  rests_.clear();
  contacts.probe_structures(probe_);
  if (!probe_.touches()) return motion_.forget();
  find_parts(properties);
  double gone = moved + places.difference;
  // Steps in which cores cross are short, and looked at almost one by one: the motion is followed
  // over them.
  const int next = contacts.crossings() > 0 ? 1 : StiffestMotion::kProducts;
  for (int i = motion_.start(properties, next); i > 0; --i) {
    const bool moves =
        motion_.multiply(properties, places, [&](geometry::Positions at, NodeForces& forces) {
          probe_.add_forces(at, gone, forces);
          gone = 2.0 * places.difference;
        });
    if (!moves) break;
    motion_.follow(properties);
  }
  find_springs(contacts);
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (!motion_.has(i) || holds_translation(properties.held[i])) continue;
    const double more = motion_.rate(i) * properties.mass[i] - springs_[i];
    if (more > 0.0) rests_.push_back({geometry::id_at<NodeId>(i), more});
  }
}

void StructureStiffness::add_to(ContactSprings& springs) const {
  for (const Rest& rest : rests_) springs.add(rest.node, {rest.stiffness, 0.0});
}

std::uint32_t StructureStiffness::root_of(std::uint32_t node) noexcept {
  while (linked_[node] != node) node = linked_[node] = linked_[linked_[node]];
  return node;
}

/// Nodes that move and that a contact, or a chain of them, holds together. What comes to take part
/// besides is part 0.
void StructureStiffness::find_parts(const NodeProperties& properties) {
  motion_.begin(properties.size());
  linked_.resize(properties.size());
  std::iota(linked_.begin(), linked_.end(), 0U);
  probe_.for_each_pair([&](const geometry::FeatureNodes& a, const geometry::FeatureNodes& b) {
    std::uint32_t first = static_cast<std::uint32_t>(linked_.size());
    for (const auto* side : {&a, &b}) {
      for (const NodeId node : *side) {
        const std::size_t mover = index_of(rigid_->mover_of(node));
        if (holds_translation(properties.held[mover])) continue;
        motion_.add(mover);
        const std::uint32_t root = root_of(static_cast<std::uint32_t>(mover));
        if (first == linked_.size()) first = root;
        const std::uint32_t other = root_of(first);
        linked_[std::max(root, other)] = std::min(root, other);
      }
    }
  });
  std::uint32_t count = 1;
  for (std::uint32_t i = 0; i < linked_.size(); ++i) {
    if (!motion_.has(i)) continue;
    const std::uint32_t root = root_of(i);
    motion_.set_part(i, root == i ? count++ : motion_.part(root));
  }
  motion_.set_part_count(count);
}

void StructureStiffness::find_springs(const contact::Contacts& contacts) {
  springs_.assign(linked_.size(), 0.0);
  contacts.for_each_structure_stiffness(
      [&](NodeId node, const contact::PairStiffness& stiffness, double) {
        springs_[index_of(rigid_->mover_of(node))] += 2.0 * stiffness.normal;
      });
}

}  // namespace plekton::dynamics

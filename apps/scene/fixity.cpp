// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/fixity.hpp"

#include "apps/scene/node_set.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

using dynamics::Held;

/// What a stage fixes or frees, found where it begins.
struct FoundSet {
  const NodeSetSettings* settings;
  std::vector<geometry::NodeId> nodes;  ///< in the order of their numbers
};

/// @param sets  under the key fix or free
std::vector<FoundSet> find_all(const std::vector<NodeSetSettings>& sets, const char* key,
                               const StageSettings& stage, const BuiltScene& there,
                               Problems& problems) {
  std::vector<FoundSet> found;
  for (const NodeSetSettings& set : sets) {
    found.push_back({&set, nodes_of(set, there)});
    std::sort(found.back().nodes.begin(), found.back().nodes.end());
    if (found.back().nodes.empty())
      problems.add(set.place, fmt::format("{}.{}: {}", stage.path, key, nothing_of(set, there)));
  }
  return found;
}

/// A node cannot be held and free.
void require_apart(const std::vector<FoundSet>& fixed, const std::vector<FoundSet>& freed,
                   const StageSettings& stage, const BuiltScene& there, Problems& problems) {
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    for (std::size_t j = 0; j < freed.size(); ++j) {
      std::vector<geometry::NodeId> both;
      std::set_intersection(fixed[i].nodes.begin(), fixed[i].nodes.end(), freed[j].nodes.begin(),
                            freed[j].nodes.end(), std::back_inserter(both));
      if (both.empty()) continue;
      problems.add(fixed[i].settings->place,
                   fmt::format("{}: fix and free both name {} of \"{}\", which cannot be "
                               "held and free; take other nodes for one of them",
                               stage.path,
                               both.size() == 1 ? "a node" : fmt::format("{} nodes", both.size()),
                               name_of(*fixed[i].settings, there)));
    }
  }
}

/// What nodes are held in that nothing holds: contacts would spin those that nothing turns.
Held held_when_free(const NodeSetSettings& set, const BuiltScene& there) {
  const bool is_of_membrane = !set.of_grains && !set.rigid_body;
  return is_of_membrane && !there.membranes[set.body].turns_nodes ? Held::rotation : Held::nothing;
}

}  // namespace

void fix_and_free(const StageSettings& stage, const BuiltScene& there, std::vector<Held>& held) {
  Problems problems;
  const std::vector<FoundSet> freed = find_all(stage.freed, "free", stage, there, problems);
  const std::vector<FoundSet> fixed = find_all(stage.fixed, "fix", stage, there, problems);
  require_apart(fixed, freed, stage, there, problems);
  problems.throw_if_any();
  const auto set_all = [&](const FoundSet& set, Held all) {
    for (const geometry::NodeId node : set.nodes) {
      Held& own = held[geometry::index_of(node)];
      own = all | (own & Held::by_body);
    }
  };
  for (const FoundSet& set : freed) set_all(set, held_when_free(*set.settings, there));
  for (const FoundSet& set : fixed) set_all(set, Held::everything);
}

}  // namespace plekton::apps

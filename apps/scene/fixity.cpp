// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/fixity.hpp"

#include "apps/scene/node_set.hpp"

#include <fmt/format.h>

namespace plekton::apps {

using dynamics::Held;

void fix_and_free(const StageSettings& stage, const BuiltScene& there, std::vector<Held>& held) {
  Problems problems;
  const auto set_all = [&](const std::vector<NodeSetSettings>& sets, Held all) {
    for (const NodeSetSettings& set : sets) {
      const std::vector<geometry::NodeId> nodes = nodes_of(set, there);
      if (nodes.empty())
        problems.add(set.place,
                     fmt::format("{}: has no node there at the start of the stage", stage.path));
      for (const geometry::NodeId node : nodes) {
        Held& own = held[geometry::index_of(node)];
        own = all | (own & Held::by_body);
      }
    }
  };
  set_all(stage.freed, Held::nothing);
  set_all(stage.fixed, Held::everything);
  problems.throw_if_any();
}

}  // namespace plekton::apps

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/prescribed_once.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

bool holds(dynamics::Held held, int component) {
  return component < 3 ? holds_along(held, component) : holds_about(held, component - 3);
}

}  // namespace

std::string PrescribedOnce::add(const dynamics::PrescribedMotion& motion,
                                const LoadSettings& load) {
  by_.resize(held_.size(), {});
  std::string taken;
  for (const geometry::NodeId id : motion.nodes) {
    const std::size_t node = index_of(id);
    for (int component = 0; component < 6; ++component) {
      if (!holds(motion.held, component)) continue;
      const LoadSettings*& by = by_[node][static_cast<std::size_t>(component)];
      if (taken.empty() && (by != nullptr || holds(held_[node], component))) {
        taken = fmt::format(
            "the {} {} of node {} is {} already",
            component < 3 ? "translation along" : "rotation about", "xyz"[component % 3], node,
            by ? "prescribed by " + by->path : "held by what its body says of hold, or by a stage");
      }
      by = &load;
    }
  }
  return taken;
}

}  // namespace plekton::apps

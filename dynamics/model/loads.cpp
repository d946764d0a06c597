// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/loads.hpp"

namespace plekton::dynamics {

std::vector<Held> held_with_motions(std::vector<Held> held,
                                    std::span<const PrescribedMotion> motions) {
  for (const PrescribedMotion& motion : motions) {
    for (const NodeId node : motion.nodes) {
      if (static_cast<std::int32_t>(node) < 0 || index_of(node) >= held.size()) continue;
      held[index_of(node)] = held[index_of(node)] | motion.held;
    }
  }
  return held;
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/unbalanced_force.hpp"

#include "dynamics/measures/mean_carried.hpp"

#include <limits>

namespace plekton::dynamics {

double unbalanced_force_ratio(const LoadedNodesView& nodes, double carried) noexcept {
  MeanMagnitude resultant;
  for (std::size_t i = 0; i < nodes.forces.force.size(); ++i) {
    const Held held = nodes.properties.held[i];
    if (holds_translation(held)) continue;
    const Vec3 force = nodes.forces.force[i] + nodes.properties.mass[i] * nodes.gravity;
    resultant.add(free_axes(held).cwiseProduct(force).norm());
  }
  if (resultant.value() == 0.0) return 0.0;
  constexpr double kRounding = 1e-10;  // of the resultant: what stiff bonds carry by their lengths
  return carried > kRounding * resultant.value() ? resultant.value() / carried
                                                 : std::numeric_limits<double>::infinity();
}

}  // namespace plekton::dynamics

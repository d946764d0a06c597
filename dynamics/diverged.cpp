// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/diverged.hpp"

#include <sstream>

namespace plekton::dynamics {
namespace {

std::string message(std::int64_t step, double time, NodeId node, const Vec3& position,
                    const Vec3& velocity) {
  std::ostringstream text;
  text << "diverged in step " << step << " (t = " << time << " s): node "
       << static_cast<std::int32_t>(node) << " at (" << position.transpose() << ") m moves at "
       << velocity.norm()
       << " m/s, further in one step than anything could follow; use a smaller time step (or "
          "\"auto\"), and look for "
          "bodies that overlap deeply at the start or are prescribed to move too fast";
  return text.str();
}

}  // namespace

Diverged::Diverged(std::int64_t step, double time, NodeId node, const Vec3& position,
                   const Vec3& velocity)
    : std::runtime_error(message(step, time, node, position, velocity)), step_(step), node_(node) {}

void check_finite(const NodeState& state, std::span<const double> furthest, double dt,
                  std::int64_t step, double time) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    // Comparisons with NaN are false.
    if (state.velocity[i].squaredNorm() * (dt * dt) <= furthest[i] * furthest[i] &&
        state.angular_velocity[i].squaredNorm() < kLargestSquare)
      continue;
    throw Diverged(step, time, geometry::id_at<NodeId>(i), state.position[i], state.velocity[i]);
  }
}

}  // namespace plekton::dynamics

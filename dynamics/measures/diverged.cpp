// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/diverged.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace plekton::dynamics {
namespace {

using Sign = Divergence::Sign;

std::string message(const Divergence& divergence, std::int64_t step, double time,
                    const NodeState& state, const std::string& fault) {
  const std::size_t i = index_of(divergence.node);
  std::ostringstream text;
  text << "diverged in step " << step << " (t = " << time << " s): ";
  if (divergence.sign == Sign::energy) {
    text << divergence.made << " J have come from nowhere, where there were never more than "
         << divergence.there << " J; most of it is in node " << i << " at ("
         << state.position[i].transpose() << ") m, which moves at " << state.velocity[i].norm()
         << " m/s and spins at " << state.angular_velocity[i].norm() << " rad/s";
  } else {
    text << "node " << i << " at (" << state.position[i].transpose() << ") m ";
    if (divergence.sign == Sign::motion)
      text << "moves at " << state.velocity[i].norm()
           << " m/s, further in one step than anything could follow";
    else
      text << "spins at " << state.angular_velocity[i].norm() << " rad/s, half a turn or more in "
           << "one step, so that nobody could tell which way";
  }
  text << "; " << fault;
  return text.str();
}

/// How much further a node moved than it may, or 0; infinite for what is no number.
double excess(double speed_squared, double furthest, double dt) noexcept {
  // Comparisons with NaN are false.
  if (speed_squared * (dt * dt) <= furthest * furthest) return 0.0;
  const double ratio = std::sqrt(speed_squared) * dt / furthest;
  return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

}  // namespace

Diverged::Diverged(const Divergence& divergence, std::int64_t step, double time,
                   const NodeState& state, const std::string& fault)
    : std::runtime_error(message(divergence, step, time, state, fault)),
      divergence_(divergence),
      step_(step) {}

std::optional<Divergence> find_runaway(const NodeState& state, std::span<const double> furthest,
                                       double dt) {
  std::optional<Divergence> found;
  double largest = 0.0;
  const auto consider = [&](Sign sign, std::size_t i, double size) {
    if (!(size > largest)) return;
    largest = size;
    found = Divergence{sign, geometry::id_at<NodeId>(i)};
  };
  for (std::size_t i = 0; i < state.size(); ++i)
    consider(Sign::motion, i, excess(state.velocity[i].squaredNorm(), furthest[i], dt));
  if (found) return found;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double spin = state.angular_velocity[i].squaredNorm();
    const bool is_seen = std::isfinite(furthest[i]) || !(spin < kLargestSquare);
    if (is_seen) consider(Sign::spin, i, excess(spin, std::numbers::pi, dt));
  }
  return found;
}

NodeId most_energetic(const NodeState& state, const NodeProperties& properties) {
  std::size_t most = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Held held = properties.held[i];
    const double energy =
        properties.mass[i] * free_axes(held).cwiseProduct(state.velocity[i]).squaredNorm() +
        properties.inertia[i] *
            free_turns(held).cwiseProduct(state.angular_velocity[i]).squaredNorm();
    if (!std::isfinite(energy)) return geometry::id_at<NodeId>(i);
    if (!(energy > largest)) continue;
    largest = energy;
    most = i;
  }
  return geometry::id_at<NodeId>(most);
}

double prescribed_energy(const NodeState& state, const NodeProperties& properties,
                         double plane_speed) {
  double mass = 0.0, inertia = 0.0;  // kg, kg m², of what is free
  double speed = plane_speed * plane_speed;
  double spin = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 free = free_axes(properties.held[i]);
    const Vec3 free_turn = free_turns(properties.held[i]);
    if (free.maxCoeff() > 0.0) mass += properties.mass[i];
    if (free_turn.maxCoeff() > 0.0) inertia += properties.inertia[i];
    const Vec3 velocity = (Vec3::Ones() - free).cwiseProduct(state.velocity[i]);
    const Vec3 turning = (Vec3::Ones() - free_turn).cwiseProduct(state.angular_velocity[i]);
    speed = std::max(speed, velocity.squaredNorm());
    spin = std::max(spin, turning.squaredNorm());
  }
  return 0.5 * (mass * speed + inertia * spin);
}

}  // namespace plekton::dynamics

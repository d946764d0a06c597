// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/late_starts.hpp"

#include "dynamics/rigid/rigid_bodies.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "geometry/base/state_archive.hpp"

#include <cstdint>

namespace plekton::dynamics {

double LateStarts::put_back(const Lengths& lengths, const Moved& moved) {
  const double back = 0.5 * lengths.last_drift;
  const double part = 0.125 * lengths.drift * lengths.drift;
  double energy = 0.0;
  for (const Start& start : starts_) {
    if (moved.rigid.body_followed_by(start.node) >= 0) continue;
    const std::size_t i = index_of(start.node);
    const Held held = moved.properties.held[i];
    const Vec3 along = free_axes(held) - free_axes(held | start.motions);
    const Vec3 about = free_turns(held) - free_turns(held | start.motions);
    const double mass = moved.properties.mass[i];
    if (!along.isZero(0.0)) {
      const Vec3 acceleration = along.cwiseProduct(moved.gravity + moved.forces.force[i] / mass);
      moved.state.velocity[i] -= back * acceleration;
      energy += part * mass * acceleration.squaredNorm();
    }
    if (about.isZero(0.0)) continue;  // without inertia nothing turns
    const Vec3 torque = about.cwiseProduct(moved.forces.torque[i]);
    if (const std::int32_t body = moved.rigid.body_at(start.node); body >= 0) {
      moved.bodies.push_turning(static_cast<std::size_t>(body), -back * torque);
      energy += part * (moved.rigid.turn_root(body).transpose() * torque).squaredNorm();
    } else {
      const double inertia = moved.properties.inertia[i];
      moved.state.angular_velocity[i] -= back * torque / inertia;
      energy += part * torque.squaredNorm() / inertia;
    }
  }
  starts_.clear();
  return energy;
}

void LateStarts::exchange(const geometry::StateArchive& archive, std::size_t node_count) {
  const bool is_there = archive.is_reading() ? archive.has("late_starts/count") : !empty();
  if (!is_there) return starts_.clear();
  archive.rows("late_starts", starts_, [&](geometry::RowFields& row, Start& start) {
    auto motions = static_cast<std::int64_t>(start.motions);
    row("node", start.node);
    row.require(index_of(start.node) < node_count, "node");
    row("motions", motions);
    row.require(motions >= 0 && motions <= static_cast<std::int64_t>(Held::everything), "motions");
    start.motions = static_cast<Held>(motions);
  });
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"

#include <algorithm>

/// How a simulation applies its loads.
namespace plekton::dynamics {

/// m/s², at any time.
double Simulation::largest_gravity() const noexcept {
  return scene_.loads.gravity_factor.largest() * full_gravity_.norm();
}

void Simulation::apply_loads() {
  follow_gravity();
  loads_.look_at(yielding_bonds_);
  const LoadWork work = loads_.act({time_, last_drift_, drift_}, scene_.state, forces_, pool_);
  work_.external += work.external;
  work_.damped += work.damped;
  if (!driven_planes_.empty()) drive_planes();
}

void Simulation::drive_planes() {
  std::fill(plane_reactions_.begin(), plane_reactions_.end(), Vec3::Zero());
  contacts_->for_each_plane_force(
      [&](std::size_t plane, const Vec3& force) { plane_reactions_[plane] += force; });
  const auto press = [this](std::size_t plane, double way) { return plane_press(plane, way); };
  work_.external +=
      driven_planes_.act({time_, last_drift_, drift_}, plane_reactions_, press, scene_.planes);
}

/// Of all bodies that the plane would touch if it were a way (m) further along its normal.
PlanePress Simulation::plane_press(std::size_t plane, double way) const {
  PlanePress press;
  contacts_->for_each_near_plane_pair(
      way, scene_.planes, scene_.state.position,
      [&](NodeId, std::size_t near, const contact::PairSprings& pair, double gap) {
        if (near != plane || !(gap < way)) return;
        press.force += pair.normal_force(gap - way);
        press.stiffness += pair.normal_stiffness(gap - way);
      });
  return press;
}

/// Gravity that grows does work on what lies still: its energy is that of the gravity of now.
///
/// Kicks by g0 and g1 do the work (g0 + g1)/2 . (C1 - C0) over the drift between them, C the free
/// moment; -g1.C1 + g0.C0 differs from it by -(g1 - g0).(C0 + C1)/2.
void Simulation::follow_gravity() {
  const Vec3 gravity = scene_.loads.gravity_factor.at(time_) * full_gravity_;
  if (gravity == motion_.gravity) return;
  const Vec3 mean = 0.5 * (free_moment(last_drift_) + free_moment(0.0)) - initial_moment_;
  work_.external -= (gravity - motion_.gravity).dot(mean);
  motion_.gravity = gravity;
}

/// Mass times place (kg m) of the free nodes along the axes they are free in, at a time before now
/// (s).
Vec3 Simulation::free_moment(double before) const {
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < scene_.state.size(); ++i) {
    const Vec3 position = scene_.state.position[i] - before * scene_.state.velocity[i];
    moment +=
        scene_.properties.mass[i] * free_axes(scene_.properties.held[i]).cwiseProduct(position);
  }
  return moment;
}

}  // namespace plekton::dynamics

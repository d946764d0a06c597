// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene_change.hpp"

#include "dynamics/model/scene_figures.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/time_step/step_chooser.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {
namespace {

/// Calls visit(before, now) for all that is in both scenes.
template <class Visit>
void for_each_kept(const std::vector<std::int32_t>& places, Visit&& visit) {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= 0) visit(i, static_cast<std::size_t>(places[i]));
}

/// What is held now and was not before stands still.
void stop_newly_held(Held before, Held now, Vec3& velocity, Vec3& spin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (holds_along(now, axis) && !holds_along(before, axis)) velocity[axis] = 0.0;
    if (holds_about(now, axis) && !holds_about(before, axis)) spin[axis] = 0.0;
  }
}

std::vector<bool> driven_planes(const Scene& scene) {
  std::vector<bool> are_driven(scene.planes.size());
  for (const PlaneMotion& motion : scene.loads.plane_motions) are_driven[motion.plane] = true;
  for (const PlaneServo& servo : scene.loads.servos) are_driven[servo.plane] = true;
  return are_driven;
}

}  // namespace

void Simulation::go_on_from(Simulation& before, const SceneChange& change) {
  if (steps_ != 0)
    throw std::logic_error(
        "a simulation goes on from another one before its first step, not after " +
        std::to_string(steps_));
  take_motion(before, change);
  take_structures(before, change.places);
  contacts_->take_over(*before.contacts_, change.places, scene_.planes, scene_.state.position,
                       pool_);
  take_ledger(before);
  if (chooser_ != nullptr) set_first_step(0.0);
}

void Simulation::take_motion(const Simulation& before, const SceneChange& change) {
  time_ = before.time_;
  steps_ = before.steps_;
  drift_ = before.drift_;
  last_drift_ = before.last_drift_;
  motion_.gravity = before.motion_.gravity;
  const bool has_new_nodes = std::count_if(change.places.nodes.begin(), change.places.nodes.end(),
                                           [](std::int32_t node) { return node >= 0; }) !=
                             static_cast<std::ptrdiff_t>(scene_.state.size());
  for_each_kept(change.places.nodes, [&](std::size_t then, std::size_t now) {
    NodeState& state = scene_.state;
    state.position[now] = before.scene_.state.position[then];
    state.velocity[now] = before.scene_.state.velocity[then];
    state.angular_velocity[now] = before.scene_.state.angular_velocity[then];
    state.orientation[now] = before.scene_.state.orientation[then];
    stop_newly_held(before.scene_.properties.held[then], scene_.properties.held[now],
                    state.velocity[now], state.angular_velocity[now]);
    forces_.force[now] = before.forces_.force[then];
    forces_.torque[now] = before.forces_.torque[then];
  });
  fastest_ = before.fastest_;
  fastest_spin_ = before.fastest_spin_;
  if (has_new_nodes) fastest_ = std::max(fastest_, largest_speed(scene_.state));
  const std::vector<bool> are_driven = driven_planes(scene_);
  for_each_kept(change.places.planes, [&](std::size_t then, std::size_t now) {
    if (!change.moved_planes.empty() && change.moved_planes[now]) return;
    scene_.planes[now].point = before.scene_.planes[then].point;
    if (are_driven[now]) scene_.planes[now].velocity = before.scene_.planes[then].velocity;
  });
}

/// What has yielded, broken or torn.
void Simulation::take_structures(Simulation& before, const contact::BodyPlaces& places) {
  for (std::size_t node = 0; node < before.surface_.node_count(); ++node) {
    if (before.surface_.structure_of(geometry::id_at<NodeId>(node)) != geometry::StructureId{-1} &&
        places.nodes[node] != static_cast<std::int32_t>(node))
      throw geometry::StateMismatch("the nodes of structures have other ids than before");
  }
  geometry::StateTree tree;
  const auto write = geometry::StateArchive::writer(tree);
  before.exchange_elements(write.group("elements"));
  before.bonds_.exchange(write.group("bonds"));
  before.yielding_bonds_.exchange(write.group("yield"));
  before.sheet_facets_.exchange(write.group("sheets"));
  before.ties_.exchange(write.group("ties"));
  before.exchange_asked_breaks(write.group("asked_breaks"));
  const auto read = geometry::StateArchive::reader(tree);
  exchange_elements(read.group("elements"));
  bonds_.exchange(read.group("bonds"));
  loads_.follow(bonds_);
  yielding_bonds_.exchange(read.group("yield"));
  sheet_facets_.exchange(read.group("sheets"));
  ties_.exchange(read.group("ties"));
  exchange_asked_breaks(read.group("asked_breaks"));
}

/// Energy that comes or goes with bodies, stiffness and fixity is work from outside. Where weight
/// has no energy is a matter of choice: what comes and goes leaves the energy of weight as it is.
void Simulation::take_ledger(const Simulation& before) {
  work_ = before.work_;
  pending_ = before.pending_;
  broken_energy_ = before.broken_energy_;
  initial_energy_ = before.initial_energy_;
  most_kinetic_ = before.most_kinetic_;
  most_accounted_ = before.most_accounted_;
  suspect_ = before.suspect_;
  initial_stiffness_ = before.initial_stiffness_;
  momentum_.take_over(before.momentum_);
  largest_overlap_ratio_ = before.largest_overlap_ratio_;
  pass_throughs_ = before.pass_throughs_;
  most_crossings_ = before.most_crossings_;
  initial_moment_ =
      before.initial_moment_ + (free_moment(last_drift_) - before.free_moment(last_drift_));
  const double kinetic = kinetic_energy(scene_.state, scene_.properties) -
                         kinetic_energy(before.scene_.state, before.scene_.properties);
  const double elastic = contacts_->elastic_energy() - before.contacts_->elastic_energy();
  work_.kinetic += kinetic;
  work_.external += kinetic + elastic;
}

}  // namespace plekton::dynamics

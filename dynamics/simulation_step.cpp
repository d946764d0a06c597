// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/present_contacts.hpp"
#include "dynamics/simulation.hpp"

#include <algorithm>
#include <cmath>

/// How a simulation chooses its time step.
///
/// What counts is what holds the nodes now and what may come to hold them until the step is looked
/// at again. Two bodies that are g apart touch only after one of them has moved by g / 2. So at a
/// look a way is fixed that nodes and planes may go until the next one; contacts that are nearer
/// than twice that way count as if they touched, and laws that get stiffer with the overlap as if
/// they were deeper by that. The next look comes before any of them has gone so far, by what the
/// fastest went in each step, after kStepsBetweenLooks steps at the latest, and whenever a list of
/// pairs is made anew: what is not in a list cannot touch before the next one. It comes after the
/// contacts of a step are known and before they act. So no kick and no drift is chosen without a
/// contact that acts in it.
///
/// What remains until the next look is how much the weights of the nodes of a facet change as a
/// contact slides on it, and what tension does: kSafety leaves a factor of (kLargestStep /
/// kSafety)² = 1.5 in the stiffness for these. In a search over some hundred random scenes
/// (near_step_test.cpp) no step was above 0.65 of the limit of its moment, so that nothing of it
/// was used.
///
/// Beside what is stable a chosen step follows collisions (ContactSprings::collision_step(),
/// ExpectedContacts::collision_step()), motion (motion_step.hpp) and spin.
namespace plekton::dynamics {

/// rad, a node turns at most by this in a chosen step. From half a turn on nobody could tell which
/// way it turned (Diverged). The step is chosen for half of it, so that a node which spins ever
/// faster is not looked at in every step.
constexpr double kLargestTurn = 1.0;

/// What touches, and what may touch once bodies are nearer by a margin (m).
void Simulation::add_near_contacts_to(ContactSprings& springs, double margin) {
  present_contacts().add_near_to(springs, margin, scene_.state.position);
  add_near_structures_to(springs, margin);
}

/// Nodes of structures that another one may come to lie on, and that nothing of the kind touches
/// yet: with what expected_contacts.hpp says of that.
void Simulation::add_near_structures_to(ContactSprings& springs, double margin) {
  if (of_structures_.empty()) return;
  std::fill(is_counted_.begin(), is_counted_.end(), char{0});
  contacts_->for_each_structure_stiffness(
      [&](NodeId node, double, double, double) { is_counted_[index_of(node)] = 1; });
  contacts_->for_each_near_cell_pair(margin, [&](const geometry::CellPair& cells) {
    for (const geometry::CellId cell : {cells.a, cells.b}) {
      for (const NodeId node : surface_.nodes_of(cell)) {
        if (is_counted_[index_of(node)]) continue;
        is_counted_[index_of(node)] = 1;
        springs.add(node, of_structures_[index_of(node)]);
      }
    }
  });
}

/// m/s, of anything that moves, now or by what loads may say.
double Simulation::largest_speed_now() const noexcept {
  return std::max(
      {largest_speed(scene_.state), loads_.largest_speed(), driven_planes_.largest_speed()});
}

/// Longest step that contacts can follow at the speeds of now (s).
double Simulation::motion_step() const noexcept {
  return longest_step(largest_speed_now(), largest_gravity(), pace_radius_);
}

/// Whether the step has to be looked at before the contacts of this step act.
bool Simulation::is_look_due() const noexcept {
  const bool is_regular = steps_ > 0 && steps_ % kStepsBetweenLooks == 0;
  // The drift that begins now, as fast as the last one was and faster by as much again.
  const double next = 2.0 * way_in_a_step_;
  return is_regular || contacts_->list_count() != look_.lists ||
         look_.way + next > look_.longest_way || fastest_spin_ * dt_ > kLargestTurn;
}

void Simulation::choose_time_step() {
  const double speed = largest_speed_now();
  const double step = std::min(kGrowth * dt_, motion_step());
  const auto steps = static_cast<double>(kStepsBetweenLooks);
  const double usual = steps * step * (speed + steps * step * largest_gravity());
  look_ = {contacts_->list_count(), 0.0,
           std::max(std::min(usual, kLongestWay * pace_radius_), speed * step)};
  const double critical = near_step(2.0 * look_.longest_way).dt;
  const double stable =
      std::min(kSafety * critical, springs_.collision_step(scene_.state, scene_.properties));
  const bool may_grow = steps_ % kStepsBetweenLooks == 0;
  stable_step_ = std::min({stable, collision_step_, (may_grow ? kGrowth : 1.0) * stable_step_});
  dt_ = std::min(stable_step_, motion_step());
  double spin = 0.0;  // rad²/s²
  for (const Vec3& turning : scene_.state.angular_velocity)
    spin = std::max(spin, turning.squaredNorm());
  if (spin > 0.0) dt_ = std::min(dt_, 0.5 * kLargestTurn / std::sqrt(spin));
}

/// What contacts that are more or less than one resist beside their springs (spread_stiffness.hpp).
/// @param x  m, where the nodes were when the forces were found
void Simulation::add_spread_to(NodalStiffness& stiffness, ContactSprings& springs,
                               SpreadStiffness& spread, geometry::Positions x) const {
  constexpr double kDifference = 1e-6;  // of the smallest radius
  if (!spread.begin(springs, scene_.state.size())) return;
  spread.add_to(stiffness, springs, scene_.properties, {x, kDifference * pace_radius_},
                [&](geometry::Positions places, NodeForces& forces, contact::PatchFinder& finder) {
                  contacts_->add_elastic_forces(
                      places, forces, finder, [&](NodeId ball) { return spread.is_spread(ball); });
                });
}

/// Critical step with the contacts of now and those that are nearer than a margin (m).
CriticalStep Simulation::near_step(double margin) {
  space_.begin_at(0);
  springs_.clear();
  add_structures_to(space_);
  add_near_contacts_to(springs_, margin);
  add_spread_to(space_, springs_, spread_, scene_.state.position);
  shares_.add(springs_, scene_.properties, space_);
  CriticalStep step = space_.critical_step(scene_.properties);
  step.dt = loads_.critical_step(step.dt, scene_);
  return step;
}

}  // namespace plekton::dynamics

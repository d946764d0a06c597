// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"

#include <algorithm>
#include <cmath>

/// How a simulation chooses its time step; simulation_definitions.hpp includes this.
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

/// Of a contact of a ball (a) with a ball or surface (b).
template <contact::ContactLaw Law>
ContactStiffness Simulation<Law>::stiffness_of(const Vec3& normal,
                                               const typename Law::Parameters& parameters,
                                               double gap, NodeId a, NodeId b) const {
  return {normal, Law::normal_stiffness(parameters, gap),
          Law::tangential_stiffness(parameters, gap), radii_[index_of(a)], radii_[index_of(b)]};
}

/// Adds a contact of a ball with a surface.
/// @param range    m, radius of the ball and of the surface
/// @param force    N, elastic, of the term; of rings it may be more than one contact has
/// @param further  m, by how much it may get deeper
/// @param x        m, where the nodes were when the force was found: a contact that is about to end
///                 has little of it left a drift later, and would look like many
template <contact::ContactLaw Law>
template <class Springs>
void Simulation<Law>::add_on_surface(Springs& springs, NodeId ball, const geometry::CorePoint& core,
                                     const typename Law::Parameters& parameters, double range,
                                     double force, double further, geometry::Positions x) const {
  const Vec3 way = geometry::position(core, x) - x[index_of(ball)];
  const double distance = way.norm();
  const Vec3 normal = distance > 0.0 ? Vec3(way / distance) : Vec3(Vec3::UnitZ());
  const double gap = distance - range;
  ContactStiffness contact = stiffness_of(normal, parameters, gap - further, ball, core.nodes[0]);
  const double of_one = Law::elastic_normal_force(parameters, gap);
  const double weight = of_one > 0.0 ? force / of_one : 1.0;
  contact.weight = weight;
  contact.normal_stiffness *= std::max(1.0, std::abs(weight));
  contact.overlap = std::max(0.0, -gap);
  const double deeper = weight * Law::elastic_normal_force(parameters, gap - further);
  springs.add_on_surface(ball, core, contact, surface_turning(core, deeper, distance, x));
}

/// Every touching pair, as it is now.
/// @param springs  NodalStiffness, or what else has its functions for contacts
/// @param further  m, by how much contacts may get deeper
/// @param x        m, where the nodes were when the forces were found
template <contact::ContactLaw Law>
template <class Springs>
void Simulation<Law>::add_contacts_to(Springs& springs, double further,
                                      geometry::Positions x) const {
  contacts_.with_spheres().for_each_touching(
      [&](NodeId a, NodeId b, const auto& parameters, double gap) {
        const Vec3 normal = (x[index_of(b)] - x[index_of(a)]).normalized();
        springs.add_pair(a, b, stiffness_of(normal, parameters, gap - further, a, b));
      });
  add_surface_contacts_to(springs, further, x);
  contacts_.with_planes().for_each_touching(
      [&](NodeId ball, std::size_t plane, const auto& parameters, double gap) {
        springs.add_to_wall(
            ball, stiffness_of(scene_.planes[plane].normal, parameters, gap - further, ball, ball));
      });
}

/// Those with surfaces and between structures.
template <contact::ContactLaw Law>
template <class Springs>
void Simulation<Law>::add_surface_contacts_to(Springs& springs, double further,
                                              geometry::Positions x) const {
  contacts_.with_surfaces().for_each_touching(
      [&](NodeId ball, const auto& core, const auto& parameters, double range, double force) {
        add_on_surface(springs, ball, core, parameters, range, force, further, x);
      });
  contacts_.between_structures().for_each_stiffness(
      [&](NodeId node, double normal, double tangential, double radius) {
        springs.add(node, from_all_sides(2.0 * normal, 2.0 * tangential, radius));
      });
}

/// What touches, and what may touch once bodies are nearer by a margin (m).
template <contact::ContactLaw Law>
void Simulation<Law>::add_near_contacts_to(ContactSprings& springs, double margin) {
  const auto& x = scene_.state.position;
  contacts_.with_spheres().for_each_near(
      margin, x, [&](NodeId a, NodeId b, const auto& parameters, double gap) {
        const Vec3 normal = (x[index_of(b)] - x[index_of(a)]).normalized();
        springs.add_pair(a, b, stiffness_of(normal, parameters, gap - margin, a, b));
      });
  add_surface_contacts_to(springs, margin, x);
  contacts_.with_surfaces().for_each_coming(
      margin, contacts_.neighbours().cells(), x,
      [&](NodeId ball, const auto& core, const auto& parameters, double range) {
        add_on_surface(springs, ball, core, parameters, range, 0.0, margin, x);
      });
  contacts_.with_planes().for_each_near(
      margin, scene_.planes, x,
      [&](NodeId ball, std::size_t plane, const auto& parameters, double gap) {
        springs.add_to_wall(
            ball, stiffness_of(scene_.planes[plane].normal, parameters, gap - margin, ball, ball));
      });
  add_near_structures_to(springs, margin);
}

/// Nodes of structures that another one may come to lie on, and that nothing of the kind touches
/// yet: with what expected_contacts.hpp says of that.
template <contact::ContactLaw Law>
void Simulation<Law>::add_near_structures_to(ContactSprings& springs, double margin) {
  if (of_structures_.empty()) return;
  std::fill(is_counted_.begin(), is_counted_.end(), char{0});
  contacts_.between_structures().for_each_stiffness(
      [&](NodeId node, double, double, double) { is_counted_[index_of(node)] = 1; });
  contacts_.between_structures().for_each_near(margin, [&](const geometry::CellPair& cells) {
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
template <contact::ContactLaw Law>
double Simulation<Law>::largest_speed_now() const noexcept {
  return std::max(
      {largest_speed(scene_.state), loads_.largest_speed(), driven_planes_.largest_speed()});
}

/// Longest step that contacts can follow at the speeds of now (s).
template <contact::ContactLaw Law>
double Simulation<Law>::motion_step() const noexcept {
  return longest_step(largest_speed_now(), largest_gravity(), pace_radius_);
}

/// Whether the step has to be looked at before the contacts of this step act.
template <contact::ContactLaw Law>
bool Simulation<Law>::is_look_due() const noexcept {
  const bool is_regular = steps_ > 0 && steps_ % kStepsBetweenLooks == 0;
  // The drift that begins now, as fast as the last one was and faster by as much again.
  const double next = 2.0 * way_in_a_step_;
  return is_regular || contacts_.list_count() != look_.lists ||
         look_.way + next > look_.longest_way || fastest_spin_ * dt_ > kLargestTurn;
}

template <contact::ContactLaw Law>
void Simulation<Law>::choose_time_step() {
  const double speed = largest_speed_now();
  const double step = std::min(kGrowth * dt_, motion_step());
  const auto steps = static_cast<double>(kStepsBetweenLooks);
  const double usual = steps * step * (speed + steps * step * largest_gravity());
  look_ = {contacts_.list_count(), 0.0,
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
template <contact::ContactLaw Law>
void Simulation<Law>::add_spread_to(NodalStiffness& stiffness, ContactSprings& springs,
                                    SpreadStiffness& spread, geometry::Positions x) const {
  constexpr double kDifference = 1e-6;  // of the smallest radius
  if (!spread.begin(springs, scene_.state.size())) return;
  spread.add_to(stiffness, springs, scene_.properties, {x, kDifference * pace_radius_},
                [&](geometry::Positions places, NodeForces& forces, contact::PatchFinder& finder) {
                  contacts_.with_surfaces().add_elastic_forces(
                      contacts_.neighbours().cells(), places, forces, finder,
                      [&](NodeId ball) { return spread.is_spread(ball); });
                });
}

/// Critical step with the contacts of now and those that are nearer than a margin (m).
template <contact::ContactLaw Law>
CriticalStep Simulation<Law>::near_step(double margin) {
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_chooser.hpp"

#include "dynamics/model/scene_figures.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/time_step/expected_contacts.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plekton::dynamics {

/// rad, a node turns at most by this in a chosen step. From half a turn on nobody could tell which
/// way it turned (Diverged). The step is chosen for half of it, so that a node which spins ever
/// faster is not looked at in every step.
constexpr double kLargestTurn = 1.0;
/// Of the critical step, where structures touch at the start or their cores cross: omega dt = 1/2.
/// What is in each other flies apart, and as its contact ends within a step it is off by
/// (omega dt)² / 4 of what was stored in it at most.
constexpr double kReleaseStep = 0.25;
/// rad, by which a bar, or tie, that is pressed together turns at most in a chosen step, and the
/// part of its length at rest below which it is not followed any further. One that goes through
/// itself turns its force round within a step: that makes up to the force times the way in the step,
/// which then is 1/256 of the length, 1/128 of what a bar of no length stores.
constexpr double kLargestTurnOfBar = 1.0 / 8.0;
constexpr double kShortestBar = 1.0 / 32.0;

namespace {

/// s, in which what is pressed together turns by kLargestTurnOfBar; infinite if it does not move.
/// @param length  m, at rest
double turning_step(const Vec3& chord, const Vec3& motion, double length) {
  return kLargestTurnOfBar * std::max(chord.norm(), kShortestBar * length) / motion.norm();
}

}  // namespace

StepChooser::StepChooser(const Resistance& of, const StepLimits& limits)
    : of_(of),
      limits_(&limits),
      pace_radius_(pace_radius(of.scene.elements)),
      thinnest_(thinnest_structure(of.scene.elements)),
      springs_(&of.rigid),
      wires_(&of.rigid),
      tied_(&of.rigid),
      spread_(of.surface, of.rigid),
      structures_(of.rigid),
      walls_(of.rigid) {
  const ExpectedContacts expected(of.scene, of.surface, of.contacts);
  collision_step_ = expected.collision_step();
  if (of.surface.structure_count() == 0) return;
  of_structures_ = expected.of_structures();
  is_counted_.resize(of.scene.state.size());
}

double StepChooser::first(double critical, NodalStiffness space, const Pace& pace) {
  space_ = std::move(space);
  // Where nothing is stiff and free there is nothing to choose from, however fast it moves.
  if (!std::isfinite(critical)) return critical;
  const double dt = choose(kSafety * critical, pace);
  if (!std::isfinite(dt)) step_ = kSafety * critical;
  if (structures_touch()) step_ = std::min(step_, kReleaseStep * critical);
  return step_;
}

bool StepChooser::structures_touch() const {
  bool is_any = false;
  of_.contacts.for_each_structure_stiffness(
      [&](NodeId, const contact::PairStiffness&, double) { is_any = true; });
  return is_any;
}

bool StepChooser::is_due(std::int64_t steps, double dt, double spin) const noexcept {
  const bool is_regular = steps > 0 && steps % steps_between_ == 0;
  // The drift that begins now, as fast as the last one was and faster by as much again.
  const double next = 2.0 * way_in_a_step_;
  return is_regular || of_.contacts.list_count() != look_.lists ||
         look_.way + next > look_.longest_way || spin * dt > kLargestTurn;
}

void StepChooser::moved(double way) noexcept {
  way_in_a_step_ = way;
  look_.way += way;
}

double StepChooser::choose(double dt, const Pace& pace) {
  const double motion = longest_step(pace.speed, pace.gravity, pace_radius_);
  const double step = std::min(kGrowth * dt, motion);
  const auto steps = static_cast<double>(kStepsBetweenLooks);
  const double usual = steps * step * (pace.speed + steps * step * pace.gravity);
  look_ = {of_.contacts.list_count(), 0.0,
           std::max(std::min(usual, kLongestWay * pace_radius_), pace.speed * step)};
  // First, as it collects the springs.
  const double margin = 2.0 * look_.longest_way;
  const double crossed = of_.contacts.crossings() > 0 ? kReleaseStep / kSafety : 1.0;
  const double near = crossed * stable_near(margin, dt);
  plan_next_look(pace.steps);
  const double stable =
      std::min({near, springs_.collision_step(of_.scene.state, of_.scene.properties),
                springs_.crossing_step(of_.scene.state, of_.scene.properties),
                walls_.step(springs_, of_.scene.state, of_.scene.properties), step_of_wires(margin),
                step_of_bars(), step_of_ties(), step_of_meeting(margin)});
  const bool may_grow = pace.steps % kStepsBetweenLooks == 0;
  step_ = std::min(
      {stable, collision_step_, motion, step_of_spin(), (may_grow ? kGrowth : 1.0) * step_});
  return step_;
}

/// Sooner where what spreads has changed by more than kSafety leaves since the last regular look, or
/// did between that and the one before.
void StepChooser::plan_next_look(std::int64_t steps) {
  constexpr double kLeft = (kLargestStep / kSafety) * (kLargestStep / kSafety);
  const double rate = spread_.largest_rate();
  least_spread_ = std::min(least_spread_, rate);
  most_spread_ = std::max(most_spread_, rate);
  const bool has_changed = most_spread_ > kLeft * least_spread_;
  if (has_changed) steps_between_ = kStepsOfChange;
  if (steps % kStepsBetweenLooks == 0) {
    if (!has_changed) steps_between_ = kStepsBetweenLooks;
    least_spread_ = most_spread_ = rate;
  }
}

/// s, that follows wires which become taut or slack until the next look.
double StepChooser::step_of_wires(double margin) {
  wires_.clear();
  limits_->add_near_wires(wires_, margin);
  return wires_.ending_step(of_.scene.state, of_.scene.properties);
}

/// s, in which bars that are pressed together turn by kLargestTurnOfBar at most; infinite if none
/// does.
double StepChooser::step_of_bars() const {
  const NodeState& state = of_.scene.state;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < of_.bonds.size(); ++i) {
    if (!(of_.bonds.axial_force(i) < 0.0)) continue;
    const auto [a, b] = of_.bonds.nodes(i);
    const Vec3 chord = state.position[index_of(b)] - state.position[index_of(a)];
    const Vec3 motion = state.velocity[index_of(b)] - state.velocity[index_of(a)];
    shortest = std::min(shortest, turning_step(chord, motion, of_.scene.bonds[i].length));
  }
  return shortest;
}

/// The same of ties that push, or with which one that goes through itself is off by 1/16 of the
/// energy that it and its motion have (ContactSprings::crossing_step()), if that is longer: they may
/// be as short as rounding.
double StepChooser::step_of_ties() {
  const NodeState& state = of_.scene.state;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < of_.ties.size(); ++i) {
    const double push = -of_.ties.pull(i);
    const Vec3 motion = of_.ties.motion(i, state.velocity);
    const double speed = motion.norm();
    if (!(push > 0.0 && speed > 0.0)) continue;
    const Tie& tie = of_.ties.tie(i);
    ContactStiffness spring{motion / speed, tie.stiffness, 0.0, 0.0, 0.0};
    spring.overlap = push / tie.stiffness;
    spring.core_force = push;
    tied_.clear();
    of_.ties.add_spring(i, spring, tied_);
    shortest = std::min(
        shortest, std::max(turning_step(of_.ties.way(i, state.position), motion, tie.rest_length),
                           tied_.crossing_step(state, of_.scene.properties)));
  }
  return shortest;
}

/// s, in which nodes of structures that touch each other, or are nearer than a margin, move by
/// kLargestMotion of the smallest radius of a structure at most; infinite if none does.
double StepChooser::step_of_meeting(double margin) const {
  double fastest = 0.0;  // m/s
  const auto look_at = [&](NodeId node) {
    fastest = std::max(fastest, of_.scene.state.velocity[index_of(node)].norm());
  };
  of_.contacts.for_each_structure_stiffness(
      [&](NodeId node, const contact::PairStiffness&, double) { look_at(node); });
  of_.contacts.for_each_near_cell_pair(margin, [&](const geometry::CellPair& cells) {
    for (const geometry::CellId cell : {cells.a, cells.b})
      for (const NodeId node : of_.surface.nodes_of(cell)) look_at(node);
  });
  return kLargestMotion * thinnest_ / fastest;
}

/// s, in which the node that spins fastest turns by half of kLargestTurn; infinite if none does.
double StepChooser::step_of_spin() const {
  double squared = 0.0;  // rad²/s²
  for (const Vec3& turning : of_.scene.state.angular_velocity)
    squared = std::max(squared, turning.squaredNorm());
  return 0.5 * kLargestTurn / std::sqrt(squared);
}

/// A stable step (s) with the contacts of now and those that are nearer than a margin (m): kSafety
/// times the critical one. With dashpots as they count in the step itself, so that what they and
/// springs resist may grow by as much until the next look.
/// @param last  s, the last step
double StepChooser::stable_near(double margin, double last) {
  const double rate = limits_->is_damped() ? dashpot_rate(last) : 0.0;
  space_.begin_at(0);
  springs_.clear();
  limits_->add_structures(space_);
  const double of_structures = of_.loads.damps_structures()
                                   ? space_.critical_step(of_.scene.properties).dt
                                   : std::numeric_limits<double>::infinity();
  limits_->add_near_contacts(springs_, margin, rate);
  add_near_structures(margin, rate);
  limits_->find_between_structures(structures_, of_.scene.state.position, 0.0);
  structures_.add_to(springs_);
  limits_->add_spread(space_, springs_, spread_, of_.scene.state.position);
  shares_.add(springs_, of_.scene.properties, space_);
  double stable = kSafety * space_.critical_step(of_.scene.properties).dt;
  if (limits_->is_damped()) stable = stable_with_dashpots(last, stable);
  return kSafety * of_.loads.critical_step(stable / kSafety, of_structures, of_.scene);
}

/// Nodes of structures that another one may come to lie on, and that nothing of the kind touches
/// yet: with what expected_contacts.hpp says of that. With dashpots also those that are touched: each
/// contact more has one of its own, while the stiffness of extents is shared.
void StepChooser::add_near_structures(double margin, double rate) {
  if (of_structures_.empty()) return;
  std::fill(is_counted_.begin(), is_counted_.end(), char{0});
  if (!limits_->is_damped())
    of_.contacts.for_each_structure_stiffness([&](NodeId node, const contact::PairStiffness&,
                                                  double) { is_counted_[index_of(node)] = 1; });
  of_.contacts.for_each_near_cell_pair(margin, [&](const geometry::CellPair& cells) {
    for (const geometry::CellId cell : {cells.a, cells.b}) {
      for (const NodeId node : of_.surface.nodes_of(cell)) {
        if (is_counted_[index_of(node)]) continue;
        is_counted_[index_of(node)] = 1;
        springs_.add(node, of_structures_[index_of(node)].with_dashpots(rate));
      }
    }
  });
}

void StepChooser::exchange(const geometry::StateArchive& archive) {
  archive("lists", look_.lists);
  archive("way", look_.way);
  archive("longest_way", look_.longest_way);
  archive("steps_between", steps_between_);
  archive.require(steps_between_ == kStepsOfChange || steps_between_ == kStepsBetweenLooks,
                  "steps_between");
  archive("least_spread", least_spread_);
  archive("most_spread", most_spread_);
  archive("way_in_a_step", way_in_a_step_);
  archive("step", step_);
  // Of the scene as it was when steps began to be chosen, which may have gone on from another.
  archive("collision_step", collision_step_);
  archive("pace_radius", pace_radius_);
  archive.rows("of_structures", of_structures_, [](geometry::RowFields& row, ExpectedOfNode& node) {
    row("translation", node.stiffness.translation);
    row("rotation", node.stiffness.rotation);
    row("damping", node.damping);
  });
  archive.require(of_structures_.size() == is_counted_.size(), "of_structures");
  spread_.exchange(archive.group("spread"));
  structures_.exchange(archive.group("structures"));
}

}  // namespace plekton::dynamics

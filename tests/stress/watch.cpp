// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace plekton::stress {
namespace {

using geometry::Vec3;

/// The nodes that move freely. What `hold` and motions hold is told by the scene itself.
bool holds_some(const apps::Scenario& scenario) {
  return std::any_of(scenario.membranes.begin(), scenario.membranes.end(),
                     [](const auto& body) { return body.hold.which != apps::HoldWhich::none; });
}

/// Forces in fixed directions, supports, and whatever else is not between bodies. Of pressures those
/// on closed surfaces are: they add up to nothing.
bool acts_from_outside(const apps::LoadSettings& load) {
  if (std::holds_alternative<apps::BeamDampingSettings>(load.load) ||
      std::holds_alternative<apps::SheetDampingSettings>(load.load))
    return false;
  const auto* const pressure = std::get_if<apps::PressureSettings>(&load.load);
  return pressure == nullptr || !(pressure->load.gas || pressure->load.by_volume);
}

bool holds_on_outside(const apps::TieSettings& tie) {
  return tie.kind == apps::TieTo::ground || tie.kind == apps::TieTo::point;
}

bool turns(const apps::MembraneSettings& membrane) {
  if (membrane.mode == apps::MembraneMode::truss) return false;
  return membrane.mode == apps::MembraneMode::lattice || membrane.bending_stiffness != 0.0;
}

/// Whether two materials attract each other, which is energy that no sum from outside has.
bool attract(const apps::PairSettings& pair) {
  return pair.contact.adhesion.work_of_adhesion > 0.0;
}

bool is_finite(const dynamics::NodeState& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i)
    sum += 0.0 * (state.position[i] + state.velocity[i] + state.angular_velocity[i]).sum() +
           0.0 * state.orientation[i].coeffs().sum();
  return sum == 0.0;
}

}  // namespace

Conserved conserved_in(const apps::Scenario& scenario) {
  Conserved conserved;
  if (!scenario.rigid_bodies.empty()) return conserved;  // the sums are over nodes
  const auto& motion = scenario.simulation;
  conserved.momentum =
      motion.damping == 0.0 && scenario.planes.empty() && !holds_some(scenario) &&
      std::none_of(scenario.loads.begin(), scenario.loads.end(), acts_from_outside) &&
      std::none_of(scenario.ties.begin(), scenario.ties.end(), holds_on_outside);
  conserved.angular_momentum =
      conserved.momentum && motion.gravity.isZero(0.0) &&
      std::all_of(scenario.membranes.begin(), scenario.membranes.end(), turns);
  const bool planes_rest =
      std::all_of(scenario.planes.begin(), scenario.planes.end(),
                  [](const auto& plane) { return plane.velocity.isZero(0.0); });
  const bool supports_rest =
      std::all_of(scenario.membranes.begin(), scenario.membranes.end(),
                  [](const auto& body) { return body.hold.velocity.isZero(0.0); });
  conserved.energy = scenario.loads.empty() && planes_rest && supports_rest &&
                     std::none_of(scenario.contacts.begin(), scenario.contacts.end(), attract);
  return conserved;
}

Watch::Watch(const Conserved& conserved, const dynamics::Simulation& simulation)
    : conserved_(conserved),
      first_(sums_of(simulation)),
      velocity_(simulation.state().velocity),
      spin_(simulation.state().angular_velocity) {
  for (const double mass : simulation.properties().mass) mass_ += mass;
}

Watch::Sums Watch::sums_of(const dynamics::Simulation& simulation) {
  const dynamics::NodeState& state = simulation.state();
  const dynamics::NodeProperties& nodes = simulation.properties();
  Sums sums;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 momentum = nodes.mass[i] * state.velocity[i];
    const Vec3 spin = nodes.inertia[i] * state.angular_velocity[i];
    sums.momentum += momentum;
    sums.angular += state.position[i].cross(momentum) + spin;
    sums.magnitude += momentum.norm();
    sums.angular_magnitude += state.position[i].norm() * momentum.norm() + spin.norm();
    if (dynamics::holds_translation(nodes.held[i])) continue;
    sums.kinetic += 0.5 * momentum.dot(state.velocity[i]);
    if (!dynamics::holds_rotation(nodes.held[i]))
      sums.kinetic += 0.5 * spin.dot(state.angular_velocity[i]);
    sums.height -= nodes.mass[i] * simulation.gravity().dot(state.position[i]);
  }
  return sums;
}

void Watch::look(const dynamics::Simulation& simulation) {
  const dynamics::NodeState& state = simulation.state();
  const dynamics::NodeProperties& nodes = simulation.properties();
  if (lost_step_ < 0 && !is_finite(state)) lost_step_ = simulation.steps();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double impulse = nodes.mass[i] * (state.velocity[i] - velocity_[i]).norm();
    exchanged_ += impulse;
    turned_ += state.position[i].norm() * impulse +
               nodes.inertia[i] * (state.angular_velocity[i] - spin_[i]).norm();
    velocity_[i] = state.velocity[i];
    spin_[i] = state.angular_velocity[i];
  }
  const contact::ContactCounts counts = simulation.contacts().counts();
  most_contacts_ = std::max(most_contacts_, counts.sphere_sphere + counts.sphere_surface +
                                                counts.between_structures + counts.with_planes);
  drift_ = simulation.time() - time_;
  time_ = simulation.time();
}

void Watch::find_lost(Findings& findings) const {
  if (lost_step_ >= 0)
    findings.all.push_back(
        {Fault::not_finite, fmt::format("something is no number after step {}", lost_step_)});
}

void Watch::finish(const dynamics::Simulation& simulation, Findings& findings) const {
  find_lost(findings);
  const Sums last = sums_of(simulation);
  // The velocities are those in the middle of the last drift.
  const Vec3 fallen = mass_ * (time_ - 0.5 * drift_) * simulation.gravity();
  const double off = (last.momentum - first_.momentum - fallen).norm();
  const double most = first_.magnitude + last.magnitude + exchanged_;
  if (conserved_.momentum && !(off <= kRounding * most))
    findings.all.push_back(
        {Fault::momentum, fmt::format("off by {:.3g} N s of {:.3g} N s that went through ({:.2g})",
                                      off, most, off / most)});
  const double twisted = (last.angular - first_.angular).norm();
  const double most_angular = first_.angular_magnitude + last.angular_magnitude + turned_;
  if (conserved_.angular_momentum && !(twisted <= kRounding * most_angular))
    findings.all.push_back(
        {Fault::angular_momentum,
         fmt::format("off by {:.3g} N m s of {:.3g} N m s that went through ({:.2g})", twisted,
                     most_angular, twisted / most_angular)});
  if (!conserved_.energy) return;
  // Velocities in the middle of a drift have up to 1 / (1 - 0.8²) of the energy of an oscillation
  // (dynamics::kLargestStep).
  constexpr double kOfHalfSteps = 1.0 / (1.0 - dynamics::kLargestStep * dynamics::kLargestStep);
  const double stored = std::max(0.0, simulation.energy().initial - first_.kinetic);
  const double fell = std::max(0.0, first_.height - last.height);
  const double there = first_.kinetic + stored + fell;
  const double rounding = simulation.energy().rounding;
  if (!(last.kinetic <= kOfHalfSteps * there + rounding))
    findings.all.push_back(
        {Fault::made_energy,
         fmt::format("{:.4g} J in the motion, of {:.4g} J that there were", last.kinetic, there)});
}

}  // namespace plekton::stress

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/applied_loads.hpp"

#include "dynamics/model/require_index.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

AppliedLoads::AppliedLoads(const Scene& scene) {
  const Loads& loads = scene.loads;
  for (const PrescribedMotion& motion : loads.motions)
    motions_.emplace_back(motion, scene.state,
                          reach_around(motion.nodes, scene.rigid_bodies, scene.state.position));
  for (const NodalForce& load : loads.forces) forces_.emplace_back(load);
  for (const GroundSprings& springs : loads.ground_springs)
    springs_.emplace_back(springs, scene.state);
  for (const SurfacePressure& load : loads.pressures)
    pressures_.emplace_back(load, scene.elements.facets, scene.state);
  for (const BeamDamping& damping : loads.beam_damping)
    beams_.emplace_back(damping, scene.bonds, scene.properties);
  for (const SheetDamping& damping : loads.sheet_damping)
    sheets_.emplace_back(damping, scene.sheet_facets, scene.properties);
  for (const MassDamping& damping : loads.mass_damping)
    dragged_.emplace_back(damping, scene.properties);
}

void AppliedLoads::set_force(std::size_t load, const Vec3& force, const Vec3& torque) {
  require_index("set_force", "force", load, forces_.size());
  if (!force.allFinite() || !torque.allFinite())
    throw std::invalid_argument("set_force: force and torque must be finite");
  forces_[load].set(force, torque);
}

void AppliedLoads::set_pressure(std::size_t load, double pressure) {
  require_index("set_pressure", "pressure", load, pressures_.size());
  if (pressures_[load].is_by_volume())
    throw std::invalid_argument("set_pressure: pressure " + std::to_string(load) +
                                " follows the volume by a table");
  if (!std::isfinite(pressure))
    throw std::invalid_argument("set_pressure: the pressure must be finite");
  pressures_[load].set(pressure);
}

void AppliedLoads::start(NodeState& state) const {
  for (const MovedNodes& motion : motions_) motion.start(state);
}

template <class Visit>
LoadWork AppliedLoads::sum_over_forces(Visit&& visit) {
  LoadWork work;
  for (ForcedNodes& load : forces_) work.external += visit(load);
  for (OwnForcedNodes& load : own_) work.external += visit(load);
  for (SprungNodes& load : springs_) work.external += visit(load);
  for (PressedSurface& load : pressures_) work.external += visit(load);
  for (DampedBeams& load : beams_) work.damped -= visit(load);
  for (DampedSheets& load : sheets_) work.damped -= visit(load);
  for (DraggedNodes& load : dragged_) work.damped -= visit(load);
  return work;
}

LoadWork AppliedLoads::add_forces(const LoadStep& step, NodeState& state, NodeForces& forces,
                                  geometry::ThreadPool& pool) {
  return sum_over_forces([&](auto& load) {
    LoadedNodes& nodes = load.act(step, state, pool);
    nodes.add_to(forces, pool);
    return 0.5 * step.before * nodes.power(state, pool);
  });
}

void AppliedLoads::move(const LoadStep& step, NodeState& state, const NodeForces& forces,
                        geometry::ThreadPool& pool, LoadWork& work) {
  for (MovedNodes& motion : motions_) work.external += motion.act(step, state, forces, pool);
}

LoadWork AppliedLoads::work_after(const LoadStep& step, const NodeState& state,
                                  geometry::ThreadPool& pool) {
  return sum_over_forces(
      [&](auto& load) { return 0.5 * step.after * load.nodes().power(state, pool); });
}

void AppliedLoads::look_at(const YieldingBonds& bonds) noexcept {
  for (DampedBeams& beams : beams_) beams.look_at(bonds);
}

void AppliedLoads::follow(const BeamBonds& bonds, const SheetFacets& sheets) {
  for (DampedBeams& beams : beams_) beams.follow(bonds);
  for (DampedSheets& damped : sheets_) damped.follow(sheets);
}

void AppliedLoads::follow(const geometry::SurfaceChange& change) {
  for (PressedSurface& surface : pressures_) surface.follow(change);
}

void AppliedLoads::add_springs_to(NodalStiffness& stiffness) const {
  for (const SprungNodes& springs : springs_) {
    for (std::size_t i = 0; i < springs.nodes().size(); ++i)
      stiffness.add_to_node(springs.nodes().node(i), springs.stiffness().asDiagonal(),
                            Mat3::Zero());
  }
}

void AppliedLoads::add_pressures_to(NodalStiffness& stiffness, geometry::Positions x) const {
  for (const PressedSurface& surface : pressures_) {
    surface.for_each_stiffness(x, [&](NodeId node, double of_facet) {
      stiffness.add_to_node(node, of_facet * Mat3::Identity(), Mat3::Zero());
    });
  }
}

// The largest eigenvalue of a sum is at most the sum of the largest ones, 4 / dt² that of the rest.
double AppliedLoads::critical_step(double without, double of_structures, const Scene& scene) const {
  double gas = 0.0;
  for (const PressedSurface& surface : pressures_)
    gas += surface.gas_frequency_squared(scene.state.position, scene.properties);
  return damped_step(gas == 0.0 ? without : 2.0 / std::sqrt(4.0 / (without * without) + gas),
                     of_structures);
}

double AppliedLoads::relaxation_time() const noexcept {
  double sum = 0.0;
  for (const DampedBeams& beams : beams_) sum += beams.relaxation_time();
  for (const DampedSheets& sheets : sheets_) sum += sheets.relaxation_time();
  return sum;
}

double AppliedLoads::damped_step(double undamped, double of_structures) const noexcept {
  double rate = 0.0;
  for (const DraggedNodes& nodes : dragged_) rate += nodes.rate();
  if (!damps_structures() && rate == 0.0) return undamped;
  return dynamics::damped_step(undamped, std::max(undamped, of_structures), relaxation_time(),
                               rate);
}

void AppliedLoads::add_elastic_forces(double time, const NodeState& state, NodeForces& forces,
                                      geometry::ThreadPool& pool) {
  const LoadStep step{time, 0.0, 0.0};
  for (SprungNodes& load : springs_) load.act(step, state, pool).add_to(forces, pool);
  for (PressedSurface& load : pressures_) load.act(step, state, pool).add_to(forces, pool);
}

void AppliedLoads::add_driving_forces(double time, const NodeState& state, NodeForces& forces,
                                      geometry::ThreadPool& pool) {
  add_elastic_forces(time, state, forces, pool);
  const LoadStep step{time, 0.0, 0.0};
  for (ForcedNodes& load : forces_) load.act(step, state, pool).add_to(forces, pool);
}

double AppliedLoads::largest_speed(const TimeSpan& during) const noexcept {
  double speed = 0.0;
  for (const MovedNodes& motion : motions_) speed = std::max(speed, motion.largest_speed(during));
  return speed;
}

namespace {

/// @throws geometry::StateMismatch if a load that was set is none of this scene
void require_place(std::size_t load, std::size_t count, const char* what, const char* whats) {
  if (load < count) return;
  throw geometry::StateMismatch("in the state " + std::string(what) + " " + std::to_string(load) +
                                " was set, by its place from 0 in the loads; here are " +
                                std::to_string(count) + " " + whats +
                                ": the scene needs the loads that were set there");
}

}  // namespace

void AppliedLoads::exchange(const geometry::StateArchive& archive) {
  archive.same("pressures", pressures_.size(), "another number of pressures");
  for (std::size_t i = 0; i < pressures_.size(); ++i)
    pressures_[i].exchange(archive.group("pressure_" + std::to_string(i)));
  exchange_set_forces(archive);
  exchange_set_pressures(archive);
}

/// Those alone that have been set: all others are those of the scene.
void AppliedLoads::exchange_set_forces(const geometry::StateArchive& archive) {
  struct SetForce {
    std::size_t load = 0;
    Vec3 force, torque;
  };
  std::vector<SetForce> all;
  for (std::size_t i = 0; i < forces_.size(); ++i)
    if (forces_[i].is_set()) all.push_back({i, forces_[i].force(), forces_[i].torque()});
  archive.rows("set_forces", all, [&](geometry::RowFields& row, SetForce& one) {
    row("load", one.load);
    if (row.is_reading()) require_place(one.load, forces_.size(), "force", "forces");
    row("force", one.force);
    row("torque", one.torque);
    row.require(one.force.allFinite() && one.torque.allFinite(), "force");
    if (row.is_reading()) forces_[one.load].set(one.force, one.torque);
  });
}

void AppliedLoads::exchange_set_pressures(const geometry::StateArchive& archive) {
  struct SetPressure {
    std::size_t load = 0;
    double pressure = 0.0;
  };
  std::vector<SetPressure> all;
  for (std::size_t i = 0; i < pressures_.size(); ++i)
    if (pressures_[i].is_set()) all.push_back({i, pressures_[i].full_pressure()});
  archive.rows("set_pressures", all, [&](geometry::RowFields& row, SetPressure& one) {
    row("load", one.load);
    if (row.is_reading()) require_place(one.load, pressures_.size(), "pressure", "pressures");
    row("pressure", one.pressure);
    row.require(std::isfinite(one.pressure), "pressure");
    if (row.is_reading()) pressures_[one.load].set(one.pressure);
  });
}

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/damped_sheets.hpp"
#include "dynamics/loads/ground_springs.hpp"
#include "dynamics/loads/nodal_force.hpp"
#include "dynamics/loads/own_force.hpp"
#include "dynamics/loads/prescribed_motion.hpp"
#include "dynamics/loads/surface_pressure.hpp"
#include "dynamics/loads/viscous_damping.hpp"
#include "dynamics/model/scene.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"

namespace plekton::dynamics {

/// All loads of a scene at work on its nodes.
class AppliedLoads {
 public:
  /// @param scene  checked
  explicit AppliedLoads(const Scene& scene);

  /// Takes a force of one's own. @param nodes  each once
  void add(std::vector<NodeId> nodes, OwnForce force) {
    own_.emplace_back(std::move(nodes), std::move(force));
  }
  /// By place in Loads::forces and Loads::pressures, from the next step on.
  /// @throws std::out_of_range; std::invalid_argument for what is not finite, or a pressure by
  ///         volume
  void set_force(std::size_t load, const Vec3& force, const Vec3& torque);
  void set_pressure(std::size_t load, double pressure);
  /// Whether there is a force of one's own, which may look at any node.
  bool may_look_at_all() const noexcept { return !own_.empty(); }

  /// Sets the velocities of prescribed motions at the start.
  void start(NodeState& state) const;

  /// Takes what dashpots have to know of the bonds along them: after each advance of these, before
  /// add_forces().
  void look_at(const YieldingBonds& bonds) noexcept;

  /// Adds the forces of all loads to those on the nodes. No allocation.
  /// @returns the work of half of the drift before
  LoadWork add_forces(const LoadStep& step, NodeState& state, NodeForces& forces,
                      geometry::ThreadPool& pool);
  /// Sets the velocities of prescribed motions for the drift that begins now. No allocation.
  /// @param forces  all of them
  /// @param work    to which that of half of the drift before is added
  void move(const LoadStep& step, NodeState& state, const NodeForces& forces,
            geometry::ThreadPool& pool, LoadWork& work);

  /// Work of the forces of the last step over half of the drift after it.
  /// @param state  with the velocities of that drift
  LoadWork work_after(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);

  /// Goes on without the dashpots of broken bonds, and of torn sheets.
  void follow(const BeamBonds& bonds, const SheetFacets& sheets);
  /// Goes on without pressure on facets that are gone.
  void follow(const geometry::SurfaceChange& change);

  /// Adds the stiffness of springs to ground.
  void add_springs_to(NodalStiffness& stiffness) const;
  /// Adds the stiffness of facets under pressure.
  void add_pressures_to(NodalStiffness& stiffness, geometry::Positions x) const;

  /// Whether damping in proportion to the stiffness of structures acts.
  bool damps_structures() const noexcept { return relaxation_time() > 0.0; }

  /// The critical step (s) with viscous damping and the stiffness of gases.
  /// @param without        s, without them; may be infinite
  /// @param of_structures  s, that of the structures alone, without contacts, or less; asked for
  ///                       where they are damped
  double critical_step(double without, double of_structures, const Scene& scene) const;

  /// The critical step (s) with viscous damping, which shortens it.
  /// @param undamped       s, without; may be infinite
  /// @param of_structures  s, as above
  double damped_step(double undamped, double of_structures) const noexcept;

  /// Adds the forces that follow from where the nodes are: of springs and pressures. No allocation.
  void add_elastic_forces(double time, const NodeState& state, NodeForces& forces,
                          geometry::ThreadPool& pool);

  /// Adds those, and the nodal forces. No allocation.
  void add_driving_forces(double time, const NodeState& state, NodeForces& forces,
                          geometry::ThreadPool& pool);

  /// What the last step found, and the loads that have been set. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

  /// m/s, of prescribed motions at any of these times.
  double largest_speed(const TimeSpan& during) const noexcept;

  /// By place in Loads::pressures.
  const std::vector<PressedSurface>& pressed_surfaces() const noexcept { return pressures_; }

 private:
  double relaxation_time() const noexcept;  // s, sum of those of beams and sheets
  void exchange_set_forces(const geometry::StateArchive& archive);
  void exchange_set_pressures(const geometry::StateArchive& archive);
  /// Calls visit with each load that is a force.
  /// @returns the work that visit returned, what damping took apart from the rest
  template <class Visit>
  LoadWork sum_over_forces(Visit&& visit);

  std::vector<MovedNodes> motions_;
  std::vector<ForcedNodes> forces_;
  std::vector<OwnForcedNodes> own_;
  std::vector<SprungNodes> springs_;
  std::vector<PressedSurface> pressures_;
  std::vector<DampedBeams> beams_;
  std::vector<DampedSheets> sheets_;
  std::vector<DraggedNodes> dragged_;
};

}  // namespace plekton::dynamics

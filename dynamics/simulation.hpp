// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "contact/laws/linear_frictional.hpp"
#include "dynamics/diverged.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/scene.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/time_step.hpp"

#include <cstdint>

namespace plekton::dynamics {

struct SimulationOptions {
  double time_step = 0.0;  ///< s; 0 chooses one: kSafety times the critical step
  MotionOptions motion;
  double skin = 0.0;  ///< m, how far apart a pair may be when it is listed; 0 chooses a fifth of the smallest radius
  int threads = 1;
};

/// A chosen time step is this part of the critical one.
constexpr double kSafety = 0.5;
/// A given time step must be below this part of the critical one.
constexpr double kLargestStep = 0.8;

/// A scene in motion. The state belongs to the simulation; what is given out are views of it.
template <contact::ContactLaw Law>
class Simulation {
 public:
  /// @throws std::invalid_argument listing every problem of the scene or the options, among them a time step that is
  ///         not below kLargestStep of the critical one
  Simulation(Scene scene, const SimulationOptions& options);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One time step. @throws Diverged
  void step();

  double time() const noexcept { return time_; }
  std::int64_t steps() const noexcept { return steps_; }
  double time_step() const noexcept { return dt_; }
  /// @param dt  s, > 0, from the next step on
  void set_time_step(double dt);

  const NodeState& state() const noexcept { return scene_.state; }
  /// For prescribed motion: the velocities of held nodes may be set between steps.
  void set_velocity(NodeId node, const Vec3& velocity, const Vec3& angular_velocity = Vec3::Zero());
  const NodeProperties& properties() const noexcept { return scene_.properties; }
  const geometry::Elements& elements() const noexcept { return scene_.elements; }
  const geometry::Surface& surface() const noexcept { return surface_; }
  const std::vector<contact::Plane>& planes() const noexcept { return scene_.planes; }
  const BeamBonds& bonds() const noexcept { return bonds_; }
  const contact::Contacts<Law>& contacts() const noexcept { return contacts_; }
  /// Forces of contacts and bonds in the last step, gravity not included.
  const NodeForces& forces() const noexcept { return forces_; }

  Energy energy() const;
  /// Largest overlap of any step so far over the radius of the smaller ball.
  double largest_overlap_ratio() const noexcept { return largest_overlap_ratio_; }
  /// Critical time step of the structures and contacts as they are now, and of the spheres as if packed densely.
  CriticalStep critical_step() const;

 private:
  void account(const StepWork& work);
  void move_planes();
  double gravity_energy(double before) const;
  void add_contacts_to(NodalStiffness& stiffness) const;
  void add_dense_packing_to(NodalStiffness& stiffness) const;

  Scene scene_;
  MotionOptions motion_;
  geometry::ThreadPool pool_;
  geometry::Surface surface_;
  contact::Contacts<Law> contacts_;
  BeamBonds bonds_;
  NodeForces forces_;
  Leapfrog leapfrog_;
  double dt_ = 0.0;
  double time_ = 0.0;
  std::int64_t steps_ = 0;
  double furthest_ = 0.0;  ///< m, what a node may move in a step
  StepWork work_;          ///< kinetic: of the last step; the rest: of all steps
  double initial_energy_ = 0.0;
  double initial_gravity_energy_ = 0.0;
  double largest_overlap_ratio_ = 0.0;
};

template <contact::ContactLaw Law>
void Simulation<Law>::step() {
  forces_.set_zero();
  bonds_.advance(scene_.state, pool_);
  bonds_.add_forces(forces_, pool_);
  contacts_.advance(scene_.state.motion(), scene_.planes, dt_, pool_);
  contacts_.add_forces(forces_, pool_);
  account(leapfrog_.step(scene_.state, forces_, scene_.properties, motion_, dt_, pool_));
  move_planes();
  check_finite(scene_.state, furthest_, dt_, steps_, time_);
  time_ += dt_;
  ++steps_;
}

extern template class Simulation<contact::LinearFrictional>;

}  // namespace plekton::dynamics

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/rigid_bodies.hpp"

#include "dynamics/integrators/leapfrog_lanes.hpp"
#include "dynamics/rigid/free_rotation.hpp"
#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "geometry/base/state_archive.hpp"

namespace plekton::dynamics {
namespace {

Vec3 held_turns(Held held) noexcept {
  return Vec3::Ones() - free_turns(held);
}

bool is_free_to_turn(Held held) noexcept {
  return (held & Held::rotation) == Held::nothing;
}

Vec3 vec3_of(const Vector<Pack<1>>& v) noexcept {
  return {v.x.lanes[0], v.y.lanes[0], v.z.lanes[0]};
}

/// What a kick made of a velocity or an angular momentum.
struct Kicked {
  Vec3 after;  ///< m/s, or kg m²/s
  StepWork work;
};

/// The leapfrog's kick of a single node.
Kicked kick_translation(const Vec3& velocity, const Vec3& force, double mass, Held held,
                        const MotionOptions& options, const StepLengths& lengths) noexcept {
  using Real = Pack<1>;
  const Vec3 held_axes = Vec3::Ones() - free_axes(held);
  NodeMotion<Real> motion{in_all_lanes<Real>(velocity), in_all_lanes<Real>(force), Real(mass),
                          in_all_lanes<Real>(held_axes)};
  const Vector<Real> gravity = in_all_lanes<Real>(options.gravity);
  const Vector<Real> none = Vector<Real>::Zero();
  const auto work = motion.kick(options.damps_gravity ? gravity : none,
                                options.damps_gravity ? none : gravity, options.damping, lengths);
  return {vec3_of(motion.velocity),
          {work.kinetic.lanes[0], work.damped.lanes[0], work.external.lanes[0], 0.0, 0.0}};
}

/// Torque that numerical damping takes off, by components along any axes.
Vec3 damped_torque(const Vec3& torque, const Vec3& spin, double damping) noexcept {
  return {damping_of(torque.x(), spin.x(), damping), damping_of(torque.y(), spin.y(), damping),
          damping_of(torque.z(), spin.z(), damping)};
}

/// The kick of an angular momentum, in axes in which the spin is a linear function of it.
/// @param spin_of  kg m²/s -> rad/s
template <class SpinOf>
Kicked kick_rotation(const Vec3& before, const Vec3& torque, double damping,
                     const StepLengths& lengths, const SpinOf& spin_of) {
  const double dt = lengths.kick;
  const Vec3 now = spin_of(Vec3(before + 0.5 * dt * torque));
  const Vec3 removed = damped_torque(torque, now, damping);
  const Vec3 after = before + dt * Vec3(torque - removed);
  const Vec3 mirrored = before + (1.0 - lengths.drift / lengths.kick) * Vec3(after - before);
  const Vec3 spin = spin_of(after);
  StepWork work;
  work.kinetic = 0.5 * mirrored.dot(spin);
  work.damped = 0.5 * dt * removed.dot(Vec3(spin_of(before) + spin));
  return {after, work};
}

/// J, of spins about some axes.
double energy_of(const Vec3& spin, const Vec3& moments, const Quat& orientation) {
  return 0.5 * spin.dot(inertia_in_world(moments, orientation) * spin);
}

/// A body that is held about some axes, with its momentum about the others.
struct HeldBody {
  const Vec3& moments;      ///< kg m²
  const Quat& orientation;  ///< at the moment of the forces
  Vec3 momentum;            ///< kg m²/s
  HeldTurning holding;

  /// J, of the motion about the free axes, at an orientation.
  double free_energy(const Quat& at) const noexcept {
    const Vec3 spin = partly_held_spin(momentum, moments, at, holding) - holding.spin;
    return energy_of(spin, moments, at);
  }
  /// J, that the hold adds to that while the body turns over a time (s), back where it is negative.
  double gained_in(double time) const noexcept {
    const Vec3 turn = partly_held_turn(momentum, moments, orientation, holding, time);
    return free_energy(turned(orientation, turn, 1.0)) - free_energy(orientation);
  }
};

/// What a hold that turns a body does to its motion about the free axes, from the middle of the
/// last drift to the middle of the next one. The momentum about the free axes stays, in a drift and
/// where the hold takes another spin; the inertia about them and the part that the held spin has of
/// that momentum do not. Of the work of a step the ledger counts what is done before the moment of
/// the forces by the lengths of the drifts (EnergyLedger::book), and the kinetic energy goes with
/// it.
/// @param before, after  the kick
StepWork work_of_hold(const HeldBody& before, const HeldBody& after, const StepLengths& lengths) {
  StepWork work;
  if (before.holding.spin.isZero(0.0) && after.holding.spin.isZero(0.0)) return work;
  HeldBody led = before;
  led.holding = after.holding;
  const double last_drift = 2.0 * lengths.kick - lengths.drift;
  const double earlier = led.free_energy(led.orientation) - before.free_energy(before.orientation) -
                         before.gained_in(-0.5 * last_drift);
  const double later = after.gained_in(0.5 * lengths.drift);
  const double share = 0.5 * lengths.drift / lengths.kick;  // of a step, after that moment
  work.external = earlier + later;
  work.kinetic = (1.0 - share) * later - share * earlier;
  return work;
}

}  // namespace

RigidBodies::RigidBodies(std::span<const RigidBody> bodies, const NodeState& state) {
  for (const RigidBody& body : bodies) {
    const std::size_t reference = index_of(body.node);
    const Mat3 axes = state.orientation[reference].toRotationMatrix();
    Body own{body.node,    body.nodes,   {},           body.moments,
             Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (const NodeId node : body.nodes)
      own.places.push_back(axes.transpose() *
                           Vec3(state.position[index_of(node)] - state.position[reference]));
    bodies_.push_back(std::move(own));
  }
}

void RigidBodies::start(NodeState& state, const NodeProperties& properties) {
  for (Body& body : bodies_) start(body, state, properties);
}

void RigidBodies::start_from(NodeId node, NodeState& state, const NodeProperties& properties) {
  for (Body& body : bodies_) {
    if (body.node == node) start(body, state, properties);
  }
}

void RigidBodies::go_on_turning_from(NodeId node, NodeState& state,
                                     const NodeProperties& properties) {
  for (Body& body : bodies_) {
    if (body.node != node) continue;
    const Vec3 momentum = body.momentum;
    start(body, state, properties);
    body.momentum = momentum;
  }
}

void RigidBodies::start(Body& body, NodeState& state, const NodeProperties& properties) {
  const std::size_t reference = index_of(body.node);
  const Held held = properties.held[reference];
  const Vec3& spin = state.angular_velocity[reference];
  body.held_spin = held_turns(held).cwiseProduct(spin);
  body.momentum = inertia_in_world(body.moments, state.orientation[reference]) * spin;
  for (const NodeId node : body.nodes) {
    const Vec3 lever = state.position[index_of(node)] - state.position[reference];
    state.velocity[index_of(node)] = state.velocity[reference] + spin.cross(lever);
    state.angular_velocity[index_of(node)] = spin;
  }
}

double RigidBodies::turning_energy(const NodeState& state, const NodeProperties& properties) const {
  double energy = 0.0;
  for (const Body& body : bodies_) {
    const std::size_t reference = index_of(body.node);
    const Vec3 spin =
        free_turns(properties.held[reference]).cwiseProduct(state.angular_velocity[reference]);
    energy += energy_of(spin, body.moments, state.orientation[reference]);
  }
  return energy;
}

void RigidBodies::gather(NodeState& state, NodeForces& forces, const NodeProperties& properties,
                         geometry::ThreadPool& pool) {
  pool.for_each_range(bodies_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t b = begin; b < end; ++b) {
      Body& body = bodies_[b];
      const std::size_t reference = index_of(body.node);
      const Vec3& centre = state.position[reference];
      Vec3 force = Vec3::Zero();
      Vec3 torque = Vec3::Zero();
      for (const NodeId node : body.nodes) {
        const std::size_t i = index_of(node);
        force += forces.force[i];
        torque += Vec3(state.position[i] - centre).cross(forces.force[i]) + forces.torque[i];
      }
      body.gathered = force;
      body.gathered_torque = torque;
      forces.force[reference] += force;
      forces.torque[reference] += torque;
      Vec3& spin = state.angular_velocity[reference];
      for (int axis = 0; axis < 3; ++axis) {
        if (holds_about(properties.held[reference], axis)) spin[axis] = body.held_spin[axis];
      }
    }
  });
}

StepWork RigidBodies::step(NodeState& state, const NodeForces& forces,
                           const NodeProperties& properties, const MotionOptions& options,
                           const StepLengths& lengths, geometry::ThreadPool& pool) {
  return sum_(bodies_.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    StepWork work;
    for (std::size_t b = begin; b < end; ++b)
      work += step(bodies_[b], state, forces, properties, options, lengths);
    return work;
  });
}

/// Kicks the angular momentum of a body, and turns it.
/// @returns the turn (rad, world) over the drift
Vec3 RigidBodies::turn(Body& body, const Turning& now, const MotionOptions& options,
                       const StepLengths& lengths, StepWork& work) {
  work.external -= lengths.kick * now.torque.dot(body.held_spin);
  if (holds_rotation(now.held)) return lengths.drift * body.held_spin;
  if (is_free_to_turn(now.held)) {
    const Mat3 axes = now.orientation.toRotationMatrix();
    const auto spin_of = [&](const Vec3& momentum) {
      return Vec3(momentum.cwiseQuotient(body.moments));
    };
    const Kicked kicked =
        kick_rotation(axes.transpose() * body.momentum, axes.transpose() * now.torque,
                      options.damping, lengths, spin_of);
    work += kicked.work;
    // Without damping the momentum makes no detour through the frame of the body.
    body.momentum = options.damping > 0.0 ? Vec3(axes * kicked.after)
                                          : Vec3(body.momentum + lengths.kick * now.torque);
    return free_turn(body.momentum, body.moments, now.orientation, lengths.drift);
  }
  return turn_about_free_axes(body, now, options, lengths, work);
}

/// The same of a body that is held about one or two axes.
Vec3 RigidBodies::turn_about_free_axes(Body& body, const Turning& now, const MotionOptions& options,
                                       const StepLengths& lengths, StepWork& work) {
  const HeldTurning holding{free_turns(now.held), body.held_spin};
  const HeldTurning at_rest{holding.is_free, Vec3::Zero()};
  // kg m²/s, what the held spins have of the momentum about the free axes.
  const Vec3 of_held = holding.is_free.cwiseProduct(
      Vec3(inertia_in_world(body.moments, now.orientation) * body.held_spin));
  const auto spin_of = [&](const Vec3& momentum) {
    return partly_held_spin(momentum, body.moments, now.orientation, at_rest);
  };
  const HeldBody held_before{
      body.moments, now.orientation, body.momentum, {holding.is_free, now.last_held_spin}};
  const Vec3 before = holding.is_free.cwiseProduct(body.momentum) - of_held;
  const Kicked kicked = kick_rotation(before, holding.is_free.cwiseProduct(now.torque),
                                      options.damping, lengths, spin_of);
  work += kicked.work;
  body.momentum = kicked.after + of_held;
  work +=
      work_of_hold(held_before, {body.moments, now.orientation, body.momentum, holding}, lengths);
  return partly_held_turn(body.momentum, body.moments, now.orientation, holding, lengths.drift);
}

/// Gives the nodes of a body the velocities that take them to where they are on it after the drift.
/// @returns the power (W) of the forces on all of its nodes at these, the reference node's included
double RigidBodies::lead(const Body& body, double drift, const NodeForces& forces,
                         NodeState& state) {
  const std::size_t reference = index_of(body.node);
  const Vec3& velocity = state.velocity[reference];
  const Vec3& spin = state.angular_velocity[reference];
  const bool rests = velocity.isZero(0.0) && spin.isZero(0.0);
  const Mat3 axes = turned(state.orientation[reference], spin, drift).toRotationMatrix();
  const Vec3 centre = state.position[reference] + drift * velocity;
  double power = forces.force[reference].dot(velocity) + forces.torque[reference].dot(spin);
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    const std::size_t i = index_of(body.nodes[k]);
    const Vec3 place = centre + axes * body.places[k];
    state.velocity[i] = rests ? Vec3(Vec3::Zero()) : Vec3((place - state.position[i]) / drift);
    state.angular_velocity[i] = spin;
    power += forces.force[i].dot(state.velocity[i]) + forces.torque[i].dot(spin);
  }
  return power;
}

/// The leapfrog takes all nodes of a body as held, and counts what the forces on them do at their
/// velocities as work that they do on the rest: that is put back here.
StepWork RigidBodies::step(Body& body, NodeState& state, const NodeForces& forces,
                           const NodeProperties& properties, const MotionOptions& options,
                           const StepLengths& lengths) {
  const std::size_t reference = index_of(body.node);
  const Held held = properties.held[reference];
  const Kicked translation = kick_translation(state.velocity[reference], forces.force[reference],
                                              properties.mass[reference], held, options, lengths);
  StepWork work = translation.work;
  const Turning now{forces.torque[reference], state.orientation[reference], held, body.held_spin};
  body.held_spin = held_turns(held).cwiseProduct(state.angular_velocity[reference]);
  state.angular_velocity[reference] = turn(body, now, options, lengths, work) / lengths.drift;
  state.velocity[reference] = translation.after;
  work.external += lengths.kick * lead(body, lengths.drift, forces, state);
  return work;
}

void RigidBodies::exchange(const geometry::StateArchive& archive) {
  std::vector<Vec3> momenta, spins;
  for (const Body& body : bodies_) {
    momenta.push_back(body.momentum);
    spins.push_back(body.held_spin);
  }
  archive.fixed("angular_momentum", momenta, "rigid bodies");
  archive.fixed("held_spin", spins, "rigid bodies");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b].momentum = momenta[b];
    bodies_[b].held_spin = spins[b];
  }
}

}  // namespace plekton::dynamics

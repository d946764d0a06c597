// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/rotation_step.hpp"
#include "geometry/rows.hpp"

/// The arithmetic of the leapfrog for many nodes at once: gathered into rows, stepped side by side,
/// taken out again.
namespace plekton::dynamics {

using geometry::Pack;

template <class Real>
using Vector = geometry::PackVec3<Real>;

template <class Real>
PLEKTON_INLINE Vector<Real> in_all_lanes(const Vec3& v) noexcept {
  return {v[0], v[1], v[2]};
}

template <class Real>
struct StepWorkOf {
  Real kinetic, damped, external;  ///< J, as in StepWork
};

/// One motion of nodes, translation or rotation.
template <class Real>
struct NodeMotion {
  Vector<Real> velocity;  ///< m/s or rad/s
  Vector<Real> force;     ///< N or N m
  Real inertia;           ///< kg or kg m²
  Real is_held;           ///< 0 or 1

  /// Steps the velocity. The acceleration is force over inertia plus two parts of gravity, of which
  /// one is damped.
  PLEKTON_INLINE StepWorkOf<Real> kick(const Vector<Real>& damped_gravity,
                                       const Vector<Real>& free_gravity, const Real& damping,
                                       const Real& dt) noexcept;
};

/// Acceleration that numerical damping takes from a component: lambda |a| against the velocity.
template <class Real>
PLEKTON_INLINE Real damping_of(const Real& acceleration, const Real& velocity,
                               const Real& damping) noexcept {
  const Real zero = 0.0;
  const Real drag = damping * select(acceleration > zero, acceleration, -acceleration);
  return select(velocity > zero, drag, select(zero > velocity, -drag, zero));
}

template <class Real>
PLEKTON_INLINE StepWorkOf<Real> NodeMotion<Real>::kick(const Vector<Real>& damped_gravity,
                                                       const Vector<Real>& free_gravity,
                                                       const Real& damping,
                                                       const Real& dt) noexcept {
  const Real zero = 0.0;
  const Real half = 0.5;
  const Vector<Real> before = velocity;
  const Vector<Real> subject = (Real(1.0) / inertia) * force + damped_gravity;
  const Vector<Real> undamped = subject + free_gravity;
  const Vector<Real> now = before + (half * dt) * undamped;
  const Vector<Real> removed{damping_of(subject.x, now.x, damping),
                             damping_of(subject.y, now.y, damping),
                             damping_of(subject.z, now.z, damping)};
  const Vector<Real> after = before + dt * (undamped - removed);

  const auto held = is_held > zero;
  velocity = {select(held, before.x, after.x), select(held, before.y, after.y),
              select(held, before.z, after.z)};
  return {select(held, zero, half * inertia * before.dot(after)),
          select(held, zero, half * dt * inertia * removed.dot(before + after)),
          select(held, -dt * force.dot(before), zero)};
}

/// Up to kLanes nodes.
struct LeapfrogBlock {
  static constexpr std::size_t kLanes = 64;
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kLanes>;

  struct Motion {
    RowsOf<Vec3> velocity;  ///< in and out
    RowsOf<Vec3> force;
    RowsOf<double> inertia;
    RowsOf<double> is_held;

    template <class Real>
    PLEKTON_INLINE NodeMotion<Real> load(std::size_t lane) const noexcept {
      return {velocity.template load<Vector<Real>>(lane), force.template load<Vector<Real>>(lane),
              inertia.template load<Real>(lane), is_held.template load<Real>(lane)};
    }
  };

  Motion translation;
  Motion rotation;
  RowsOf<Quat> orientation;          ///< in and out
  RowsOf<double> half_turn_squared;  ///< rad², out
  RowsOf<StepWorkOf<double>> work;   ///< out

  /// One step of the first count nodes, W at a time; the lanes up to the next multiple of W hold
  /// any numbers. Nodes that turn further than the series of geometry::cosine_and_sinc goes get an
  /// orientation that has to be replaced.
  template <int W>
  PLEKTON_INLINE void step(std::size_t count, const MotionOptions& options,
                           const StepLengths& lengths) noexcept {
    using Real = Pack<W>;
    const Vector<Real> gravity = in_all_lanes<Real>(options.gravity);
    const Vector<Real> zero = Vector<Real>::Zero();
    const Vector<Real> damped_gravity = options.damps_gravity ? gravity : zero;
    const Vector<Real> free_gravity = options.damps_gravity ? zero : gravity;
    for (std::size_t lane = 0; lane < count; lane += std::size_t{W}) {
      auto moves = translation.load<Real>(lane);
      auto spins = rotation.load<Real>(lane);
      const auto of_translation =
          moves.kick(damped_gravity, free_gravity, options.damping, lengths.kick);
      const auto of_rotation = spins.kick(zero, zero, options.damping, lengths.kick);
      translation.velocity.store(lane, moves.velocity);
      rotation.velocity.store(lane, spins.velocity);
      work.store(lane, StepWorkOf<Real>{of_translation.kinetic + of_rotation.kinetic,
                                        of_translation.damped + of_rotation.damped,
                                        of_translation.external + of_rotation.external});
      turn<Real>(lane, spins.velocity, lengths.drift);
    }
  }

 private:
  /// What does not spin keeps its orientation to the bit.
  template <class Real>
  PLEKTON_INLINE void turn(std::size_t lane, const Vector<Real>& spin, double dt) noexcept {
    const auto before = orientation.load<QuatOf<Real>>(lane);
    const auto after = turned_numbers<Real>(before, spin, dt);
    const Vector<Real> half_turn = Real(0.5 * dt) * spin;
    const auto rests = spin.squaredNorm() == Real(0.0);
    half_turn_squared.store(lane, half_turn.squaredNorm());
    orientation.store(
        lane, QuatOf<Real>{select(rests, before.x, after.x), select(rests, before.y, after.y),
                           select(rests, before.z, after.z), select(rests, before.w, after.w)});
  }
};

}  // namespace plekton::dynamics

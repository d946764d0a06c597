// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/integrators/leapfrog.hpp"
#include "dynamics/state/rotation_step.hpp"
#include "geometry/base/lanes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

/// The arithmetic of the leapfrog for some nodes side by side.
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
  Real fastest_squared;            ///< m²/s², as in StepWork
  Real fastest_spin_squared;       ///< rad²/s², as in StepWork
};

/// Squared speed, infinite if a motion is not finite. Comparisons with NaN are false.
template <class Real>
PLEKTON_INLINE Real squared_speed(const Vector<Real>& velocity, const Vector<Real>& spin) noexcept {
  const Real infinite = std::numeric_limits<double>::infinity();
  const Real speed = velocity.squaredNorm();
  return select(Real(kLargestSquare) > spin.squaredNorm(),
                select(Real(kLargestSquare) > speed, speed, infinite), infinite);
}

/// One motion of nodes, translation or rotation.
template <class Real>
struct NodeMotion {
  Vector<Real> velocity;  ///< m/s or rad/s
  Vector<Real> force;     ///< N or N m
  Real inertia;           ///< kg or kg m²
  Vector<Real> held;      ///< 1 or 0 for each component

  /// Steps the velocity. The acceleration is force over inertia plus two parts of gravity, of which
  /// one is damped.
  PLEKTON_INLINE StepWorkOf<Real> kick(const Vector<Real>& damped_gravity,
                                       const Vector<Real>& free_gravity, double damping,
                                       const StepLengths& lengths) noexcept;
};

/// Acceleration that numerical damping takes from a component: lambda |a| against the velocity.
template <class Real>
PLEKTON_INLINE Real damping_of(const Real& acceleration, const Real& velocity,
                               const Real& damping) noexcept {
  using geometry::select;
  const Real zero = 0.0;
  const Real drag = damping * select(acceleration > zero, acceleration, -acceleration);
  return select(velocity > zero, drag, select(zero > velocity, -drag, zero));
}

/// For each component that of one of two vectors.
template <class Real>
PLEKTON_INLINE Vector<Real> choose(const Vector<Real>& held, const Vector<Real>& if_held,
                                   const Vector<Real>& if_free) noexcept {
  const Real zero = 0.0;
  return {select(held.x > zero, if_held.x, if_free.x), select(held.y > zero, if_held.y, if_free.y),
          select(held.z > zero, if_held.z, if_free.z)};
}

template <class Real>
PLEKTON_INLINE StepWorkOf<Real> NodeMotion<Real>::kick(const Vector<Real>& damped_gravity,
                                                       const Vector<Real>& free_gravity,
                                                       double damping,
                                                       const StepLengths& lengths) noexcept {
  const Real half = 0.5;
  const Real dt = lengths.kick;
  const Vector<Real> none = Vector<Real>::Zero();
  const Vector<Real> before = velocity;
  const Vector<Real> subject = (Real(1.0) / inertia) * force + damped_gravity;
  const Vector<Real> undamped = subject + free_gravity;
  const Vector<Real> now = before + (half * dt) * undamped;
  const Real lambda = damping;
  const Vector<Real> removed{damping_of(subject.x, now.x, lambda),
                             damping_of(subject.y, now.y, lambda),
                             damping_of(subject.z, now.z, lambda)};
  const Vector<Real> after = before + dt * (undamped - removed);

  // The velocity half of the next drift before the moment of the forces: that before, where both
  // drifts are of one length.
  const Vector<Real> mirrored =
      before + Real(1.0 - lengths.drift / lengths.kick) * (after - before);

  // What is held keeps its velocity; it may have no inertia, and no number then for what is freed.
  velocity = choose(held, before, after);
  return {half * inertia * choose(held, none, mirrored).dot(velocity),
          half * dt * inertia * choose(held, none, removed).dot(before + velocity),
          -dt * force.dot(choose(held, before, none)), Real(0.0), Real(0.0)};
}

/// Nodes one after the other in memory.
struct NodeArrays {
  Vec3* position;          ///< m
  Vec3* velocity;          ///< m/s
  Vec3* angular_velocity;  ///< rad/s
  Quat* orientation;
  const Vec3* force;      ///< N
  const Vec3* torque;     ///< N m
  const double* mass;     ///< kg
  const double* inertia;  ///< kg m²
  const Held* held;

  /// The arrays from a node on.
  PLEKTON_INLINE NodeArrays from(std::size_t i) const noexcept {
    return {position + i, velocity + i, angular_velocity + i, orientation + i, force + i,
            torque + i,   mass + i,     inertia + i,          held + i};
  }
};

template <int W>
PLEKTON_INLINE Vector<Pack<W>> load_vectors(const Vec3* from) noexcept {
  const auto [x, y, z] = geometry::load_things<W, 3>(from);
  return {x, y, z};
}

template <int W>
PLEKTON_INLINE void store_vectors(const Vector<Pack<W>>& v, Vec3* to) noexcept {
  geometry::store_things<W, 3>({v.x, v.y, v.z}, to);
}

/// 1 for each component of a motion of each node that is held, else 0.
template <int W>
PLEKTON_INLINE Vector<Pack<W>> load_held(const Held* from, bool (*holds)(Held, int)) noexcept {
  using Real = Pack<W>;
  std::uint64_t any_held = 0;
  std::memcpy(&any_held, from, std::size_t{W} * sizeof(Held));
  // Most often nothing is; and numbers just written one by one are slow to be read as a vector.
  if (any_held == 0) return Vector<Real>::Zero();
  std::array<std::array<double, std::size_t{W}>, 3> held;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < std::size_t{W}; ++lane)
      held[static_cast<std::size_t>(axis)][lane] = holds(from[lane], axis) ? 1.0 : 0.0;
  }
  return {Real::load(held[0].data()), Real::load(held[1].data()), Real::load(held[2].data())};
}

/// Whether forces leave the velocity of a node as it is: held, or stepped by its rigid body.
constexpr bool keeps_along(Held held, int axis) noexcept {
  return holds_along(held, axis) || is_reference(held);
}
constexpr bool keeps_about(Held held, int axis) noexcept {
  return holds_about(held, axis) || is_reference(held);
}

/// Turns the orientations of nodes by any angle. What does not spin keeps its orientation to the
/// bit.
inline void turn_one_by_one(int count, const Vec3* spins, double dt, Quat* orientations) noexcept {
  for (int i = 0; i < count; ++i) {
    if (!spins[i].isZero(0.0)) orientations[i] = turned(orientations[i], spins[i], dt);
  }
}

/// The same for W nodes side by side, of which none turns further than the series of
/// geometry::cosine_and_sinc goes.
/// @returns whether that is so; otherwise nothing has been done
template <int W>
PLEKTON_INLINE bool turn_side_by_side(const Vector<Pack<W>>& spin, double dt,
                                      Quat* orientations) noexcept {
  using Real = Pack<W>;
  const auto [x, y, z, w] = geometry::load_things<W, 4>(orientations);
  const QuatOf<Real> after = turned_numbers<Real>({x, y, z, w}, spin, dt);
  const Real rests = geometry::flag(spin.squaredNorm() == Real(0.0));
  const Vector<Real> half_turn = Real(0.5 * dt) * spin;
  const Real is_small =
      geometry::flag(Real(geometry::kSmallAngleSquared) > half_turn.squaredNorm());
  if (bits_of(is_small) != geometry::kAllBits<W>) return false;
  geometry::store_things<W, 4>({select(rests > 0.0, x, after.x), select(rests > 0.0, y, after.y),
                                select(rests > 0.0, z, after.z), select(rests > 0.0, w, after.w)},
                               orientations);
  return true;
}

/// Moves W nodes; which component a number is makes no difference.
template <int W>
PLEKTON_INLINE void drift(const Vec3* velocities, double dt, Vec3* positions) noexcept {
  using Real = Pack<W>;
  const auto* const from = reinterpret_cast<const std::byte*>(velocities);
  auto* const to = reinterpret_cast<std::byte*>(positions);
  for (std::size_t k = 0; k < 3; ++k) {
    const Real velocity = Real::load_bytes(from + k * sizeof(Real));
    std::byte* const position = to + k * sizeof(Real);
    (Real::load_bytes(position) + Real(dt) * velocity).store_bytes(position);
  }
}

/// One step of W nodes.
template <int W>
PLEKTON_INLINE StepWorkOf<Pack<W>> step_lanes(const NodeArrays& nodes, const MotionOptions& options,
                                              const StepLengths& lengths) noexcept {
  using Real = Pack<W>;
  const Vector<Real> gravity = in_all_lanes<Real>(options.gravity);
  const Vector<Real> zero = Vector<Real>::Zero();
  NodeMotion<Real> moves{load_vectors<W>(nodes.velocity), load_vectors<W>(nodes.force),
                         Real::load(nodes.mass), load_held<W>(nodes.held, keeps_along)};
  NodeMotion<Real> spins{load_vectors<W>(nodes.angular_velocity), load_vectors<W>(nodes.torque),
                         Real::load(nodes.inertia), load_held<W>(nodes.held, keeps_about)};
  const auto of_translation =
      moves.kick(options.damps_gravity ? gravity : zero, options.damps_gravity ? zero : gravity,
                 options.damping, lengths);
  const auto of_rotation = spins.kick(zero, zero, options.damping, lengths);
  store_vectors<W>(moves.velocity, nodes.velocity);
  store_vectors<W>(spins.velocity, nodes.angular_velocity);
  if (!turn_side_by_side<W>(spins.velocity, lengths.drift, nodes.orientation))
    turn_one_by_one(W, nodes.angular_velocity, lengths.drift, nodes.orientation);
  drift<W>(nodes.velocity, lengths.drift, nodes.position);
  return {of_translation.kinetic + of_rotation.kinetic, of_translation.damped + of_rotation.damped,
          of_translation.external + of_rotation.external,
          squared_speed(moves.velocity, spins.velocity), spins.velocity.squaredNorm()};
}

}  // namespace plekton::dynamics

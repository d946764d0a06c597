// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/lane_law.hpp"
#include "geometry/face_foot.hpp"
#include "geometry/feature.hpp"
#include "geometry/rows.hpp"
#include "geometry/vector_width.hpp"

#include <array>

/// Balls that touch the inside of one facet each, side by side: what lone_contact.hpp and the
/// general way make of each, to the last bit.
namespace plekton::contact {

/// A ball (first) and the corners of a facet, as they stand and move.
template <class Real>
struct LoneMotionOf {
  std::array<Vec3Of<Real>, 4> position;  ///< m
  std::array<Vec3Of<Real>, 4> velocity;  ///< m/s
  std::array<Vec3Of<Real>, 4> spin;      ///< rad/s
  Real radius;                           ///< m, of the ball
  Real range;                            ///< m, radius of ball + radius of facet
};

/// The relative motion at the contact point, as lone_state() has it.
template <class Real>
struct LoneKinematicsOf {
  Real gap;               ///< m
  Vec3Of<Real> foot;      ///< m, from the ball's centre
  Vec3Of<Real> lever_a;   ///< m, from the ball's centre to the contact point
  Vec3Of<Real> lever_b;   ///< m, from the foot to the contact point
  Vec3Of<Real> velocity;  ///< m/s, of the facet relative to the ball
  Real twist_rate;        ///< rad/s
};

template <class Real>
PLEKTON_INLINE LoneKinematicsOf<Real> lone_kinematics(
    const LoneMotionOf<Real>& motion, const geometry::FaceFootOf<Real>& at) noexcept {
  using Vector = Vec3Of<Real>;
  const Real gap = at.distance - motion.range;
  const Vector foot = at.distance * at.direction;
  const Real distance = motion.range + gap;
  const Vector lever_a = Real((motion.radius + Real(0.5) * gap) / distance) * foot;
  const Vector lever_b = lever_a - foot;
  const std::array<Real, 3> weights{at.weights.x, at.weights.y, at.weights.z};
  Vector velocity = Vector::Zero();
  Vector spin = Vector::Zero();
  const auto add = [&](std::size_t k) __attribute__((always_inline)) {
    velocity =
        velocity + weights[k] * Vector(motion.velocity[k + 1] + motion.spin[k + 1].cross(lever_b));
    spin = spin + weights[k] * motion.spin[k + 1];
  };
  add(0);
  add(1);
  add(2);
  const Vector& spin_a = motion.spin[0];
  const Vector twice_mean = spin_a + spin;
  return {gap,
          foot,
          lever_a,
          lever_b,
          velocity - motion.velocity[0] - spin_a.cross(lever_a),
          Real(0.5) * twice_mean.dot(at.direction)};
}

/// Balls in a block: all rows together fit into the first level of a cache.
constexpr std::size_t kLoneLanes = 32;

/// Up to kLoneLanes balls and facets.
template <LaneLaw Law>
struct LoneBlock {
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kLoneLanes>;

  // Filled in for each:
  std::array<RowsOf<Vec3>, 4> position;  ///< m, of the ball and the corners
  std::array<RowsOf<Vec3>, 4> velocity;  ///< m/s
  std::array<RowsOf<Vec3>, 4> spin;      ///< rad/s
  RowsOf<double> radius;                 ///< m, of the ball
  RowsOf<double> range;                  ///< m, radius of ball + radius of facet
  RowsOf<typename Law::Parameters> parameters;
  // Filled in, and brought to the end of the step:
  RowsOf<typename Law::History> history;
  RowsOf<Vec3> normal;  ///< unit, of the last step
  // Answers:
  RowsOf<typename Law::History> carried;  ///< the history before the law has spoken
  RowsOf<Vec3> weights;                   ///< of the corners
  RowsOf<double> gap;                     ///< m
  RowsOf<Vec3> foot;                      ///< m, from the ball's centre
  RowsOf<Vec3> force_b;                   ///< N, on the facet
  RowsOf<Vec3> torque_a;                  ///< N m
  RowsOf<Vec3> torque_b;                  ///< N m
  RowsOf<double> dissipated;              ///< J, by the law
  /// 1 if these are the answers; else another feature may be in range, the ball has left, or the
  /// normal has turned by more than 90 degrees, or the frame twisted too far for lanes.
  RowsOf<double> is_right;

  /// One step of the first count ones, W at a time; the lanes up to the next multiple of W hold any
  /// numbers.
  template <int W>
  PLEKTON_INLINE void advance(std::size_t count, double dt) noexcept {
    for (std::size_t lane = 0; lane < count; lane += std::size_t{W})
      advance_lanes<Pack<W>>(lane, dt);
  }

 private:
  template <class Real>
  PLEKTON_INLINE LoneMotionOf<Real> motion(std::size_t lane) const noexcept {
    using Vector = Vec3Of<Real>;
    const auto all = [&](const std::array<RowsOf<Vec3>, 4>& rows) __attribute__((always_inline)) {
      return std::array<Vector, 4>{
          rows[0].template load<Vector>(lane), rows[1].template load<Vector>(lane),
          rows[2].template load<Vector>(lane), rows[3].template load<Vector>(lane)};
    };
    return {all(position), all(velocity), all(spin), radius.template load<Real>(lane),
            range.template load<Real>(lane)};
  }
  template <class Real>
  PLEKTON_INLINE void advance_lanes(std::size_t lane, double dt) noexcept;
};

template <LaneLaw Law>
template <class Real>
PLEKTON_INLINE void LoneBlock<Law>::advance_lanes(std::size_t lane, double dt) noexcept {
  using Vector = Vec3Of<Real>;
  const LoneMotionOf<Real> bodies = motion<Real>(lane);
  const auto at = geometry::face_foot<Real>(
      bodies.position[0], {bodies.position[1], bodies.position[2], bodies.position[3]},
      bodies.range);
  const LoneKinematicsOf<Real> state = lone_kinematics(bodies, at);
  const auto law = parameters.template load<typename Law::template ParametersOf<Real>>(lane);
  auto slip = history.template load<typename Law::template HistoryOf<Real>>(lane);
  const auto last_normal = normal.template load<Vector>(lane);
  const FrameRotationOf<Real> rotation{last_normal, at.direction, Real(dt) * state.twist_rate};
  Law::rotate(slip, rotation);
  carried.store(lane, slip);

  const Real elastic = Law::elastic_normal_force(law, state.gap);
  const RelativeMotionOf<Real> relative =
      relative_motion<Real>(at.direction, state.gap, elastic, state.velocity);
  const ContactForceOf<Real> answer = Law::force(law, relative, slip, dt);
  const Vector elastic_force = elastic * at.direction;
  const Vector other = answer.force - elastic_force;
  const Vector turning = state.lever_a.cross(other);
  history.store(lane, slip);
  normal.store(lane, at.direction);
  weights.store(lane, at.weights);
  gap.store(lane, state.gap);
  foot.store(lane, state.foot);
  force_b.store(lane, Vector(elastic_force + other));
  torque_a.store(lane, Vector{-turning.x, -turning.y, -turning.z});
  torque_b.store(lane, state.lever_b.cross(other));
  dissipated.store(lane, answer.dissipated);
  const Real untwisted =
      geometry::flag(Real(geometry::kSmallAngleSquared) > rotation.twist * rotation.twist);
  const Real unturned = geometry::flag(last_normal.dot(at.direction) > Real(0.0));
  const Real has_lever = geometry::flag(Real(bodies.range + state.gap) > Real(0.0));
  is_right.store(lane, at.is_alone * untwisted * unturned * has_lever);
}

/// Pairs of a ball with the inside of one facet, as far as one can tell beforehand. Empty for a law
/// that is not written for lanes.
template <ContactLaw Law>
struct LonePairs {};
template <LaneLaw Law>
struct LonePairs<Law> {
  std::array<geometry::FaceId, kLoneLanes> face;
  std::size_t count = 0;
  LoneBlock<Law> block;
};

/// LoneBlock::advance with the widest vectors there are.
template <LaneLaw Law>
void advance_side_by_side(LoneBlock<Law>& block, std::size_t count, double dt) noexcept {
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    block.template advance<width>(count, dt);
  });
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/law/lane_law.hpp"
#include "contact/sphere_surface/facets_beside.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/gather.hpp"
#include "geometry/base/vector_width.hpp"
#include "geometry/closest/face_foot.hpp"
#include "geometry/primitives/feature.hpp"

#include <array>
#include <span>

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
  Vec3Of<Real> spin;      ///< rad/s, of the facet relative to the ball
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
          spin - spin_a,
          Real(0.5) * twice_mean.dot(at.direction)};
}

/// What does not change about a ball and a surface.
template <class Real, class Parameters>
struct LonePairOf {
  Real radius;  ///< m, of the ball
  Real range;   ///< m, radius of ball + radius of surface
  Parameters parameters;
};
template <ContactLaw Law>
using LonePair = LonePairOf<double, typename Law::Parameters>;

/// ContactMemory of Real.
template <class Real, class History>
struct LoneMemoryOf {
  History history;
  Vec3Of<Real> normal;  ///< unit
};

/// What a step of a ball and a facet came to.
template <class Real, class History>
struct LoneAnswerOf {
  Vec3Of<Real> weights;   ///< of the corners
  Vec3Of<Real> force_b;   ///< N, on the facet
  Vec3Of<Real> torque_a;  ///< N m
  Vec3Of<Real> torque_b;  ///< N m
  LoneMemoryOf<Real, History> memory;
  Vec3Of<Real> foot;  ///< m, from the ball's centre
  Real gap;           ///< m
  Real dissipated;    ///< J, by the law, and what of the history's energy was lost in turning it
  /// Positive if these are the answers; else another feature may be in range, the ball has left, or
  /// the normal has turned by more than 90 degrees, or the frame twisted too far for lanes.
  Real is_right;
};

/// Balls in a block: all that it reads and writes fits into the first level of a cache.
constexpr std::size_t kLoneLanes = 32;

/// Up to kLoneLanes balls and facets.
template <LaneLaw Law>
class LoneBlock {
 public:
  using Answer = LoneAnswerOf<double, typename Law::History>;
  /// How many numbers are read from where those of a pair and of a memory start.
  static constexpr std::size_t kReadOfPair =
      geometry::touched_numbers(sizeof(LonePair<Law>) / sizeof(double));
  static constexpr std::size_t kReadOfMemory =
      geometry::touched_numbers(sizeof(ContactMemory<Law>) / sizeof(double));

  /// One more; not more than kLoneLanes.
  /// @param nodes   of the ball, and the corners
  /// @param pair    the numbers of a LonePair, of which kReadOfPair are read
  /// @param memory  those of a ContactMemory, of the last step; kReadOfMemory are read
  /// @param sides   that do not keep the facet from being touched alone
  void add(const std::array<NodeId, 4>& nodes, const double* pair, const double* memory,
           const SideFlags& sides) noexcept {
    lanes_[count_++] = {sides, nodes, pair, memory};
  }
  void clear() noexcept { count_ = 0; }
  std::size_t count() const noexcept { return count_; }

  const Answer& answer(std::size_t lane) const noexcept { return answers_[lane].answer; }
  bool is_right(std::size_t lane) const noexcept { return answer(lane).is_right > 0.0; }

  /// One step of all, W at a time.
  template <int W>
  PLEKTON_INLINE void advance(const Motion& motion, double dt) noexcept {
    for (std::size_t i = count_; i % std::size_t{W} != 0; ++i) lanes_[i] = lanes_[i - 1];
    for (std::size_t lane = 0; lane < count_; lane += std::size_t{W})
      advance_lanes<W>(lane, motion, dt);
  }

 private:
  struct Lane {
    SideFlags sides;
    std::array<NodeId, 4> nodes;
    const double* pair;
    const double* memory;
  };
  struct alignas(64) PaddedAnswer {
    Answer answer;
  };

  template <int W>
  PLEKTON_INLINE LoneMotionOf<Pack<W>> motion_of(const Lane* lanes, const Pack<W>& radius,
                                                 const Pack<W>& range,
                                                 const Motion& motion) const noexcept;
  template <int W>
  PLEKTON_INLINE void advance_lanes(std::size_t lane, const Motion& motion, double dt) noexcept;

  std::array<Lane, kLoneLanes> lanes_;
  std::array<PaddedAnswer, kLoneLanes> answers_;
  std::size_t count_ = 0;
};

template <LaneLaw Law>
template <int W>
PLEKTON_INLINE LoneMotionOf<Pack<W>> LoneBlock<Law>::motion_of(
    const Lane* lanes, const Pack<W>& radius, const Pack<W>& range,
    const Motion& motion) const noexcept {
  using Vector = Vec3Of<Pack<W>>;
  const auto of_node = [&](std::size_t k, std::span<const Vec3> v) __attribute__((always_inline)) {
    return geometry::gather_vectors<W>([&](std::size_t lane) __attribute__((always_inline))
                                           ->const Vec3& {
                                             return v[index_of(lanes[lane].nodes[k])];
                                           });
  };
  const auto all = [&](std::span<const Vec3> v) __attribute__((always_inline)) {
    return std::array<Vector, 4>{of_node(0, v), of_node(1, v), of_node(2, v), of_node(3, v)};
  };
  return {all(motion.position), all(motion.velocity), all(motion.angular_velocity), radius, range};
}

template <LaneLaw Law>
template <int W>
PLEKTON_INLINE void LoneBlock<Law>::advance_lanes(std::size_t first, const Motion& motion,
                                                  double dt) noexcept {
  using Real = Pack<W>;
  using Vector = Vec3Of<Real>;
  using History = typename Law::template HistoryOf<Real>;
  using Pair = LonePairOf<Real, typename Law::template ParametersOf<Real>>;
  const Lane* const lanes = &lanes_[first];
  const auto pair = geometry::gather_numbers<Pair, W>([&](
      std::size_t lane) __attribute__((always_inline)) { return lanes[lane].pair; });
  const auto last = geometry::gather_numbers<LoneMemoryOf<Real, History>, W>([&](
      std::size_t lane) __attribute__((always_inline)) { return lanes[lane].memory; });
  const LoneMotionOf<Real> bodies = motion_of<W>(lanes, pair.radius, pair.range, motion);
  Real reach = bodies.range;
  if constexpr (HasReach<Law>) reach = bodies.range + Law::reach(pair.parameters);
  const auto at = geometry::face_foot<Real>(
      bodies.position[0], {bodies.position[1], bodies.position[2], bodies.position[3]}, reach,
      geometry::gather_vectors<W>([&](std::size_t lane) __attribute__((always_inline))
                                      ->const SideFlags& { return lanes[lane].sides; }));
  const LoneKinematicsOf<Real> state = lone_kinematics(bodies, at);
  const FrameRotationOf<Real> rotation{last.normal, at.direction, Real(dt) * state.twist_rate};
  History history = last.history;
  Law::rotate(history, rotation);
  const Real lost = Law::history_energy(pair.parameters, last.history) -
                    Law::history_energy(pair.parameters, history);

  const Real elastic = Law::elastic_normal_force(pair.parameters, state.gap);
  const RelativeMotionOf<Real> relative =
      relative_motion<Real>(at.direction, state.gap, elastic, state.velocity, state.spin);
  // What is within reach, but neither pushes nor holds, is no contact.
  Real is_certain = at.is_alone;
  if constexpr (HasReach<Law>)
    is_certain = smaller_of(is_certain, larger_of(Real(-state.gap), Law::hold(history)));
  const ContactForceOf<Real> answer = Law::force(pair.parameters, relative, history, dt);
  const Vector elastic_force = elastic * at.direction;
  const Vector other = answer.force - elastic_force;
  const Vector turning = state.lever_a.cross(other);
  Vector torque_a{-turning.x, -turning.y, -turning.z};
  Vector torque_b = state.lever_b.cross(other);
  if constexpr (HasMoments<Law>) {
    torque_a = torque_a - answer.moment;
    torque_b = torque_b + answer.moment;
  }
  const Real has_lever = bodies.range + state.gap;
  const Real unturned = last.normal.dot(at.direction);
  const Real untwisted = Real(geometry::kSmallAngleSquared) - rotation.twist * rotation.twist;
  const LoneAnswerOf<Real, History> answers{
      at.weights,
      elastic_force + other,
      torque_a,
      torque_b,
      {history, at.direction},
      state.foot,
      state.gap,
      lost + answer.dissipated,
      geometry::detail::smallest_of(has_lever, unturned, untwisted, is_certain)};
  geometry::scatter_numbers<W>(
      answers, [&](std::size_t lane) __attribute__((always_inline)) {
        return reinterpret_cast<double*>(&answers_[first + lane]);
      });
}

/// Pairs of a ball with the inside of one facet, as far as one can tell beforehand. Empty for a law
/// that is not written for lanes.
template <ContactLaw Law>
struct LonePairs {};
template <LaneLaw Law>
struct LonePairs<Law> {
  std::array<geometry::FaceId, kLoneLanes> face;
  LoneBlock<Law> block;
};

/// LoneBlock::advance with the widest vectors there are.
template <LaneLaw Law>
void advance_side_by_side(LoneBlock<Law>& block, const Motion& motion, double dt) noexcept {
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    block.template advance<width>(motion, dt);
  });
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/law/any_law.hpp"
#include "contact/law/lane_law.hpp"
#include "contact/sphere_surface/facets_beside.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/gather.hpp"
#include "geometry/base/vector_width.hpp"
#include "geometry/closest/face_foot.hpp"
#include "geometry/primitives/feature.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

/// Spheres that touch the inside of one facet each, side by side: what the way for one at a time
/// and the general way make of each, to the last bit.
namespace plekton::contact {

/// A sphere (first) and the corners of a facet, as they stand and move.
template <class Real>
struct SingleFeatureMotionOf {
  std::array<Vec3Of<Real>, 4> position;  ///< m
  std::array<Vec3Of<Real>, 4> velocity;  ///< m/s
  std::array<Vec3Of<Real>, 4> spin;      ///< rad/s
  Real radius;                           ///< m, of the sphere
  Real range;                            ///< m, radius of sphere + radius of facet
};

/// The relative motion at the contact point, as single_feature_state() has it.
template <class Real>
struct SingleFeatureKinematicsOf {
  Real gap;               ///< m
  Vec3Of<Real> foot;      ///< m, from the sphere's centre
  Vec3Of<Real> lever_a;   ///< m, from the sphere's centre to the contact point
  Vec3Of<Real> lever_b;   ///< m, from the foot to the contact point
  Vec3Of<Real> velocity;  ///< m/s, of the facet relative to the sphere
  Vec3Of<Real> spin;      ///< rad/s, of the facet relative to the sphere
  Real twist_rate;        ///< rad/s
};

template <class Real>
PLEKTON_INLINE SingleFeatureKinematicsOf<Real> single_feature_kinematics(
    const SingleFeatureMotionOf<Real>& motion, const geometry::FaceFootOf<Real>& at) noexcept {
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

/// What a step of a sphere and a facet came to, side by side.
template <class Real, class History>
struct SingleFeatureAnswerOf {
  Vec3Of<Real> weights;   ///< of the corners
  Vec3Of<Real> force_b;   ///< N, on the facet
  Vec3Of<Real> torque_a;  ///< N m
  Vec3Of<Real> torque_b;  ///< N m
  Vec3Of<Real> normal;    ///< unit
  Vec3Of<Real> foot;      ///< m, from the sphere's centre
  Real gap;               ///< m
  Real dissipated;        ///< J, by the law
  /// Positive if these are the answers; else another feature may be in range, the sphere has left,
  /// or the normal has turned by more than 90 degrees, or the frame twisted too far for lanes.
  Real is_right;
  History history;
};

/// One step of spheres and facets, side by side.
/// @param at  nearest points of the facets
/// @param history, last_normal  of the last step
template <LaneLaw Law, class Real>
PLEKTON_INLINE SingleFeatureAnswerOf<Real, typename Law::template HistoryOf<Real>>
advance_single_features(const SingleFeatureMotionOf<Real>& bodies,
                        const geometry::FaceFootOf<Real>& at,
                        const typename Law::template ParametersOf<Real>& parameters,
                        typename Law::template HistoryOf<Real> history,
                        const Vec3Of<Real>& last_normal, double dt) noexcept {
  using Vector = Vec3Of<Real>;
  const SingleFeatureKinematicsOf<Real> state = single_feature_kinematics(bodies, at);
  const FrameRotationOf<Real> rotation{last_normal, at.direction, Real(dt) * state.twist_rate};
  Law::rotate(history, rotation);
  const Real elastic = Law::elastic_normal_force(parameters, state.gap);
  const RelativeMotionOf<Real> relative =
      relative_motion<Real>(at.direction, state.gap, elastic, state.velocity, state.spin);
  // What is within reach, but neither pushes nor holds, is no contact.
  Real is_certain = at.is_alone;
  if constexpr (HasInteractionRange<Law>)
    is_certain = smaller_of(is_certain, larger_of(Real(-state.gap), Law::hold(history)));
  const ContactForceOf<Real> answer = Law::force(parameters, relative, history, dt);
  const Vector elastic_force = elastic * at.direction;
  const Vector other = answer.force - elastic_force;
  const Vector turning = state.lever_a.cross(other);
  // A moment of 0 is added too: as in the general way, a zero may get another sign by it.
  const Vector torque_a = Vector{-turning.x, -turning.y, -turning.z} - answer.moment;
  const Vector torque_b = state.lever_b.cross(other) + answer.moment;
  const Real has_lever = bodies.range + state.gap;
  const Real unturned = last_normal.dot(at.direction);
  const Real untwisted = Real(geometry::kSmallAngleSquared) - rotation.twist * rotation.twist;
  return {at.weights,
          elastic_force + other,
          torque_a,
          torque_b,
          at.direction,
          state.foot,
          state.gap,
          answer.dissipated,
          geometry::detail::smallest_of(has_lever, unturned, untwisted, is_certain),
          history};
}

/// The same of one: its numbers.
class SingleFeatureAnswer {
 public:
  Vec3 weights() const noexcept { return vector(0); }
  Vec3 force_b() const noexcept { return vector(3); }
  Vec3 torque_a() const noexcept { return vector(6); }
  Vec3 torque_b() const noexcept { return vector(9); }
  Vec3 normal() const noexcept { return vector(12); }
  Vec3 foot() const noexcept { return vector(15); }
  double gap() const noexcept { return numbers_[18]; }
  double dissipated() const noexcept { return numbers_[19]; }
  bool is_right() const noexcept { return numbers_[20] > 0.0; }
  void get_history(const AnyLaw::Functions& law, AnyLaw::History& history) const noexcept {
    history.law = &law;
    std::copy_n(numbers_.data() + kHistory, law.history_numbers, history.numbers.data());
  }
  double* numbers() noexcept { return numbers_.data(); }

 private:
  static constexpr std::size_t kHistory = 21;
  static constexpr std::size_t kCount =
      geometry::touched_numbers(int{kHistory} + int{AnyLaw::kMostHistoryNumbers});
  Vec3 vector(std::size_t first) const noexcept {
    return {numbers_[first], numbers_[first + 1], numbers_[first + 2]};
  }
  alignas(64) std::array<double, kCount> numbers_;
};

/// Spheres in a batch: all that it reads and writes fits into the first level of a cache.
constexpr std::size_t kSingleFeatureLanes = 32;

/// Up to kSingleFeatureLanes spheres and facets, of any laws that are written for contacts side by
/// side.
class SingleFeatureBatch {
 public:
  /// What a lane reads.
  struct Lane {
    std::array<NodeId, 4> nodes;  ///< of the sphere, and the corners
    double radius;                ///< m, of the sphere
    double range;                 ///< m, radius of sphere + radius of surface
    const AnyLaw::Parameters* parameters;
    const ContactMemory<AnyLaw>* memory;  ///< of the last step
    SideFlags sides;                      ///< that do not keep the facet from being touched alone
  };

  /// One more; not more than kSingleFeatureLanes.
  void add(const Lane& lane) noexcept { lanes_[count_++] = lane; }
  void clear() noexcept { count_ = 0; }
  std::size_t count() const noexcept { return count_; }
  const SingleFeatureAnswer& answer(std::size_t lane) const noexcept { return answers_[lane]; }

  /// One step of all.
  void advance(const Motion& motion, double dt) {
    std::array<bool, kSingleFeatureLanes> is_done{};
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_done[i]) continue;
      const AnyLaw::Functions* const law = lanes_[i].parameters->law;
      chosen_count_ = 0;
      for (std::size_t k = i; k < count_; ++k) {
        if (lanes_[k].parameters->law != law) continue;
        chosen_[chosen_count_++] = static_cast<std::uint8_t>(k);
        is_done[k] = true;
      }
      law->advance_single_feature(*this, motion, dt);
    }
  }

  /// One step of those of one law, W at a time.
  template <LaneLaw Law, int W>
  PLEKTON_INLINE void advance_chosen(const Motion& motion, double dt) noexcept {
    for (std::size_t i = chosen_count_; i % std::size_t{W} != 0; ++i) chosen_[i] = chosen_[i - 1];
    for (std::size_t first = 0; first < chosen_count_; first += std::size_t{W})
      advance_lanes<Law, W>(&chosen_[first], motion, dt);
  }

 private:
  template <int W>
  PLEKTON_INLINE SingleFeatureMotionOf<Pack<W>> motion_of(const std::uint8_t* chosen,
                                                          const Motion& motion) const noexcept;
  template <LaneLaw Law, int W>
  PLEKTON_INLINE void advance_lanes(const std::uint8_t* chosen, const Motion& motion,
                                    double dt) noexcept;

  std::array<Lane, kSingleFeatureLanes> lanes_;
  std::array<SingleFeatureAnswer, kSingleFeatureLanes> answers_;
  std::size_t count_ = 0;
  std::array<std::uint8_t, kSingleFeatureLanes> chosen_;  ///< lanes of one law
  std::size_t chosen_count_ = 0;
};

template <int W>
PLEKTON_INLINE SingleFeatureMotionOf<Pack<W>> SingleFeatureBatch::motion_of(
    const std::uint8_t* chosen, const Motion& motion) const noexcept {
  using Vector = Vec3Of<Pack<W>>;
  const auto of_node = [&](std::size_t k, std::span<const Vec3> v) __attribute__((always_inline)) {
    return geometry::gather_vectors<W>([&](std::size_t lane) __attribute__((always_inline))
                                           ->const Vec3& {
                                             return v[index_of(lanes_[chosen[lane]].nodes[k])];
                                           });
  };
  const auto all = [&](std::span<const Vec3> v) __attribute__((always_inline)) {
    return std::array<Vector, 4>{of_node(0, v), of_node(1, v), of_node(2, v), of_node(3, v)};
  };
  std::array<double, std::size_t{W}> radius, range;
  for (std::size_t lane = 0; lane < std::size_t{W}; ++lane) {
    radius[lane] = lanes_[chosen[lane]].radius;
    range[lane] = lanes_[chosen[lane]].range;
  }
  return {all(motion.position), all(motion.velocity), all(motion.angular_velocity),
          Pack<W>::load(radius.data()), Pack<W>::load(range.data())};
}

template <LaneLaw Law, int W>
PLEKTON_INLINE void SingleFeatureBatch::advance_lanes(const std::uint8_t* chosen,
                                                      const Motion& motion, double dt) noexcept {
  using Real = Pack<W>;
  using History = typename Law::template HistoryOf<Real>;
  using Parameters = typename Law::template ParametersOf<Real>;
  const auto lane_of = [&](std::size_t k) __attribute__((always_inline))->const Lane& {
    return lanes_[chosen[k]];
  };
  const auto parameters =
      geometry::gather_numbers<Parameters, W>([&](std::size_t k) __attribute__((always_inline)) {
        return lane_of(k).parameters->numbers.data();
      });
  const auto last =
      geometry::gather_numbers<History, W>([&](std::size_t k) __attribute__((always_inline)) {
        return lane_of(k).memory->history.numbers.data();
      });
  const auto last_normal =
      geometry::gather_vectors<W>([&](std::size_t k) __attribute__((always_inline))->const Vec3& {
        return lane_of(k).memory->normal;
      });
  const SingleFeatureMotionOf<Real> bodies = motion_of<W>(chosen, motion);
  Real reach = bodies.range;
  if constexpr (HasInteractionRange<Law>) reach = bodies.range + Law::interaction_range(parameters);
  const auto at = geometry::face_foot<Real>(
      bodies.position[0], {bodies.position[1], bodies.position[2], bodies.position[3]}, reach,
      geometry::gather_vectors<W>([&](std::size_t k) __attribute__((always_inline))
                                      ->const SideFlags& { return lane_of(k).sides; }));
  const auto answers =
      advance_single_features<Law, Real>(bodies, at, parameters, last, last_normal, dt);
  geometry::scatter_numbers<W>(
      answers, [&](std::size_t k)
                   __attribute__((always_inline)) { return answers_[chosen[k]].numbers(); });
}

/// SingleFeatureBatch::advance_chosen with the widest vectors there are.
template <LaneLaw Law>
void advance_single_feature(SingleFeatureBatch& batch, const Motion& motion, double dt) {
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    batch.template advance_chosen<Law, width>(motion, dt);
  });
}

}  // namespace plekton::contact

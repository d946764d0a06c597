// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/law/lane_law.hpp"
#include "contact/sphere_sphere/sphere_kernel.hpp"
#include "geometry/base/lane_rows.hpp"
#include "geometry/base/rows.hpp"
#include "geometry/base/vector_width.hpp"

#include <array>

/// Touching pairs of spheres of one law in batches, so that a processor computes as many contacts
/// at once as its vectors have lanes: pairs are gathered into rows of numbers, the kernel runs
/// along the rows, and the results are taken out again.
namespace plekton::contact {

/// What a step of pairs side by side came to.
template <LaneLaw Law, class Real>
struct LaneStepOf {
  Real touch;  ///< 1 if the pair touches or goes on over a distance, else 0
  SphereStepOf<Real> step;
  typename Law::template HistoryOf<Real> history;
  Vec3Of<Real> normal;
  Real smaller_radius;  ///< m
  /// Positive where the answer is right: the centres do not coincide, the normal has not turned by
  /// more than 90 degrees, nor the pair twisted further than the series of
  /// geometry::cosine_and_sinc goes.
  Real is_right;
};

/// One step of pairs that touch.
/// @param touch  1 if the spheres overlap, else 0
/// @param history, last_normal  of the last step; all zero in a new contact
template <LaneLaw Law, class Real>
PLEKTON_INLINE LaneStepOf<Law, Real> advance_lanes(
    const SphereMotionOf<Real>& spheres, const Real& touch,
    const typename Law::template ParametersOf<Real>& parameters,
    typename Law::template HistoryOf<Real> history, const Vec3Of<Real>& last_normal,
    double dt) noexcept {
  const Real distance = spheres.separation.norm();
  const SpherePairOf<Real> pair = spheres.at((Real(1.0) / distance) * spheres.separation, distance);
  Real touch_or_hold = touch;
  if constexpr (HasInteractionRange<Law>)
    touch_or_hold = geometry::flag(
        larger_of(touch, goes_on_side_by_side<Law, Real>(
                             parameters, history, distance - (pair.radius_a + pair.radius_b))) >
        Real(0.0));
  const FrameRotationOf<Real> rotation{last_normal, pair.normal, Real(dt) * pair.twist_rate()};
  Law::rotate(history, rotation);
  const SphereStepOf<Real> step = sphere_step<Law>(pair, parameters, history, dt);
  const Real smaller = geometry::smaller_of(pair.radius_a, pair.radius_b);
  const Real untwisted = Real(geometry::kSmallAngleSquared) - rotation.twist * rotation.twist;
  const Real unturned = select(Real(0.0) > rotation.from.dot(rotation.to), Real(-1.0), Real(1.0));
  return {touch_or_hold, step,
          history,       pair.normal,
          smaller,       geometry::smaller_of(distance, geometry::smaller_of(untwisted, unturned))};
}

/// Pairs in a batch: all rows together fit into the first level of a cache.
constexpr std::size_t kBatchLanes = 64;

/// Up to kBatchLanes touching pairs.
struct SphereBatch {
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kBatchLanes>;
  using NumberRows = geometry::LaneRows<kBatchLanes>;

  // Filled in for each pair:
  RowsOf<Vec3> separation;  ///< m, from centre a to centre b, not zero
  RowsOf<Vec3> velocity;    ///< m/s, of centre b relative to centre a
  RowsOf<Vec3> spin_a;      ///< rad/s
  RowsOf<Vec3> spin_b;      ///< rad/s
  RowsOf<double> radius_a;  ///< m
  RowsOf<double> radius_b;  ///< m
  NumberRows parameters() noexcept { return NumberRows(parameters_.data()); }  ///< of the law
  // Filled in, and brought to the end of the step:
  NumberRows history() noexcept { return NumberRows(history_.data()); }
  RowsOf<Vec3> normal;  ///< unit, of the last step; zero before the first
  // Answers:
  RowsOf<double> gap;         ///< m
  RowsOf<Vec3> force;         ///< N, on b
  RowsOf<Vec3> torque_a;      ///< N m, on a
  RowsOf<double> dissipated;  ///< J
  RowsOf<double> is_right;    ///< positive if these are the answers; see LaneStepOf

  /// One step of the first count pairs, W at a time; the lanes up to the next multiple of W hold
  /// any numbers.
  /// @returns whether all answers are right
  template <LaneLaw Law, int W>
  PLEKTON_INLINE bool advance(std::size_t count, double dt) noexcept {
    for (std::size_t lane = 0; lane < count; lane += std::size_t{W})
      advance_lanes<Law, W>(lane, dt);
    bool all_right = true;
    for (std::size_t lane = 0; lane < count; ++lane) all_right &= is_right.number(lane) > 0.0;
    return all_right;
  }

 private:
  template <LaneLaw Law, int W>
  PLEKTON_INLINE void advance_lanes(std::size_t lane, double dt) noexcept;

  alignas(64) std::array<double, AnyLaw::kMostNumbers * kBatchLanes> parameters_;
  alignas(64) std::array<double, AnyLaw::kMostHistoryNumbers * kBatchLanes> history_;
};

template <LaneLaw Law, int W>
PLEKTON_INLINE void SphereBatch::advance_lanes(std::size_t lane, double dt) noexcept {
  using Real = Pack<W>;
  using Vector = Vec3Of<Real>;
  const SphereMotionOf<Real> spheres{
      separation.template load<Vector>(lane), velocity.template load<Vector>(lane),
      spin_a.template load<Vector>(lane),     spin_b.template load<Vector>(lane),
      radius_a.template load<Real>(lane),     radius_b.template load<Real>(lane)};
  const auto answer = contact::advance_lanes<Law, Real>(
      spheres, Real(1.0),
      parameters().template load<typename Law::template ParametersOf<Real>, W>(lane),
      history().template load<typename Law::template HistoryOf<Real>, W>(lane),
      normal.template load<Vector>(lane), dt);
  history().template store<W>(lane, answer.history);
  normal.store(lane, answer.normal);
  gap.store(lane, answer.step.gap);
  force.store(lane, answer.step.force);
  Vector torque = answer.step.arm_a * answer.step.force_cross_normal;
  if constexpr (HasMoments<Law>) torque = torque - answer.step.moment;
  torque_a.store(lane, torque);
  dissipated.store(lane, answer.step.dissipated);
  is_right.store(lane, answer.is_right);
}

/// SphereBatch::advance with the widest vectors there are.
template <LaneLaw Law>
bool advance_batch(SphereBatch& batch, std::size_t count, double dt) {
  bool all_right = false;
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    all_right = batch.template advance<Law, width>(count, dt);
  });
  return all_right;
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/ball_kernel.hpp"
#include "geometry/rows.hpp"
#include "geometry/vector_width.hpp"

#include <concepts>

/// Touching pairs of balls in blocks, so that a processor computes as many contacts at once as its
/// vectors have lanes: pairs are gathered into rows of numbers, the kernel runs along the rows, and
/// the results are taken out again.
namespace plekton::contact {

using geometry::Pack;

/// A law written for any Real: it may be asked about contacts side by side. Its ParametersOf and
/// HistoryOf consist of Reals and Vec3Of<Real> only, and nothing in them branches.
///
/// A new history turned from the normal 0 stays new: rotate() is linear in what it turns.
template <class Law>
concept LaneLaw = ContactLaw<Law> &&
    requires(const typename Law::template ParametersOf<Pack<2>>& parameters,
             const RelativeMotionOf<Pack<2>>& motion,
             typename Law::template HistoryOf<Pack<2>>& history,
             const FrameRotationOf<Pack<2>>& rotation, const Pack<2>& gap) {
  requires std::same_as < typename Law::template ParametersOf<double>,
  typename Law::Parameters > ;
  requires std::same_as < typename Law::template HistoryOf<double>,
  typename Law::History > ;
  { Law::elastic_normal_force(parameters, gap) } -> std::same_as<Pack<2>>;
  { Law::force(parameters, motion, history, 1.0) } -> std::same_as<ContactForceOf<Pack<2>>>;
  Law::rotate(history, rotation);
};

/// Pairs in a block: all rows together fit into the first level of a cache.
constexpr std::size_t kBlockLanes = 64;

/// Up to kBlockLanes touching pairs.
template <LaneLaw Law>
struct BallBlock {
  template <class Thing>
  using RowsOf = geometry::RowsOf<Thing, kBlockLanes>;

  // Filled in for each pair:
  RowsOf<Vec3> separation;  ///< m, from centre a to centre b, not zero
  RowsOf<Vec3> velocity;    ///< m/s, of centre b relative to centre a
  RowsOf<Vec3> spin_a;      ///< rad/s
  RowsOf<Vec3> spin_b;      ///< rad/s
  RowsOf<double> radius_a;  ///< m
  RowsOf<double> radius_b;  ///< m
  RowsOf<typename Law::Parameters> parameters;
  // Filled in, and brought to the end of the step:
  RowsOf<typename Law::History> history;
  RowsOf<Vec3> normal;  ///< unit, of the last step; zero before the first
  // Answers:
  RowsOf<double> gap;            ///< m
  RowsOf<Vec3> force;            ///< N, on b
  RowsOf<Vec3> torque_a;         ///< N m, on a
  RowsOf<Vec3> torque_b;         ///< N m, on b
  RowsOf<double> dissipated;     ///< J
  RowsOf<double> overlap_ratio;  ///< overlap over the radius of the smaller ball
  RowsOf<double> carries_on;  ///< 1 if the history could be carried over side by side, else 0: the
                              ///< answer is wrong

  /// One step of the first count pairs, W at a time; the lanes up to the next multiple of W hold
  /// any numbers.
  /// @returns whether all answers are right: no centres coincide, no normal turned by more than 90
  /// degrees, no pair
  ///          twisted further than the series of geometry::cosine_and_sinc goes
  template <int W>
  PLEKTON_INLINE bool advance(std::size_t count, double dt) noexcept {
    for (std::size_t lane = 0; lane < count; lane += std::size_t{W})
      advance_lanes<Pack<W>>(lane, dt);
    bool all_carry_on = true;
    for (std::size_t lane = 0; lane < count; ++lane) all_carry_on &= carries_on.number(lane) > 0.0;
    return all_carry_on;
  }

 private:
  template <class Real>
  PLEKTON_INLINE void advance_lanes(std::size_t lane, double dt) noexcept;
};

template <LaneLaw Law>
template <class Real>
PLEKTON_INLINE void BallBlock<Law>::advance_lanes(std::size_t lane, double dt) noexcept {
  using Vector = Vec3Of<Real>;
  const auto between = separation.template load<Vector>(lane);
  const Real distance = between.norm();
  const BallPairOf<Real> pair{
      (Real(1.0) / distance) * between,     distance,
      velocity.template load<Vector>(lane), spin_a.template load<Vector>(lane),
      spin_b.template load<Vector>(lane),   radius_a.template load<Real>(lane),
      radius_b.template load<Real>(lane)};
  const FrameRotationOf<Real> rotation{normal.template load<Vector>(lane), pair.normal,
                                       Real(dt) * pair.twist_rate()};
  auto turned = history.template load<typename Law::template HistoryOf<Real>>(lane);
  Law::rotate(turned, rotation);
  const BallStepOf<Real> step = ball_step<Law>(
      pair, parameters.template load<typename Law::template ParametersOf<Real>>(lane), turned, dt);
  history.store(lane, turned);
  normal.store(lane, pair.normal);
  gap.store(lane, step.gap);
  force.store(lane, step.force);
  torque_a.store(lane, step.torque_a);
  torque_b.store(lane, step.torque_b);
  dissipated.store(lane, step.dissipated);
  overlap_ratio.store(
      lane, -step.gap / select(pair.radius_b > pair.radius_a, pair.radius_a, pair.radius_b));
  const Real zero = 0.0;
  const Real one = 1.0;
  const Real untwisted =
      select(Real(geometry::kSmallAngleSquared) > rotation.twist * rotation.twist, one, zero);
  const Real unturned = select(zero > rotation.from.dot(rotation.to), zero, untwisted);
  carries_on.store(lane, select(distance > zero, unturned, zero));
}

/// BallBlock::advance with the widest vectors there are.
template <LaneLaw Law>
bool advance_side_by_side(BallBlock<Law>& block, std::size_t count, double dt) noexcept {
  bool is_right = false;
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    is_right = block.template advance<width>(count, dt);
  });
  return is_right;
}

}  // namespace plekton::contact

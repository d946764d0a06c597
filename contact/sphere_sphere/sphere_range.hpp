// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/lane_law.hpp"
#include "contact/sphere_sphere/block_outcome.hpp"
#include "contact/sphere_sphere/sphere_batch.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_states.hpp"
#include "contact/sphere_sphere/sphere_sums.hpp"
#include "contact/sphere_sphere/touched_lanes.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/lane_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

/// One step of pairs of spheres of one law: the hot loop of a bed of spheres. The law is known as a
/// type here, and chosen at run time by whoever calls (AnyLaw::Functions::advance_spheres).
namespace plekton::contact {

/// What is kept about the pairs of a row: numbers side by side, each a line of the cache.
struct PairNumbersOfRow {
  static constexpr std::size_t kNormal = 0;   ///< unit, of the last step; zero: did not touch
  static constexpr std::size_t kGap = 3;      ///< m, of the last step, of pairs that touched
  static constexpr std::size_t kHistory = 4;  ///< of the law
};

/// Rows of pairs of one law that follow each other in a block.
struct SphereRange {
  const SphereBlocks::Pair* pairs;  ///< of the first row
  double* numbers;                  ///< of the first row
  TouchedLanes* touched;            ///< by row
  std::size_t row_count;
  std::size_t row_size;    ///< numbers from a row to the next
  std::size_t force;       ///< where forces (N, on b) are among the numbers of a row; 0: not kept
  std::size_t parameters;  ///< where parameters of the law are; 0: not kept
  const Material* common;  ///< of all spheres, where parameters are not kept
  bool was_apart;          ///< no pair touched when the list was made
};

/// What one thread works with: on lines of its own, since it writes to them with every row.
struct alignas(64) SphereWork {
  SphereStates spheres;
  std::vector<SphereSum> sums;  ///< of the block's members
  double dt;
  BlockOutcome<SphereBlocks::kLanes> outcome;
};

/// Of W pairs side by side, what each does to one of its spheres.
template <int W>
class ForcesOfLanes {
 public:
  PLEKTON_INLINE ForcesOfLanes(const Vec3Of<Pack<W>>& force,
                               const Vec3Of<Pack<W>>& torque) noexcept {
    const Pack<W> none = 0.0;
    geometry::scatter_things<W, 8>(
        {force.x, force.y, force.z, torque.x, torque.y, torque.z, none, none},
        [&](std::size_t k) __attribute__((always_inline)) { return lanes_[k].numbers.data(); });
  }
  PLEKTON_INLINE const SphereForce& operator[](std::size_t lane) const noexcept {
    return lanes_[lane];
  }

 private:
  std::array<SphereForce, std::size_t{W}> lanes_;
};

template <ContactLaw Law>
class SphereLoop {
 public:
  SphereLoop(const SphereRange& range, SphereWork& work) noexcept : range_(range), work_(work) {}

  template <int W>
  PLEKTON_INLINE void advance() const noexcept {
    for (std::size_t row = 0; row < range_.row_count; ++row) {
      prefetch(std::min(row + kRowsAhead, range_.row_count - 1));
      // Most rows of pairs that were apart when the list was made still are.
      if (range_.was_apart && !range_.touched[row].any() &&
          !work_.spheres.template any_touch<W>(pairs(row)))
        continue;
      for (std::size_t lane = 0; lane < kLanes; lane += std::size_t{W}) {
        if constexpr (LaneLaw<Law>) {
          if (advance_side_by_side<W>(row, lane)) continue;
        }
        for (std::size_t k = lane; k < lane + std::size_t{W}; ++k) advance_one(row, k);
      }
    }
  }

 private:
  static constexpr std::size_t kLanes = SphereBlocks::kLanes;
  /// A row takes some hundred cycles, as much as memory does to answer.
  static constexpr std::size_t kRowsAhead = 4;
  using Rows = geometry::LaneRows<kLanes>;
  using Parameters = typename Law::Parameters;

  const SphereBlocks::Pair* pairs(std::size_t row) const noexcept {
    return range_.pairs + row * kLanes;
  }
  Rows rows(std::size_t row) const noexcept { return Rows(range_.numbers + row * range_.row_size); }
  static Rows normal(const Rows& rows) noexcept { return rows.from(PairNumbersOfRow::kNormal); }
  static Rows gap(const Rows& rows) noexcept { return rows.from(PairNumbersOfRow::kGap); }
  static Rows history(const Rows& rows) noexcept { return rows.from(PairNumbersOfRow::kHistory); }

  /// Asks for what a step will read of a row.
  PLEKTON_INLINE void prefetch(std::size_t row) const noexcept {
    __builtin_prefetch(pairs(row));
    if (range_.was_apart && !range_.touched[row].any()) return;
    const double* const numbers = range_.numbers + row * range_.row_size;
    for (std::size_t n = 0; n < range_.row_size; n += kLanes) __builtin_prefetch(numbers + n);
  }

  /// Of W pairs from a lane of a row on.
  template <class Numbers, class Real, int W>
  PLEKTON_INLINE Numbers parameters(const Rows& rows, std::size_t lane,
                                    const SphereMotionOf<Real>& spheres) const noexcept {
    if constexpr (CombinesRadii<Law>) {
      if (range_.common)
        return Law::combine(*range_.common, spheres.radius_a, *range_.common, spheres.radius_b);
    }
    const Rows kept = rows.from(range_.parameters);
    if constexpr (W == 1)
      return kept.template at<Numbers>(lane);
    else
      return kept.template load<Numbers, W>(lane);
  }

  /// One step of W pairs from a lane on. @returns whether all of them could be computed side by
  /// side; otherwise nothing has been done
  template <int W>
  PLEKTON_INLINE bool advance_side_by_side(std::size_t row, std::size_t lane) const noexcept;
  template <int W>
  PLEKTON_INLINE void add_outcome(std::size_t lane,
                                  const LaneStepOf<Law, Pack<W>>& answer) const noexcept;
  template <int W>
  PLEKTON_INLINE void add_forces(const SphereBlocks::Pair* pairs,
                                 const LaneStepOf<Law, Pack<W>>& answer) const noexcept;
  /// One step of a pair, whatever happened to it.
  void advance_one(std::size_t row, std::size_t lane) const noexcept;
  void add_one(std::size_t lane, const SphereBlocks::Pair& members,
               const SpherePairOf<double>& pair, const SphereStepOf<double>& step) const noexcept;

  const SphereRange& range_;
  SphereWork& work_;
};

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE bool SphereLoop<Law>::advance_side_by_side(std::size_t row,
                                                          std::size_t lane) const noexcept {
  using Real = Pack<W>;
  using Vector = Vec3Of<Real>;
  using History = typename Law::template HistoryOf<Real>;
  const SphereBlocks::Pair* const members = pairs(row) + lane;
  const SphereMotionOf<Real> spheres = work_.spheres.template pairs<W>(members);
  const Real overlaps = spheres.touch();
  const unsigned overlapping = bits_of(overlaps);
  const unsigned touched = range_.touched[row].from(lane) & geometry::kAllBits<W>;
  if ((overlapping | touched) == 0) return true;

  const Rows kept = rows(row);
  const auto answer = advance_lanes<Law, Real>(
      spheres, overlaps,
      parameters<typename Law::template ParametersOf<Real>, Real, W>(kept, lane, spheres),
      history(kept).template load<History, W>(lane), normal(kept).template load<Vector, W>(lane),
      work_.dt);
  const unsigned touching = HasInteractionRange<Law> ? bits_of(answer.touch) : overlapping;
  const unsigned right = bits_of(geometry::flag(answer.is_right > 0.0));
  if ((touching & right) != (touching | touched)) return false;

  range_.touched[row].set(lane, geometry::kAllBits<W>, touching);
  history(kept).template store<W>(lane, answer.history, answer.touch);
  normal(kept).template store<W>(lane, answer.normal, answer.touch);
  gap(kept).template store<W>(lane, answer.step.gap);
  if constexpr (!TellsForce<Law>)
    kept.from(range_.force).template store<W>(lane, answer.step.force);
  work_.outcome.touching += static_cast<std::size_t>(std::popcount(touching));
  add_outcome<W>(lane, answer);
  add_forces<W>(members, answer);
  return true;
}

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE void SphereLoop<Law>::add_outcome(
    std::size_t lane, const LaneStepOf<Law, Pack<W>>& answer) const noexcept {
  using Real = Pack<W>;
  auto& outcome = work_.outcome;
  double* const dissipated = &outcome.dissipated[lane];
  (Real::load(dissipated) + select(answer.touch > 0.0, answer.step.dissipated, 0.0))
      .store(dissipated);
  // Ratios are compared without division; of pairs that do not touch they are not positive.
  const Real overlap = -answer.step.gap;
  const Real deepest = Real::load(&outcome.overlap[lane]);
  const Real its_radius = Real::load(&outcome.radius[lane]);
  const auto is_deeper = overlap * its_radius > deepest * answer.smaller_radius;
  select(is_deeper, overlap, deepest).store(&outcome.overlap[lane]);
  select(is_deeper, answer.smaller_radius, its_radius).store(&outcome.radius[lane]);
}

/// Pairs that do not touch add zeros: cheaper than asking each. (Factors of each lane by itself, as
/// arms would be if they came after the numbers have changed places, GCC 12 puts together number by
/// number.)
template <ContactLaw Law>
template <int W>
PLEKTON_INLINE void SphereLoop<Law>::add_forces(
    const SphereBlocks::Pair* pairs, const LaneStepOf<Law, Pack<W>>& answer) const noexcept {
  using Real = Pack<W>;
  const auto if_touching = [&](const Vec3Of<Real>& v) __attribute__((always_inline)) {
    const auto touches = answer.touch > 0.0;
    return Vec3Of<Real>{select(touches, v.x, 0.0), select(touches, v.y, 0.0),
                        select(touches, v.z, 0.0)};
  };
  const auto opposite = [](const Vec3Of<Real>& v) __attribute__((always_inline)) {
    return Vec3Of<Real>{-v.x, -v.y, -v.z};
  };
  const Vec3Of<Real> force = if_touching(answer.step.force);
  const Vec3Of<Real> cross = if_touching(answer.step.force_cross_normal);
  const ForcesOfLanes<W> on_a(opposite(force), answer.step.arm_a * cross);
  const ForcesOfLanes<W> on_b(force, answer.step.arm_b * cross);
  SphereSum* const sums = work_.sums.data();
  if constexpr (HasMoments<Law>) {
    const Vec3Of<Real> moment = if_touching(answer.step.moment);
    const Real none = 0.0;
    const ForcesOfLanes<W> turns_a({none, none, none}, opposite(moment));
    const ForcesOfLanes<W> turns_b({none, none, none}, moment);
    for (std::size_t k = 0; k < std::size_t{W}; ++k) {
      add_to<W>(sums[pairs[k].a], on_a[k]);
      add_to<W>(sums[pairs[k].a], turns_a[k]);
      add_to<W>(sums[pairs[k].b], on_b[k]);
      add_to<W>(sums[pairs[k].b], turns_b[k]);
    }
  } else {
    for (std::size_t k = 0; k < std::size_t{W}; ++k) {
      add_to<W>(sums[pairs[k].a], on_a[k]);
      add_to<W>(sums[pairs[k].b], on_b[k]);
    }
  }
}

template <ContactLaw Law>
void SphereLoop<Law>::advance_one(std::size_t row, std::size_t lane) const noexcept {
  const Rows kept = rows(row);
  const SphereBlocks::Pair& members = pairs(row)[lane];
  const SphereMotionOf<double> spheres = work_.spheres.pair(members);
  const auto of_pair = parameters<Parameters, double, 1>(kept, lane, spheres);
  ContactMemory<Law> memory{history(kept).template at<typename Law::History>(lane),
                            normal(kept).template at<Vec3>(lane)};
  const auto keep = [&](unsigned touching) {
    history(kept).set(lane, memory.history);
    normal(kept).set(lane, memory.normal);
    range_.touched[row].set(lane, 1, touching);
  };
  const double distance = spheres.separation.norm();
  if (spheres.touch() == 0.0 &&
      (memory.is_new() ||
       !goes_on<Law>(of_pair, memory.history, distance - (spheres.radius_a + spheres.radius_b)))) {
    const LastDisplacement last = last_displacement(spheres.at(memory.normal, distance), work_.dt);
    work_.outcome.dissipated[lane] += forget<Law>(of_pair, memory, last);
    return keep(0);
  }
  // Coincident centres have no direction: the last normal goes on, or else any.
  const Vec3 direction = distance > 0.0    ? Vec3((1.0 / distance) * spheres.separation)
                         : memory.is_new() ? Vec3(Vec3::UnitZ())
                                           : memory.normal;
  const SpherePairOf<double> pair = spheres.at(direction, distance);
  memory = {carried_history<Law>(memory, direction, work_.dt * pair.twist_rate()), direction};
  const SphereStepOf<double> step = sphere_step<Law>(pair, of_pair, memory.history, work_.dt);
  keep(1);
  gap(kept).set(lane, step.gap);
  if constexpr (!TellsForce<Law>) kept.from(range_.force).set(lane, step.force);
  add_one(lane, members, pair, step);
}

template <ContactLaw Law>
void SphereLoop<Law>::add_one(std::size_t lane, const SphereBlocks::Pair& members,
                              const SpherePairOf<double>& pair,
                              const SphereStepOf<double>& step) const noexcept {
  auto& outcome = work_.outcome;
  ++outcome.touching;
  outcome.dissipated[lane] += step.dissipated;
  const double smaller = std::min(pair.radius_a, pair.radius_b);
  if (-step.gap * outcome.radius[lane] > outcome.overlap[lane] * smaller) {
    outcome.overlap[lane] = -step.gap;
    outcome.radius[lane] = smaller;
  }
  SphereSum& a = work_.sums[members.a];
  SphereSum& b = work_.sums[members.b];
  add_to<2>(a, {-step.force, step.arm_a * step.force_cross_normal});
  if constexpr (HasMoments<Law>) add_to<2>(a, {Vec3::Zero(), -step.moment});
  add_to<2>(b, {step.force, step.arm_b * step.force_cross_normal});
  if constexpr (HasMoments<Law>) add_to<2>(b, {Vec3::Zero(), step.moment});
}

/// One step of a range, with the widest vectors there are.
template <ContactLaw Law>
void advance_spheres(const SphereRange& range, SphereWork& work) {
  const SphereLoop<Law> loop(range, work);
  if constexpr (LaneLaw<Law>) {
    geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      loop.template advance<width>();
    });
  } else {
    loop.template advance<2>();
  }
}

}  // namespace plekton::contact

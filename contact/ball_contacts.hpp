// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/ball_block.hpp"
#include "contact/ball_forces.hpp"
#include "contact/ball_rows.hpp"
#include "contact/contact_row.hpp"
#include "contact/material_pairs.hpp"
#include "contact/pair_rows.hpp"
#include "contact/rekey.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Contacts between balls: one slot for each pair that may touch, in the order of the pairs.
template <ContactLaw Law>
class BallContacts {
 public:
  /// Takes a new list of pairs of balls (a < b, sorted); pairs in both lists keep their memory.
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const Ball> balls,
                 const MaterialPairs<Law>& materials);

  /// One step of all contacts: forces are written down, not yet added.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const;

  std::size_t touching() const noexcept { return forces_.size(); }
  /// Largest overlap of the last step over the radius of the smaller ball.
  double largest_overlap_ratio() const noexcept;

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(a, b, parameters, gap) for every touching pair.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    forces_.for_each([&](std::size_t i, const BallForce&) {
      visit(balls_.node(pairs_[i].a), balls_.node(pairs_[i].b),
            rows_of(i).parameters.template at<typename Law::Parameters>(lane_of(i)),
            rows_of(i).gap.number(lane_of(i)));
    });
  }

  template <class Visit>
  void for_each_row(Positions x, Visit&& visit) const;

 private:
  using Rows = PairRows<Law>;
  static constexpr std::size_t kLanes = Rows::kLanes;

  /// A part of the list that one thread works on; sums lane by lane, so that they do not depend on
  /// how many pairs are computed at once.
  struct Chunk {
    BallForces::Chunk forces;
    std::array<double, kLanes> dissipated{};  ///< J
    std::array<double, kLanes> deepest{};     ///< largest overlap over the smaller radius
  };

  static std::size_t lane_of(std::size_t pair) noexcept { return pair % kLanes; }
  const Rows& rows_of(std::size_t pair) const noexcept { return rows_[pair / kLanes]; }
  Rows& rows_of(std::size_t pair) noexcept { return rows_[pair / kLanes]; }

  /// One step of the pairs of a chunk, W at a time where that is possible.
  template <int W>
  PLEKTON_INLINE void advance_chunk(std::size_t begin, std::size_t end, double dt, Chunk& chunk);

  /// One step of W pairs from i on. @returns whether all of them could be computed side by side;
  /// otherwise nothing has been done
  template <int W>
  PLEKTON_INLINE bool advance_side_by_side(std::size_t i, double dt, Chunk& chunk);

  /// One step of a pair, whatever happened to it.
  void advance_one(std::size_t i, double dt, Chunk& chunk);

  BallRows balls_;
  std::vector<geometry::IndexPair> pairs_;  ///< of balls; filled up to whole rows
  std::vector<Rows> rows_;
  BallForces forces_;
  std::vector<double> deepest_;  ///< by chunk
  geometry::ParallelSum<double> sum_;
  std::vector<geometry::IndexPair> old_pairs_;
  std::vector<Rows> old_rows_;
  std::size_t pair_count_ = 0;
};

template <ContactLaw Law>
double BallContacts<Law>::rebuild(std::span<const geometry::IndexPair> keys,
                                  std::span<const Ball> balls,
                                  const MaterialPairs<Law>& materials) {
  double lost = 0.0;
  std::int32_t last = -1;
  for (const geometry::IndexPair& key : keys) last = std::max(last, key.b);
  balls_.assign(balls.first(static_cast<std::size_t>(last + 1)));
  const std::size_t old_count = std::exchange(pair_count_, keys.size());
  pairs_.swap(old_pairs_);
  rows_.swap(old_rows_);
  make_room(rows_, keys.size() / kLanes + 1);
  make_room(pairs_, keys.size() + kLanes);
  rows_.resize((keys.size() + kLanes - 1) / kLanes);
  pairs_.assign(keys.begin(), keys.end());
  pairs_.resize(rows_.size() * kLanes, {balls_.none(), balls_.none()});
  for (std::size_t i = keys.size(); i < pairs_.size(); ++i) rows_of(i).set_new(lane_of(i), {});
  const auto match = [&](std::size_t i, bool is_known, std::size_t old) {
    const Ball& a = balls[static_cast<std::size_t>(keys[i].a)];
    const Ball& b = balls[static_cast<std::size_t>(keys[i].b)];
    if (is_known) {
      rows_of(i).set_from(old_rows_[old / kLanes], lane_of(old), lane_of(i));
    } else {
      rows_of(i).set_new(lane_of(i), materials.combine(a.material, a.radius, b.material, b.radius));
    }
  };
  match_keys({old_pairs_.data(), old_count}, keys, match, [&](std::size_t old) {
    const Rows& rows = old_rows_[old / kLanes];
    ContactMemory<Law> memory = rows.memory(lane_of(old));
    lost +=
        forget<Law>(rows.parameters.template at<typename Law::Parameters>(lane_of(old)), memory);
  });
  forces_.assign(keys, balls_.size());
  deepest_.assign(forces_.chunk_count(), 0.0);
  return lost;
}

template <ContactLaw Law>
double BallContacts<Law>::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  balls_.update(motion, pool);
  const bool alone = pool.thread_count() == 1;
  if (alone) forces_.set_sums_zero();
  const double dissipated = sum_(pair_count_, pool, [&](std::size_t begin, std::size_t end, int) {
    const std::size_t c = begin / BallForces::kChunk;
    Chunk chunk{forces_.chunk(c)};
    geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      advance_chunk<width>(begin, end, dt, chunk);
      forces_.finish(c, chunk.forces);
      if (alone) forces_.add_chunk(c, pairs_);
    });
    deepest_[c] = *std::max_element(chunk.deepest.begin(), chunk.deepest.end());
    return std::accumulate(chunk.dissipated.begin(), chunk.dissipated.end(), 0.0);
  });
  if (!alone) forces_.add_all(pairs_, pool);
  return dissipated;
}

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE void BallContacts<Law>::advance_chunk(std::size_t begin, std::size_t end, double dt,
                                                     Chunk& chunk) {
  for (std::size_t i = begin; i < end; i += std::size_t{W}) {
    if constexpr (LaneLaw<Law>) {
      if (advance_side_by_side<W>(i, dt, chunk)) continue;
    }
    for (std::size_t lane = 0; lane < std::size_t{W}; ++lane) advance_one(i + lane, dt, chunk);
  }
}

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE bool BallContacts<Law>::advance_side_by_side(std::size_t i, double dt,
                                                            Chunk& chunk) {
  using Real = Pack<W>;
  using Vector = Vec3Of<Real>;
  using History = typename Law::template HistoryOf<Real>;
  Rows& rows = rows_of(i);
  const std::size_t lane = lane_of(i);
  const BallMotionOf<Real> balls = balls_.pairs<W>(&pairs_[i]);
  const Real touch = balls.touch();
  const auto last_normal = rows.normal.template load<Vector>(lane);
  const unsigned touching = bits_of(touch);
  const unsigned touched = bits_of(geometry::flag(last_normal.squaredNorm() > 0.0));
  if ((touching | touched) == 0) return true;

  const auto answer = advance_lanes<Law, Real>(
      balls, rows.parameters.template load<typename Law::template ParametersOf<Real>>(lane),
      rows.history.template load<History>(lane), last_normal, dt);
  const unsigned right = bits_of(geometry::flag(answer.is_right > 0.0));
  if ((touching & right) != (touching | touched)) return false;

  rows.history.store(lane, answer.history, touch);
  rows.normal.store(lane, answer.normal, touch);
  rows.gap.store(lane, answer.step.gap);
  double* const dissipated = &chunk.dissipated[lane];
  (Real::load(dissipated) + select(touch > 0.0, answer.step.dissipated, 0.0)).store(dissipated);
  double* const deepest = &chunk.deepest[lane];
  const Real ratio = select(touch > 0.0, answer.overlap_ratio, 0.0);
  select(ratio > Real::load(deepest), ratio, Real::load(deepest)).store(deepest);
  const Vector& force = answer.step.force;
  const Vector& cross = answer.step.force_cross_normal;
  std::array<double*, std::size_t{W}> to;
  for (std::size_t k = 0; k < std::size_t{W}; ++k) {
    BallForce& force_of_lane =
        chunk.forces.next(i % BallForces::kChunk + k, (touching >> k & 1U) != 0);
    to[k] = force_of_lane.force.data();
  }
  geometry::scatter_things<W, 8>(
      {force.x, force.y, force.z, cross.x, cross.y, cross.z, answer.step.arm_a, answer.step.arm_b},
      [&](std::size_t k) __attribute__((always_inline)) { return to[k]; });
  return true;
}

template <ContactLaw Law>
void BallContacts<Law>::advance_one(std::size_t i, double dt, Chunk& chunk) {
  const BallMotionOf<double> balls = balls_.pair(pairs_[i]);
  Rows& rows = rows_of(i);
  const std::size_t lane = lane_of(i);
  const auto parameters = rows.parameters.template at<typename Law::Parameters>(lane);
  ContactMemory<Law> memory = rows.memory(lane);
  if (balls.touch() == 0.0) {
    chunk.dissipated[lane] += forget<Law>(parameters, memory);
    rows.set_memory(lane, memory);
    return;
  }
  const double distance = balls.separation.norm();
  // Coincident centres have no direction: the last normal goes on, or else any.
  const Vec3 normal = distance > 0.0    ? Vec3((1.0 / distance) * balls.separation)
                      : memory.is_new() ? Vec3(Vec3::UnitZ())
                                        : memory.normal;
  const BallPairOf<double> pair{normal,       distance,       balls.velocity, balls.spin_a,
                                balls.spin_b, balls.radius_a, balls.radius_b};
  memory = {carried_history<Law>(memory, normal, dt * pair.twist_rate()), normal};
  const BallStepOf<double> step = ball_step<Law>(pair, parameters, memory.history, dt);
  rows.set_memory(lane, memory);
  rows.gap.set(lane, step.gap);
  chunk.dissipated[lane] += step.dissipated;
  chunk.deepest[lane] =
      std::max(chunk.deepest[lane], -step.gap / std::min(pair.radius_a, pair.radius_b));
  chunk.forces.next(i % BallForces::kChunk, true) = {step.force, step.force_cross_normal,
                                                     step.arm_a, step.arm_b};
}

template <ContactLaw Law>
void BallContacts<Law>::add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
  const std::span<const BallSum> sums = forces_.sums();
  pool.for_each_range(sums.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t ball = begin; ball < end; ++ball) {
      const std::size_t node = index_of(balls_.node(static_cast<std::int32_t>(ball)));
      forces.force[node] += sums[ball].force;
      forces.torque[node] += sums[ball].torque;
    }
  });
}

template <ContactLaw Law>
double BallContacts<Law>::largest_overlap_ratio() const noexcept {
  double deepest = 0.0;
  for (const double of_chunk : deepest_) deepest = std::max(deepest, of_chunk);
  return deepest;
}

template <ContactLaw Law>
double BallContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  forces_.for_each([&](std::size_t i, const BallForce&) {
    const Rows& rows = rows_of(i);
    const auto parameters = rows.parameters.template at<typename Law::Parameters>(lane_of(i));
    energy += Law::elastic_normal_energy(parameters, rows.gap.number(lane_of(i))) +
              Law::history_energy(parameters, rows.memory(lane_of(i)).history);
  });
  return energy;
}

template <ContactLaw Law>
template <class Visit>
void BallContacts<Law>::for_each_row(Positions x, Visit&& visit) const {
  forces_.for_each([&](std::size_t i, const BallForce& force) {
    const Vec3& xa = x[index_of(balls_.node(pairs_[i].a))];
    const Vec3& xb = x[index_of(balls_.node(pairs_[i].b))];
    visit(contact_row(xa, xb, rows_of(i).normal.template at<Vec3>(lane_of(i)),
                      rows_of(i).gap.number(lane_of(i)), force.force));
  });
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/ball_batch.hpp"
#include "contact/sphere_sphere/ball_blocks.hpp"
#include "contact/sphere_sphere/ball_rows.hpp"
#include "contact/sphere_sphere/ball_sums.hpp"
#include "contact/sphere_sphere/block_outcome.hpp"
#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/sphere_sphere/pair_numbers.hpp"
#include "contact/sphere_sphere/pair_parameters.hpp"
#include "contact/sphere_sphere/pair_rows.hpp"
#include "contact/sphere_sphere/touched_lanes.hpp"
#include "contact/tracking/rekey.hpp"
#include "contact/tracking/slip_state.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Contacts between balls: one lane for each pair that may touch, in the blocks of ball_blocks.hpp.
template <ContactLaw Law>
class BallContacts {
 public:
  /// Takes a new list of pairs of balls (a < b, sorted); pairs in both lists keep their memory.
  /// @param balls  must not change until the next list
  /// @param x  m, of nodes, to put what is near together; empty: the balls are in order already
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const Ball> balls,
                 const MaterialPairs<Law>& materials, geometry::ThreadPool& pool, Positions x = {});

  /// One step of all contacts. Sets the forces of all nodes: of those that touch nothing to zero.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, double dt, geometry::ThreadPool& pool, NodeForces& forces);

  std::size_t touching() const noexcept;
  /// Largest overlap of the last step over the radius of the smaller ball.
  double largest_overlap_ratio() const noexcept;

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(a, b, parameters, gap) for every touching pair, in the order of the list.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    for_each_lane([&](const geometry::IndexPair& pair, const Parameters& parameters,
                      const Rows& rows, std::size_t lane) {
      visit(ball(pair.a).node, ball(pair.b).node, parameters, rows.gap.number(lane));
    });
  }

  /// Calls visit(a, b, parameters, gap) for every listed pair that is nearer than a margin (m) with
  /// the nodes where they are now.
  template <class Visit>
  void for_each_near(double margin, Positions x, Visit&& visit) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const Ball &a = ball(keys_[i].a), &b = ball(keys_[i].b);
      const Parameters of_pair = parameters(i);
      const double touch = a.radius + b.radius;
      const double range = touch + margin + reach_of<Law>(of_pair);
      const double squared = (x[index_of(b.node)] - x[index_of(a.node)]).squaredNorm();
      if (squared < range * range) visit(a.node, b.node, of_pair, std::sqrt(squared) - touch);
    }
  }

  /// Gives a number after the last one to every touching pair that has none. A pair keeps its
  /// number as long as it touches.
  void number(std::int64_t& last);

  /// Calls visit(ContactRow) for every touching pair, in the order of the list.
  void for_each_row(Positions x, VisitRow visit) const;

 private:
  using Rows = PairRows<Law>;
  using Parameters = typename Law::Parameters;
  using Pair = BallBlocks::Pair;
  static constexpr std::size_t kLanes = BallBlocks::kLanes;
  /// A row takes some hundred cycles, as much as memory does to answer.
  static constexpr std::size_t kRowsAhead = 4;
  using Outcome = BlockOutcome<kLanes>;
  static_assert(Rows::kLanes == kLanes);

  /// What goes along with a pair from slot to slot.
  struct Moved {
    ContactMemory<Law> memory;
    bool is_numbered = false;
  };

  /// What one thread works with: on lines of its own, since it writes to them with every row.
  struct alignas(64) Work {
    BallRows balls;
    std::vector<BallSum> sums;  ///< of the block's members
    double dt;
    Outcome outcome;
  };

  const Ball& ball(std::int32_t index) const noexcept {
    return balls_[static_cast<std::size_t>(index)];
  }
  /// Of pair i of the list.
  Parameters parameters(std::size_t i) const noexcept {
    return parameters_.of_pair(ball(keys_[i].a), ball(keys_[i].b), blocks_.slot(i));
  }
  bool touched(std::size_t slot) const noexcept {
    return touched_[slot / kLanes].last(slot % kLanes);
  }
  void set_touched(std::size_t row, std::size_t lane, unsigned lanes, unsigned touching) noexcept {
    touched_[row].set(lane, lanes, touching);
  }
  ContactMemory<Law> memory_of(std::size_t slot) const noexcept {
    return rows_[slot / kLanes].memory(slot % kLanes);
  }
  /// From the slots that pairs had in the list before, to those that they have now.
  void move_memories();
  /// Hands the sums of a block's own balls to their nodes, and keeps those of borrowed ones.
  void hand_over(const BallBlocks::Block& block, const Work& work, NodeForces& forces);
  void set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const;
  /// Adds to all nodes what other blocks than their own have of them.
  void return_loans(NodeForces& forces, geometry::ThreadPool& pool) const;
  void advance_block(const BallBlocks::Block& block, const Motion& motion, Work& work);
  /// Asks for what a step will read of a row of a block.
  PLEKTON_INLINE void prefetch(const BallBlocks::Block& block, std::size_t row) const noexcept {
    __builtin_prefetch(blocks_.row(row));
    if (row >= block.stretches[1].first_row && !touched_[row].any()) return;
    const auto* const bytes = reinterpret_cast<const char*>(&rows_[row]);
    for (std::size_t line = 0; line < sizeof(Rows); line += 64) __builtin_prefetch(bytes + line);
  }
  template <int W>
  PLEKTON_INLINE void advance_rows(const BallBlocks::Block& block, Work& work);
  /// One step of W pairs from a lane on. @returns whether all of them could be computed side by
  /// side; otherwise nothing has been done
  template <int W>
  PLEKTON_INLINE bool advance_side_by_side(std::size_t row, std::size_t lane, Work& work);
  /// One step of a pair, whatever happened to it.
  void advance_one(std::size_t row, std::size_t lane, Work& work);

  /// Calls visit(pair, parameters, rows, lane) for every touching pair, in the order of the list.
  template <class Visit>
  void for_each_lane(Visit&& visit) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const std::uint32_t slot = blocks_.slot(i);
      if (touched(slot)) visit(keys_[i], parameters(i), rows_[slot / kLanes], slot % kLanes);
    }
  }

  std::vector<geometry::IndexPair> keys_;  ///< of balls
  std::span<const Ball> balls_;
  BallBlocks blocks_;
  PairParameters<Law> parameters_;
  std::vector<Rows> rows_;
  std::vector<TouchedLanes> touched_;  ///< by row
  PairNumbers numbers_;                ///< of the pairs that touched when they were numbered last
  std::vector<BallSum> lent_;          ///< of balls that blocks borrow
  std::vector<Outcome> outcomes_;      ///< by block
  std::vector<Work> work_;             ///< by thread
  std::vector<std::uint32_t> old_slots_;  ///< by pair of a new list
  std::vector<std::uint32_t> sources_;    ///< by slot of a new list
  std::vector<bool> is_source_;
};

template <ContactLaw Law>
double BallContacts<Law>::rebuild(std::span<const geometry::IndexPair> keys,
                                  std::span<const Ball> balls, const MaterialPairs<Law>& materials,
                                  geometry::ThreadPool& pool, Positions x) {
  balls_ = balls;
  make_room(old_slots_, keys.size());
  old_slots_.assign(keys.size(), kNoSlot);
  double lost = 0.0;
  match_keys(
      keys_, keys,
      [&](std::size_t i, bool is_known, std::size_t old) {
        if (is_known && touched(blocks_.slot(old))) old_slots_[i] = blocks_.slot(old);
      },
      [&](std::size_t old) {
        if (!touched(blocks_.slot(old))) return;
        ContactMemory<Law> memory = memory_of(blocks_.slot(old));
        lost += forget<Law>(materials.combine(ball(keys_[old].a), ball(keys_[old].b)), memory);
      });
  make_room(keys_, keys.size());
  keys_.assign(keys.begin(), keys.end());
  blocks_.assign(keys, balls, pool, x);
  parameters_.assign(keys_, balls_, blocks_, materials);
  move_memories();
  return lost;
}

template <ContactLaw Law>
void BallContacts<Law>::move_memories() {
  const auto resize = [this](std::size_t rows) {
    make_room(rows_, rows);
    make_room(touched_, rows);
    rows_.resize(rows);
    touched_.resize(rows);
  };
  resize(std::max(rows_.size(), blocks_.row_count()));
  make_room(sources_, rows_.size() * kLanes);
  make_room(is_source_, rows_.size() * kLanes);
  sources_.assign(rows_.size() * kLanes, kNoSlot);
  for (std::size_t i = 0; i < keys_.size(); ++i) sources_[blocks_.slot(i)] = old_slots_[i];
  move_slots(
      sources_, is_source_,
      [this](std::uint32_t slot) {
        return Moved{memory_of(slot), touched_[slot / kLanes].since_numbered(slot % kLanes)};
      },
      [this](std::uint32_t slot, const Moved& moved) {
        rows_[slot / kLanes].set(slot % kLanes, moved.memory);
        touched_[slot / kLanes].set_moved(slot % kLanes, !moved.memory.is_new(), moved.is_numbered);
      });
  resize(blocks_.row_count());
}

template <ContactLaw Law>
double BallContacts<Law>::advance(const Motion& motion, double dt, geometry::ThreadPool& pool,
                                  NodeForces& forces) {
  const std::span<const BallBlocks::Block> blocks = blocks_.blocks();
  make_room(lent_, blocks_.borrowed_count());
  lent_.resize(blocks_.borrowed_count());
  outcomes_.resize(blocks.size());
  work_.resize(static_cast<std::size_t>(pool.thread_count()));
  for (Work& work : work_) {
    work.balls.reserve(blocks_.largest_member_count());
    make_room(work.sums, blocks_.largest_member_count());
    work.sums.resize(blocks_.largest_member_count());
    work.dt = dt;
  }
  pool.for_each_shared(blocks.size(), [&](std::size_t k, int worker) {
    Work& work = work_[static_cast<std::size_t>(worker)];
    work.outcome = {};
    advance_block(blocks[k], motion, work);
    outcomes_[k] = work.outcome;
    hand_over(blocks[k], work, forces);
  });
  set_others_zero(forces, pool);
  return_loans(forces, pool);
  double dissipated = 0.0;
  for (const Outcome& outcome : outcomes_) dissipated += outcome.total_dissipated();
  return dissipated;
}

template <ContactLaw Law>
void BallContacts<Law>::advance_block(const BallBlocks::Block& block, const Motion& motion,
                                      Work& work) {
  work.balls.load(blocks_.members(block), motion);
  std::fill_n(work.sums.data(), block.member_count, BallSum{Vec3::Zero(), Vec3::Zero(), {}});
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    advance_rows<width>(block, work);
  });
}

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE void BallContacts<Law>::advance_rows(const BallBlocks::Block& block, Work& work) {
  const std::size_t end = block.first_row + block.row_count;
  for (std::size_t row = block.first_row; row < end; ++row) {
    prefetch(block, std::min(row + kRowsAhead, end - 1));
    // Pairs of the second stretch were apart when the list was made: most rows of theirs still are.
    if (row >= block.stretches[1].first_row && !touched_[row].any() &&
        !work.balls.template any_touch<W>(blocks_.row(row)))
      continue;
    for (std::size_t lane = 0; lane < kLanes; lane += std::size_t{W}) {
      if constexpr (LaneLaw<Law>) {
        if (advance_side_by_side<W>(row, lane, work)) continue;
      }
      for (std::size_t k = lane; k < lane + std::size_t{W}; ++k) advance_one(row, k, work);
    }
  }
}

template <ContactLaw Law>
template <int W>
PLEKTON_INLINE bool BallContacts<Law>::advance_side_by_side(std::size_t row, std::size_t lane,
                                                            Work& work) {
  using Real = Pack<W>;
  using Vector = Vec3Of<Real>;
  using History = typename Law::template HistoryOf<Real>;
  Rows& rows = rows_[row];
  const Pair* const pairs = blocks_.row(row);
  const BallMotionOf<Real> balls = work.balls.template pairs<W>(pairs + lane);
  const Real overlaps = balls.touch();
  const unsigned overlapping = bits_of(overlaps);
  const unsigned touched = touched_[row].from(lane) & geometry::kAllBits<W>;
  if ((overlapping | touched) == 0) return true;

  const auto last_normal = rows.normal.template load<Vector>(lane);
  const auto answer =
      advance_lanes<Law, Real>(balls, overlaps, parameters_.template of_lanes<W>(row, lane, balls),
                               rows.history.template load<History>(lane), last_normal, work.dt);
  const Real& touch = answer.touch;
  const unsigned touching = HasReach<Law> ? bits_of(touch) : overlapping;
  const unsigned right = bits_of(geometry::flag(answer.is_right > 0.0));
  if ((touching & right) != (touching | touched)) return false;

  set_touched(row, lane, geometry::kAllBits<W>, touching);
  rows.history.store(lane, answer.history, touch);
  rows.normal.store(lane, answer.normal, touch);
  rows.gap.store(lane, answer.step.gap);
  if constexpr (!TellsForce<Law>) rows.force.store(lane, answer.step.force);
  Outcome& outcome = work.outcome;
  outcome.touching += static_cast<std::size_t>(std::popcount(touching));
  double* const dissipated = &outcome.dissipated[lane];
  (Real::load(dissipated) + select(touch > 0.0, answer.step.dissipated, 0.0)).store(dissipated);
  // Ratios are compared without division; of pairs that do not touch they are not positive.
  const Real overlap = -answer.step.gap;
  const Real deepest = Real::load(&outcome.overlap[lane]);
  const Real its_radius = Real::load(&outcome.radius[lane]);
  const auto is_deeper = overlap * its_radius > deepest * answer.smaller_radius;
  select(is_deeper, overlap, deepest).store(&outcome.overlap[lane]);
  select(is_deeper, answer.smaller_radius, its_radius).store(&outcome.radius[lane]);

  // Pairs that do not touch add zeros: cheaper than asking each.
  const auto if_touching = [&](const Real& x) { return select(touch > 0.0, x, 0.0); };
  const Vector& force = answer.step.force;
  const Vector& cross = answer.step.force_cross_normal;
  std::array<BallForce, std::size_t{W}> of_lanes;
  geometry::scatter_things<W, 8>(
      {if_touching(force.x), if_touching(force.y), if_touching(force.z), if_touching(cross.x),
       if_touching(cross.y), if_touching(cross.z), answer.step.arm_a, answer.step.arm_b},
      [&](std::size_t k) __attribute__((always_inline)) { return of_lanes[k].force.data(); });
  if constexpr (HasMoments<Law>) {
    const Vector& moment = answer.step.moment;
    std::array<BallMoment, std::size_t{W}> moments;
    const Real none = 0.0;
    geometry::scatter_things<W, 8>(
        {none, none, none, if_touching(moment.x), if_touching(moment.y), if_touching(moment.z),
         none, none},
        [&](std::size_t k) __attribute__((always_inline)) { return moments[k].none.data(); });
    for (std::size_t k = 0; k < std::size_t{W}; ++k) {
      add_to_a(work.sums[pairs[lane + k].a], of_lanes[k], moments[k]);
      add_to_b(work.sums[pairs[lane + k].b], of_lanes[k], moments[k]);
    }
  } else {
    for (std::size_t k = 0; k < std::size_t{W}; ++k) {
      add_to_a(work.sums[pairs[lane + k].a], of_lanes[k]);
      add_to_b(work.sums[pairs[lane + k].b], of_lanes[k]);
    }
  }
  return true;
}

template <ContactLaw Law>
void BallContacts<Law>::advance_one(std::size_t row, std::size_t lane, Work& work) {
  Rows& rows = rows_[row];
  const Pair& members = blocks_.row(row)[lane];
  const BallMotionOf<double> balls = work.balls.pair(members);
  const Parameters parameters = parameters_.of_lane(row, lane, balls);
  ContactMemory<Law> memory = rows.memory(lane);
  Outcome& outcome = work.outcome;
  if (balls.touch() == 0.0 &&
      !goes_on<Law>(parameters, memory.history,
                    balls.separation.norm() - (balls.radius_a + balls.radius_b))) {
    outcome.dissipated[lane] += forget<Law>(parameters, memory);
    rows.set_memory(lane, memory);
    set_touched(row, lane, 1, 0);
    return;
  }
  const double distance = balls.separation.norm();
  // Coincident centres have no direction: the last normal goes on, or else any.
  const Vec3 normal = distance > 0.0    ? Vec3((1.0 / distance) * balls.separation)
                      : memory.is_new() ? Vec3(Vec3::UnitZ())
                                        : memory.normal;
  const BallPairOf<double> pair{normal,       distance,       balls.velocity, balls.spin_a,
                                balls.spin_b, balls.radius_a, balls.radius_b};
  memory = {carried_history<Law>(memory, normal, work.dt * pair.twist_rate()), normal};
  const BallStepOf<double> step = ball_step<Law>(pair, parameters, memory.history, work.dt);
  rows.set_memory(lane, memory);
  set_touched(row, lane, 1, 1);
  rows.gap.set(lane, step.gap);
  if constexpr (!TellsForce<Law>) rows.force.set(lane, step.force);
  ++outcome.touching;
  outcome.dissipated[lane] += step.dissipated;
  const double smaller = std::min(pair.radius_a, pair.radius_b);
  if (-step.gap * outcome.radius[lane] > outcome.overlap[lane] * smaller) {
    outcome.overlap[lane] = -step.gap;
    outcome.radius[lane] = smaller;
  }
  const BallForce force{step.force, step.force_cross_normal, step.arm_a, step.arm_b};
  if constexpr (HasMoments<Law>) {
    const BallMoment moment{Vec3::Zero(), step.moment, {}};
    add_to_a(work.sums[members.a], force, moment);
    add_to_b(work.sums[members.b], force, moment);
  } else {
    add_to_a(work.sums[members.a], force);
    add_to_b(work.sums[members.b], force);
  }
}

template <ContactLaw Law>
std::size_t BallContacts<Law>::touching() const noexcept {
  std::size_t count = 0;
  for (const Outcome& outcome : outcomes_) count += outcome.touching;
  return count;
}

template <ContactLaw Law>
double BallContacts<Law>::largest_overlap_ratio() const noexcept {
  double deepest = 0.0;
  for (const Outcome& outcome : outcomes_) deepest = std::max(deepest, outcome.largest_ratio());
  return deepest;
}

template <ContactLaw Law>
double BallContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  for_each_lane([&](const geometry::IndexPair&, const Parameters& parameters, const Rows& rows,
                    std::size_t lane) {
    energy += Law::elastic_normal_energy(parameters, rows.gap.number(lane)) +
              Law::history_energy(parameters, rows.memory(lane).history);
  });
  return energy;
}

template <ContactLaw Law>
void BallContacts<Law>::number(std::int64_t& last) {
  PairNumbers::Reader known(numbers_);
  PairNumbers numbers;
  for_each_lane(
      [&](const geometry::IndexPair& pair, const Parameters&, const Rows& rows, std::size_t lane) {
        const auto row = static_cast<std::size_t>(&rows - rows_.data());
        const bool has_one = touched_[row].since_numbered(lane);
        numbers.add(pair, has_one ? known.of(pair) : ++last);
      });
  numbers_ = std::move(numbers);
  for (TouchedLanes& touched : touched_) touched.set_numbered();
}

template <ContactLaw Law>
void BallContacts<Law>::for_each_row(Positions x, VisitRow visit) const {
  PairNumbers::Reader numbers(numbers_);
  for_each_lane([&](const geometry::IndexPair& pair, const Parameters& parameters, const Rows& rows,
                    std::size_t lane) {
    const Ball &a = ball(pair.a), &b = ball(pair.b);
    ContactRow row;
    if (touched_[static_cast<std::size_t>(&rows - rows_.data())].since_numbered(lane))
      row.id = numbers.of(pair);
    row.a = {BodyKind::sphere, pair.a, geometry::Feature(a.node)};
    row.b = {BodyKind::sphere, pair.b, geometry::Feature(b.node)};
    row.point_a = x[index_of(a.node)];
    row.point_b = x[index_of(b.node)];
    const ContactMemory<Law> memory = rows.memory(lane);
    row.normal = memory.normal;
    row.gap = rows.gap.number(lane);
    row.point = row.point_a + (a.radius + 0.5 * row.gap) * row.normal;
    set_force(row, rows.force_on_b(lane, parameters));
    if constexpr (HasMoments<Law>) row.moment = Law::moment(memory.history, memory.normal);
    set_state<Law>(row, parameters, memory.history, Law::elastic_normal_force(parameters, row.gap));
    visit(row);
  });
}

template <ContactLaw Law>
void BallContacts<Law>::hand_over(const BallBlocks::Block& block, const Work& work,
                                  NodeForces& forces) {
  constexpr std::size_t kAhead = 16;
  const auto owned = blocks_.owned(block);
  const BallSum* const sums = work.sums.data();
  for (std::size_t m = 0; m < owned.size(); ++m) {
    const std::size_t ahead = index_of(owned[std::min(m + kAhead, owned.size() - 1)].node);
    __builtin_prefetch(&forces.force[ahead], 1);
    __builtin_prefetch(&forces.torque[ahead], 1);
    forces.force[index_of(owned[m].node)] = sums[m].force;
    forces.torque[index_of(owned[m].node)] = sums[m].torque;
  }
  std::copy_n(sums + owned.size(), block.borrowed(), lent_.begin() + block.first_borrowed);
}

template <ContactLaw Law>
void BallContacts<Law>::set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const {
  if (blocks_.other_nodes().empty()) return;
  pool.for_each_range(forces.force.size(), [&](std::size_t begin, std::size_t end, int) {
    for (const BallBlocks::NodeRange& range : blocks_.other_nodes()) {
      const std::size_t first = std::max(begin, range.begin);
      const std::size_t last = std::min(end, range.end);
      if (first < last) forces.set_zero(first, last);
    }
  });
}

template <ContactLaw Law>
void BallContacts<Law>::return_loans(NodeForces& forces, geometry::ThreadPool& pool) const {
  const auto add = [&](NodeId node, std::size_t borrowed) {
    forces.force[index_of(node)] += lent_[borrowed].force;
    forces.torque[index_of(node)] += lent_[borrowed].torque;
  };
  const auto ask = [&](NodeId node, std::size_t borrowed) {
    __builtin_prefetch(&lent_[borrowed]);
    __builtin_prefetch(&forces.force[index_of(node)]);
    __builtin_prefetch(&forces.torque[index_of(node)]);
  };
  pool.for_each_range(blocks_.blocks().size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) blocks_.for_each_loan(k, add, ask);
  });
}

/// Compiled once, in the library.
extern template class BallContacts<LinearFrictional>;
extern template class BallContacts<AnyLaw>;

}  // namespace plekton::contact

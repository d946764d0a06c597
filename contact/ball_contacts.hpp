// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/ball_block.hpp"
#include "contact/bodies.hpp"
#include "contact/contact_memory.hpp"
#include "contact/contact_row.hpp"
#include "contact/force_records.hpp"
#include "contact/material_pairs.hpp"
#include "contact/rekey.hpp"
#include "geometry/parallel_sum.hpp"

#include <array>
#include <span>
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

  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
    records_.add_to(forces, pool);
  }
  std::size_t touching() const noexcept { return records_.size(); }
  /// Largest overlap of the last step over the radius of the smaller ball.
  double largest_overlap_ratio() const noexcept { return records_.deepest(); }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(a, b, parameters, gap) for every touching pair.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    records_.for_each([&](const BallForce& record) {
      visit(record.a, record.b, details_[record.contact].parameters, details_[record.contact].gap);
    });
  }

  template <class Visit>
  void for_each_row(Positions x, Visit&& visit) const;

 private:
  /// What the search for touching pairs reads.
  struct Pair {
    NodeId a;
    NodeId b;
    double range;  ///< m, sum of radii
    bool touches;  ///< in the last step
  };
  /// What only touching pairs need.
  struct Detail {
    double radius_a;
    double radius_b;
    double gap = 0.0;  ///< m, of the last step
    typename Law::Parameters parameters;
    ContactMemory<Law> memory;
  };

  using Records = typename ForceRecords<BallForce>::List;

  /// Pairs found to touch, waiting to be asked about together.
  struct Touching {
    std::array<std::size_t, kBlockLanes> pair;  ///< place in the list
    std::size_t count = 0;
  };

  /// Looks for touching pairs from `first` on, until `end` or until there are enough for a block.
  /// Contacts that have ended are forgotten; the energy (J) lost is added to dissipated.
  /// @returns the pair to go on with
  std::size_t find_touching(std::size_t first, std::size_t end, Positions x, Touching& touching,
                            double& dissipated);

  template <class Block>
  void gather(const Touching& touching, const Motion& motion, Block& block) const;
  template <class Block>
  double scatter(const Touching& touching, const Block& block, Records& records);

  /// One step of pairs that touch, together if the law allows. @returns the energy (J) dissipated
  double advance_block(const Touching& touching, const Motion& motion, double dt, Records& records);
  /// One step of a pair that touches, whatever happened to it. @returns the energy (J) dissipated
  double advance_one(std::size_t i, const Motion& motion, double dt, Records& records);

  std::vector<Pair> pairs_;
  std::vector<Detail> details_;
  ForceRecords<BallForce> records_;
  Rekey<Detail> rekey_;
  geometry::ParallelSum<double> sum_;
};

template <ContactLaw Law>
double BallContacts<Law>::rebuild(std::span<const geometry::IndexPair> keys,
                                  std::span<const Ball> balls,
                                  const MaterialPairs<Law>& materials) {
  double lost = 0.0;
  pairs_.clear();
  make_room(pairs_, keys.size());
  const auto make = [&](std::size_t i, const Detail* old) {
    const Ball& a = balls[static_cast<std::size_t>(keys[i].a)];
    const Ball& b = balls[static_cast<std::size_t>(keys[i].b)];
    pairs_.push_back({a.node, b.node, a.radius + b.radius, old && !old->memory.is_new()});
    if (old) return *old;
    return Detail{
        a.radius, b.radius, 0.0, materials.combine(a.material, a.radius, b.material, b.radius), {}};
  };
  rekey_(details_, keys, make,
         [&](Detail& old) { lost += forget<Law>(old.parameters, old.memory); });
  return lost;
}

template <ContactLaw Law>
double BallContacts<Law>::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  records_.reset(pool.thread_count());
  return sum_(pairs_.size(), pool, [&](std::size_t begin, std::size_t end, int worker) {
    double dissipated = 0.0;
    for (std::size_t next = begin; next < end;) {
      Touching touching;
      next = find_touching(next, end, motion.position, touching, dissipated);
      dissipated += advance_block(touching, motion, dt, records_.of_worker(worker));
    }
    return dissipated;
  });
}

template <ContactLaw Law>
std::size_t BallContacts<Law>::find_touching(std::size_t first, std::size_t end, Positions x,
                                             Touching& touching, double& dissipated) {
  std::size_t i = first;
  std::size_t count = 0;
  for (; i < end && count < kBlockLanes; ++i) {
    Pair& pair = pairs_[i];
    const Vec3& xa = x[index_of(pair.a)];
    const Vec3& xb = x[index_of(pair.b)];
    const double dx = xb[0] - xa[0], dy = xb[1] - xa[1], dz = xb[2] - xa[2];
    const bool touches = dx * dx + dy * dy + dz * dz < pair.range * pair.range;
    // Written always and counted if true: whether a pair touches cannot be predicted, and a wrong
    // guess costs more.
    touching.pair[count] = i;
    count += touches;
    if (pair.touches == touches) continue;
    pair.touches = touches;
    if (!touches) dissipated += forget<Law>(details_[i].parameters, details_[i].memory);
  }
  touching.count = count;
  return i;
}

template <ContactLaw Law>
double BallContacts<Law>::advance_block(const Touching& touching, const Motion& motion, double dt,
                                        Records& records) {
  if constexpr (LaneLaw<Law>) {
    BallBlock<Law> block;
    gather(touching, motion, block);
    if (advance_side_by_side(block, touching.count, dt)) return scatter(touching, block, records);
  }
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k)
    dissipated += advance_one(touching.pair[k], motion, dt, records);
  return dissipated;
}

template <ContactLaw Law>
template <class Block>
void BallContacts<Law>::gather(const Touching& touching, const Motion& motion, Block& block) const {
  for (std::size_t k = 0; k < touching.count; ++k) {
    const Pair& pair = pairs_[touching.pair[k]];
    const Detail& detail = details_[touching.pair[k]];
    const std::size_t a = index_of(pair.a);
    const std::size_t b = index_of(pair.b);
    block.separation.set(k, Vec3(motion.position[b] - motion.position[a]));
    block.velocity.set(k, Vec3(motion.velocity[b] - motion.velocity[a]));
    block.spin_a.set(k, motion.angular_velocity[a]);
    block.spin_b.set(k, motion.angular_velocity[b]);
    block.radius_a.set(k, detail.radius_a);
    block.radius_b.set(k, detail.radius_b);
    block.parameters.set(k, detail.parameters);
    block.history.set(k, detail.memory.history);
    block.normal.set(k, detail.memory.normal);
  }
}

template <ContactLaw Law>
template <class Block>
double BallContacts<Law>::scatter(const Touching& touching, const Block& block, Records& records) {
  double dissipated = 0.0;
  for (std::size_t k = 0; k < touching.count; ++k) {
    const std::size_t i = touching.pair[k];
    Detail& detail = details_[i];
    block.history.get(k, detail.memory.history);
    block.normal.get(k, detail.memory.normal);
    block.gap.get(k, detail.gap);
    // Written in place: a record built elsewhere would be copied before its numbers have left the
    // processor.
    BallForce& record = records.add(block.overlap_ratio.number(k));
    record.a = pairs_[i].a;
    record.b = pairs_[i].b;
    block.force.get(k, record.force);
    block.torque_a.get(k, record.torque_a);
    block.torque_b.get(k, record.torque_b);
    record.contact = i;
    dissipated += block.dissipated.number(k);
  }
  return dissipated;
}

template <ContactLaw Law>
double BallContacts<Law>::advance_one(std::size_t i, const Motion& motion, double dt,
                                      Records& records) {
  const Pair& pair = pairs_[i];
  Detail& detail = details_[i];
  const std::size_t a = index_of(pair.a);
  const std::size_t b = index_of(pair.b);
  const Vec3 separation = motion.position[b] - motion.position[a];
  const double distance = separation.norm();
  // Coincident centres have no direction: the last normal goes on, or else any.
  const Vec3 normal = distance > 0.0           ? Vec3((1.0 / distance) * separation)
                      : detail.memory.is_new() ? Vec3(Vec3::UnitZ())
                                               : detail.memory.normal;
  const BallPairOf<double> balls{normal,
                                 distance,
                                 motion.velocity[b] - motion.velocity[a],
                                 motion.angular_velocity[a],
                                 motion.angular_velocity[b],
                                 detail.radius_a,
                                 detail.radius_b};
  detail.memory = {carried_history<Law>(detail.memory, normal, dt * balls.twist_rate()), normal};
  const BallStepOf<double> step =
      ball_step<Law>(balls, detail.parameters, detail.memory.history, dt);
  detail.gap = step.gap;
  records.add({pair.a, pair.b, step.force, step.torque_a, step.torque_b, i},
              -step.gap / std::min(detail.radius_a, detail.radius_b));
  return step.dissipated;
}

template <ContactLaw Law>
double BallContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  records_.for_each([&](const BallForce& record) {
    const Detail& detail = details_[record.contact];
    energy += Law::elastic_normal_energy(detail.parameters, detail.gap) +
              Law::history_energy(detail.parameters, detail.memory.history);
  });
  return energy;
}

template <ContactLaw Law>
template <class Visit>
void BallContacts<Law>::for_each_row(Positions x, Visit&& visit) const {
  records_.for_each([&](const BallForce& record) {
    const Detail& detail = details_[record.contact];
    visit(contact_row(x[index_of(record.a)], x[index_of(record.b)], detail.memory.normal,
                      detail.gap, record.force));
  });
}

}  // namespace plekton::contact

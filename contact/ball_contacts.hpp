// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "contact/chunks.hpp"
#include "contact/contact_memory.hpp"
#include "contact/contact_row.hpp"
#include "contact/force_records.hpp"
#include "contact/material_pairs.hpp"
#include "contact/rekey.hpp"

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

  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const { records_.add_to(forces, pool); }
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
  };
  /// What only touching pairs need.
  struct Detail {
    double radius_a;
    double radius_b;
    double gap = 0.0;  ///< m, of the last step
    typename Law::Parameters parameters;
    ContactMemory<Law> memory;
  };

  /// @returns the energy (J) dissipated
  double advance_touching(std::size_t i, const Vec3& separation, double distance, const Motion& motion, double dt,
                          typename ForceRecords<BallForce>::List& records);

  std::vector<geometry::IndexPair> keys_;
  std::vector<Pair> pairs_;
  std::vector<Detail> details_;
  ForceRecords<BallForce> records_;
  ChunkedSum<double> sum_;
};

template <ContactLaw Law>
double BallContacts<Law>::rebuild(std::span<const geometry::IndexPair> keys, std::span<const Ball> balls,
                                  const MaterialPairs<Law>& materials) {
  double lost = 0.0;
  pairs_.clear();
  const auto make = [&](std::size_t i, const Detail* old) {
    const Ball& a = balls[static_cast<std::size_t>(keys[i].a)];
    const Ball& b = balls[static_cast<std::size_t>(keys[i].b)];
    pairs_.push_back({a.node, b.node, a.radius + b.radius});
    if (old) return *old;
    return Detail{a.radius, b.radius, 0.0, materials.combine(a.material, a.radius, b.material, b.radius), {}};
  };
  rekey(keys_, details_, keys, make, [&](Detail& old) { lost += forget<Law>(old.parameters, old.memory); });
  return lost;
}

template <ContactLaw Law>
double BallContacts<Law>::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  records_.reset(pool.thread_count());
  return sum_(pairs_.size(), pool, [&](std::size_t begin, std::size_t end, int worker) {
    auto& records = records_.of_worker(worker);
    double dissipated = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const Pair& pair = pairs_[i];
      const Vec3 separation = motion.position[index_of(pair.b)] - motion.position[index_of(pair.a)];
      const double distance_squared = separation.squaredNorm();
      if (distance_squared < pair.range * pair.range) {
        dissipated += advance_touching(i, separation, std::sqrt(distance_squared), motion, dt, records);
      } else if (!details_[i].memory.is_new()) {
        dissipated += forget<Law>(details_[i].parameters, details_[i].memory);
      }
    }
    return dissipated;
  });
}

template <ContactLaw Law>
double BallContacts<Law>::advance_touching(std::size_t i, const Vec3& separation, double distance,
                                           const Motion& motion, double dt, typename ForceRecords<BallForce>::List& records) {
  const Pair& pair = pairs_[i];
  Detail& detail = details_[i];
  const std::size_t a = index_of(pair.a);
  const std::size_t b = index_of(pair.b);
  // Coincident centres have no direction: the last normal goes on, or else any.
  const Vec3 normal = distance > 0.0             ? Vec3(separation / distance)
                      : detail.memory.is_new() ? Vec3(Vec3::UnitZ())
                                               : detail.memory.normal;
  const double gap = distance - pair.range;
  const double arm_a = detail.radius_a + 0.5 * gap;
  const double arm_b = detail.radius_b + 0.5 * gap;
  const Vec3& spin_a = motion.angular_velocity[a];
  const Vec3& spin_b = motion.angular_velocity[b];
  const Vec3 relative_velocity =
      motion.velocity[b] - motion.velocity[a] - (arm_a * spin_a + arm_b * spin_b).cross(normal);
  const RelativeMotion relative =
      relative_motion(normal, gap, Law::elastic_normal_force(detail.parameters, gap), relative_velocity);

  detail.gap = gap;
  const double twist_rate = 0.5 * (spin_a + spin_b).dot(normal);
  detail.memory = {carried_history<Law>(detail.memory, normal, dt * twist_rate), normal};
  const ContactForce result = Law::force(detail.parameters, relative, detail.memory.history, dt);
  const Vec3 normal_cross_force = normal.cross(result.force);
  records.add({pair.a, pair.b, result.force, -arm_a * normal_cross_force, -arm_b * normal_cross_force, i}, -gap / std::min(detail.radius_a, detail.radius_b));
  return result.dissipated;
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
    visit(contact_row(x[index_of(record.a)], x[index_of(record.b)], detail.memory.normal, detail.gap, record.force));
  });
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "contact/contact_memory.hpp"
#include "contact/contact_row.hpp"
#include "contact/force_records.hpp"
#include "contact/last_side.hpp"
#include "contact/material_pairs.hpp"
#include "contact/patch.hpp"
#include "contact/patch_force.hpp"
#include "contact/patch_heirs.hpp"
#include "contact/rekey.hpp"
#include "geometry/neighbours.hpp"
#include "geometry/parallel_sum.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace plekton::contact {

using geometry::NearCells;

/// Contacts of balls (a) with deformable surfaces (b). A contact belongs to a ball and a structure,
/// never to a pair of elements: it lives on a patch (patch.hpp), and follows it over the surface.
template <ContactLaw Law>
class SurfaceContacts {
 public:
  explicit SurfaceContacts(const geometry::Surface& surface) : surface_(&surface) {}

  /// Takes a new list of pairs (ball, structure), sorted, with their cells in ascending order;
  /// pairs in both lists keep their patches.
  /// @param materials_of_structures  by StructureId
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const NearCells> near,
                 std::span<const geometry::CellId> cells, std::span<const Ball> balls,
                 std::span<const MaterialId> materials_of_structures,
                 const MaterialPairs<Law>& materials);

  /// One step of all contacts: forces are written down, not yet added.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
    records_.add_to(forces, pool);
  }

  /// Largest overlap of the last step over the radius of the ball.
  double largest_overlap_ratio() const noexcept { return records_.deepest(); }

  /// How many balls had their centre on the other side of a surface than in the step before: they
  /// pass through it. In the last step.
  std::int64_t pass_throughs() const noexcept;

  /// Number of patches in contact.
  std::size_t touching() const noexcept;

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(ball's node, core point of a term, parameters, gap) for every term of every patch.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    records_.for_each([&](const SurfaceForce& record) {
      const Pair& pair = pairs_[record.contact];
      visit(record.a, record.core, pair.parameters);
    });
  }

  template <class Visit>
  void for_each_row(Positions x, Visit&& visit) const;

 private:
  /// A contact as it is kept for the next step.
  struct Contact {
    PatchState state;
    ContactMemory<Law> memory;
    std::uint32_t first_minimum;  ///< features of its minima, in Lists::minima
    std::uint32_t minimum_count;
  };
  struct Lists {
    std::vector<Contact> contacts;
    std::vector<Feature> minima;
  };
  /// Where the contacts of a pair are.
  struct Range {
    int worker = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  struct Pair {
    NodeId node;
    double radius;  ///< m, of the ball
    double reach;   ///< m, radius of ball + radius of structure
    NearCells near;
    typename Law::Parameters parameters;
    Range range;
  };
  struct Worker {
    explicit Worker(const geometry::Surface& surface) : patches(surface), heirs(surface) {}
    PatchFinder patches;
    PatchHeirs heirs;
    std::vector<PatchState> states;
    std::vector<PatchTermForce> term_forces;  ///< in the order of the patches and their terms
    std::vector<typename Law::History> histories;
    std::int64_t pass_throughs = 0;  ///< in this step
  };

  double advance_pair(Pair& pair, const Motion& motion, double dt, int worker);
  void keep_sides(const Pair& pair, std::span<const Patch> patches, Positions x, Worker& worker);
  void find_states(const Pair& pair, std::span<const Patch> patches, const Motion& motion,
                   Worker& worker);
  double inherit(const Pair& pair, std::span<const Patch> patches, const Motion& motion, double dt,
                 Worker& worker);
  void write_forces(const Pair& pair, std::span<const PatchTerm> terms, const PatchState& state,
                    std::span<const PatchTermForce> term_forces,
                    typename ForceRecords<SurfaceForce>::List& records) const;
  double drop(const Pair& pair) const;
  std::span<const Contact> contacts_of(const Pair& pair, const std::vector<Lists>& lists) const {
    return {lists[static_cast<std::size_t>(pair.range.worker)].contacts.data() + pair.range.first,
            pair.range.count};
  }

  const geometry::Surface* surface_;
  std::vector<Pair> pairs_;
  std::vector<geometry::CellId> cells_;
  std::vector<Lists> current_;   ///< by worker
  std::vector<Lists> previous_;  ///< by worker
  std::vector<Worker> workers_;
  ForceRecords<SurfaceForce> records_;
  Rekey<Pair> rekey_;
  geometry::ParallelSum<double> sum_;
};

template <ContactLaw Law>
double SurfaceContacts<Law>::rebuild(std::span<const geometry::IndexPair> keys,
                                     std::span<const NearCells> near,
                                     std::span<const geometry::CellId> cells,
                                     std::span<const Ball> balls,
                                     std::span<const MaterialId> materials_of_structures,
                                     const MaterialPairs<Law>& materials) {
  double lost = 0.0;
  const auto make = [&](std::size_t i, const Pair* old) {
    const Ball& ball = balls[static_cast<std::size_t>(keys[i].a)];
    const geometry::StructureId structure{keys[i].b};
    const double radius_b = surface_->radius(structure);
    const MaterialId material_b = materials_of_structures[index_of(structure)];
    return Pair{ball.node,
                ball.radius,
                ball.radius + radius_b,
                near[i],
                materials.combine(ball.material, ball.radius, material_b, radius_b),
                old ? old->range : Range{}};
  };
  rekey_(pairs_, keys, make, [&](const Pair& old) { lost += drop(old); });
  make_room(cells_, cells.size());
  cells_.assign(cells.begin(), cells.end());
  return lost;
}

template <ContactLaw Law>
double SurfaceContacts<Law>::drop(const Pair& pair) const {
  if (pair.range.count == 0) return 0.0;
  double lost = 0.0;
  for (const Contact& contact : contacts_of(pair, current_)) {
    lost += Law::history_energy(pair.parameters, contact.memory.history);
  }
  return lost;
}

template <ContactLaw Law>
double SurfaceContacts<Law>::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  const auto worker_count = static_cast<std::size_t>(pool.thread_count());
  while (workers_.size() < worker_count) workers_.emplace_back(*surface_);
  current_.swap(previous_);
  current_.resize(worker_count);
  previous_.resize(worker_count);
  for (Lists& lists : current_) {
    lists.contacts.clear();
    lists.minima.clear();
  }
  for (Worker& worker : workers_) worker.pass_throughs = 0;
  records_.reset(pool.thread_count());
  return sum_(pairs_.size(), pool, [&](std::size_t begin, std::size_t end, int worker) {
    double dissipated = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      dissipated += advance_pair(pairs_[i], motion, dt, worker);
    return dissipated;
  });
}

template <ContactLaw Law>
double SurfaceContacts<Law>::advance_pair(Pair& pair, const Motion& motion, double dt,
                                          int worker_index) {
  Worker& worker = workers_[static_cast<std::size_t>(worker_index)];
  Lists& lists = current_[static_cast<std::size_t>(worker_index)];
  const std::span<const geometry::CellId> cells{cells_.data() + pair.near.first, pair.near.count};
  const auto patches =
      worker.patches.find(motion.position[index_of(pair.node)], pair.reach, cells, motion.position);

  keep_sides(pair, patches, motion.position, worker);
  find_states(pair, patches, motion, worker);
  double dissipated = inherit(pair, patches, motion, dt, worker);
  pair.range = {worker_index, static_cast<std::uint32_t>(lists.contacts.size()),
                static_cast<std::uint32_t>(patches.size())};
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const auto terms = worker.patches.terms(patches[j]);
    PatchState& state = worker.states[j];
    Contact contact{state,
                    {worker.histories[j], state.normal},
                    static_cast<std::uint32_t>(lists.minima.size()),
                    0};
    const RelativeMotion relative =
        relative_motion(state.normal, state.gap, state.elastic_force, state.relative_velocity);
    const ContactForce result = Law::force(pair.parameters, relative, contact.memory.history, dt);
    dissipated += result.dissipated;
    contact.state.force = result.force;
    write_forces(pair, terms, contact.state,
                 {worker.term_forces.data() + patches[j].first_term, terms.size()},
                 records_.of_worker(worker_index));
    for (const PatchTerm& term : terms) {
      if (term.weight > 0.0) lists.minima.push_back(term.core.feature);
    }
    contact.minimum_count = static_cast<std::uint32_t>(lists.minima.size()) - contact.first_minimum;
    lists.contacts.push_back(contact);
  }
  return dissipated;
}

/// Where a ball's centre lies on the surface itself, the contact of the last step says on which
/// side it is.
template <ContactLaw Law>
void SurfaceContacts<Law>::keep_sides(const Pair& pair, std::span<const Patch> patches, Positions x,
                                      Worker& worker) {
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const std::span<PatchTerm> terms = worker.patches.terms(patches[j]);
    if (terms[0].distance > 0.0 || pair.range.count == 0) continue;  // the first is the nearest
    const auto& minima = previous_[static_cast<std::size_t>(pair.range.worker)].minima;
    for (const Contact& old : contacts_of(pair, previous_)) {
      const auto heirs = worker.heirs.find({minima.data() + old.first_minimum, old.minimum_count},
                                           x[index_of(pair.node)], x, patches, worker.patches);
      if (std::find(heirs.begin(), heirs.end(), j) == heirs.end()) continue;
      for (PatchTerm& term : terms) {
        if (term.distance == 0.0) term.normal = normal_on_last_side(term, old.memory.normal, x);
      }
      break;
    }
  }
}

template <ContactLaw Law>
void SurfaceContacts<Law>::find_states(const Pair& pair, std::span<const Patch> patches,
                                       const Motion& motion, Worker& worker) {
  worker.states.clear();
  worker.term_forces.clear();
  for (const Patch& patch : patches) {
    const auto terms = worker.patches.terms(patch);
    worker.term_forces.resize(patch.first_term + terms.size());
    const std::span<PatchTermForce> term_forces{worker.term_forces.data() + patch.first_term,
                                                terms.size()};
    worker.states.push_back(patch_state(
        patch, terms, pair.reach,
        [&](double gap) { return Law::elastic_normal_force(pair.parameters, gap); },
        [&](double gap) { return Law::elastic_normal_energy(pair.parameters, gap); }, term_forces));
    set_kinematics(worker.states.back(), pair.node, pair.radius, pair.reach, terms, term_forces,
                   motion);
  }
}

/// Hands the histories of the last step's contacts to this step's patches. A contact that splits
/// shares its history in proportion to the elastic forces. @returns the energy (J) that is lost on
/// the way
template <ContactLaw Law>
double SurfaceContacts<Law>::inherit(const Pair& pair, std::span<const Patch> patches,
                                     const Motion& motion, double dt, Worker& worker) {
  worker.histories.assign(patches.size(), typename Law::History{});
  if (pair.range.count == 0) return 0.0;
  double lost = 0.0;
  const auto& minima = previous_[static_cast<std::size_t>(pair.range.worker)].minima;
  for (const Contact& old : contacts_of(pair, previous_)) {
    lost += Law::history_energy(pair.parameters, old.memory.history);
    const auto heirs = worker.heirs.find({minima.data() + old.first_minimum, old.minimum_count},
                                         motion.position[index_of(pair.node)], motion.position,
                                         patches, worker.patches);
    double total = 0.0;
    for (const std::uint32_t heir : heirs) total += worker.states[heir].elastic_force;
    // A ball rolls around an edge little by little: a normal that turns over in one step has gone
    // through the surface.
    worker.pass_throughs +=
        !heirs.empty() && std::all_of(heirs.begin(), heirs.end(), [&](std::uint32_t heir) {
          return is_turned_over(old.memory.normal, worker.states[heir].normal);
        });
    for (const std::uint32_t heir : heirs) {
      const PatchState& state = worker.states[heir];
      const double share =
          total > 0.0 ? state.elastic_force / total : 1.0 / static_cast<double>(heirs.size());
      Law::add_share(worker.histories[heir],
                     carried_history<Law>(old.memory, state.normal, dt * state.twist_rate), share);
    }
  }
  for (const auto& history : worker.histories)
    lost -= Law::history_energy(pair.parameters, history);
  return lost;
}

template <ContactLaw Law>
void SurfaceContacts<Law>::write_forces(const Pair& pair, std::span<const PatchTerm> terms,
                                        const PatchState& state,
                                        std::span<const PatchTermForce> term_forces,
                                        typename ForceRecords<SurfaceForce>::List& records) const {
  const Vec3 other_force = state.force - state.elastic_force * state.normal;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Vec3 other = term_forces[i].share * other_force;
    const Vec3 lever_b = state.lever_a - terms[i].distance * terms[i].normal;
    records.add({pair.node, terms[i].core, term_forces[i].elastic * terms[i].normal + other,
                 -state.lever_a.cross(other), lever_b.cross(other),
                 static_cast<std::size_t>(&pair - pairs_.data())},
                -state.gap / pair.radius);
  }
}

template <ContactLaw Law>
std::int64_t SurfaceContacts<Law>::pass_throughs() const noexcept {
  std::int64_t count = 0;
  for (const Worker& worker : workers_) count += worker.pass_throughs;
  return count;
}

template <ContactLaw Law>
std::size_t SurfaceContacts<Law>::touching() const noexcept {
  std::size_t count = 0;
  for (const Lists& lists : current_) count += lists.contacts.size();
  return count;
}

template <ContactLaw Law>
double SurfaceContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  for (const Pair& pair : pairs_) {
    if (pair.range.count == 0) continue;
    for (const Contact& contact : contacts_of(pair, current_)) {
      energy += contact.state.elastic_energy +
                Law::history_energy(pair.parameters, contact.memory.history);
    }
  }
  return energy;
}

template <ContactLaw Law>
template <class Visit>
void SurfaceContacts<Law>::for_each_row(Positions x, Visit&& visit) const {
  for (const Pair& pair : pairs_) {
    if (pair.range.count == 0) continue;
    const Vec3& centre = x[index_of(pair.node)];
    for (const Contact& contact : contacts_of(pair, current_)) {
      const PatchState& state = contact.state;
      visit(contact_row(centre, centre + state.foot, state.normal, state.gap, state.force));
    }
  }
}

}  // namespace plekton::contact

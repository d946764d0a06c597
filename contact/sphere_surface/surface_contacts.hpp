// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/law/pair_springs.hpp"
#include "contact/sphere_surface/deferred_pairs.hpp"
#include "contact/sphere_surface/history_transfer.hpp"
#include "contact/sphere_surface/patch.hpp"
#include "contact/sphere_surface/patch_contacts.hpp"
#include "contact/sphere_surface/patch_force.hpp"
#include "contact/sphere_surface/single_feature_batch.hpp"
#include "contact/sphere_surface/sphere_surface_pair.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/energy_loss.hpp"
#include "contact/tracking/force_records.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/parallel_sum.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

using geometry::NearCells;

struct SurfaceContactsState;

/// Contacts of spheres (a) with deformable surfaces (b). A contact belongs to a sphere and a
/// structure, never to a pair of elements: it lives on a patch (patch.hpp), and follows it over
/// the surface.
class SurfaceContacts {
 public:
  explicit SurfaceContacts(const geometry::Surface& surface)
      : surface_(&surface), watch_(surface) {}

  /// Takes a new list of pairs (sphere, structure), sorted, with their cells in ascending order;
  /// pairs in both lists keep their patches.
  /// @param materials_of_structures  by StructureId
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const NearCells> near,
                 std::span<const geometry::CellId> cells, std::span<const SphereBody> spheres,
                 std::span<const MaterialId> materials_of_structures,
                 const MaterialPairs& materials);

  /// Goes on with what is left of the surface: contacts keep their histories on the minima that are
  /// left, and one without any is over. A new list has to follow.
  /// @param cells  of the present list, as rebuild() took them
  /// @param at     m, where the elastic energy of before and after is compared
  /// @returns the energy (J) lost: of histories that are over, and what of the elastic energy is
  ///          not in the surface that is left. Where a torn facet leaves sides that push more than
  ///          once it may be negative.
  double follow(const geometry::SurfaceChange& change, std::span<const geometry::CellId> cells,
                Positions at);

  /// One step of all contacts: forces are written down, not yet added.
  EnergyLoss advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
    records_.add_to(forces, pool);
  }

  /// Largest overlap of the last step over the radius of the sphere.
  double largest_overlap_ratio() const noexcept { return records_.deepest(); }

  /// How many spheres had their centre on the other side of a surface than in the step before: they
  /// pass through it. In the last step.
  std::int64_t pass_throughs() const noexcept;

  /// Number of patches in contact.
  std::size_t touching() const noexcept { return current_.size(); }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(sphere's node, core point of a term, parameters, range (m): radius of the sphere
  /// and of the surface, part) for every term of every patch.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    records_.for_each_contact([&](std::span<const SurfaceForce> terms) {
      const Pair& pair = pairs_[terms[0].pair];
      // With shares s_i and the ways u_i of the terms, (sum s_i u_i)² <= sum s_i u_i².
      for (const SurfaceForce& term : terms)
        visit(term.a, term.core, pair.parameters, pair.range, TermPart{term.elastic, term.share});
    });
  }

  /// Calls visit(sphere's node, core point, parameters, range (m)) for what is not in contact but
  /// may be as soon as bodies come nearer by a margin: the nearest point of every cell whose inside
  /// holds it, and of a surface that the sphere does not touch the nearest one of all, since a
  /// contact begins there.
  /// @param margin  m, at most the skin of the list
  /// @param cells   of the present list, as rebuild() took them
  using VisitComing = geometry::FunctionRef<void(NodeId, const geometry::CorePoint&,
                                                 const AnyLaw::Parameters&, double)>;
  void for_each_coming(double margin, std::span<const geometry::CellId> cells, Positions x,
                       VisitComing visit) const;

  /// Adds the elastic normal forces (N) with the nodes anywhere near where they were in the last
  /// step: what the contacts' energy gives, without friction and whatever else has a history.
  /// @param cells   of the present list, as rebuild() took them
  /// @param finder  working space, of this surface
  /// @param wants   (sphere's node) -> whether its contacts count
  void add_elastic_forces(std::span<const geometry::CellId> cells, Positions x, NodeForces& forces,
                          PatchFinder& finder, geometry::FunctionRef<bool(NodeId)> wants) const;

  /// Gives a number after the last one to every contact that has none.
  void assign_ids(std::int64_t& last) noexcept { current_.assign_ids(last); }

  /// Calls visit(ContactRecord) for every contact of the last step, in the order of the list.
  void for_each_record(Positions x, VisitRecord visit) const;

  /// @param list  makes the list anew by rebuild()
  void exchange(const geometry::StateArchive& archive, geometry::FunctionRef<void()> list,
                geometry::ThreadPool& pool);

  /// Goes on with the contacts of others, on the same surface, whose pairs are listed here too.
  /// @param places  of their spheres among these, ascending; -1: not there
  /// @param list    makes the list anew by rebuild()
  void take_over(const SurfaceContacts& before, std::span<const std::int32_t> places,
                 geometry::FunctionRef<void()> list, geometry::ThreadPool& pool);

 private:
  /// What there is of a pair in this list and step.
  struct PairNow {
    NearCells near;
    PatchContacts::Range contacts;
    geometry::FaceId single_face;  ///< whose inside was the only contact in the last step; or none
    DeferredPairs::NextCheck next_check;
  };
  /// What each step reads is at the front.
  struct Pair : PairNow, SphereSurfacePair {};
  static constexpr geometry::FaceId kNoFace{-1};
  /// A pair that is due, with the cells that may be in range.
  struct Job {
    std::size_t pair;
    std::size_t first_cell;  ///< in Worker::cells
    std::size_t cell_count;
    std::size_t lane;  ///< in Worker::lone; kNoLane: to be computed by itself
  };
  static constexpr std::size_t kNoLane = std::numeric_limits<std::size_t>::max();
  struct Worker {
    explicit Worker(const geometry::Surface& surface) : patches(surface), histories(surface) {}
    PatchFinder patches;
    HistoryTransfer histories;
    std::vector<Job> jobs;
    std::vector<geometry::CellId> cells;  ///< of the jobs
    std::vector<PatchState> states;
    std::vector<PatchTermForce> term_forces;  ///< in the order of the patches and their terms
    /// Pairs of a sphere with the inside of one facet, as far as one can tell beforehand.
    SingleFeatureBatch lone;
    std::array<geometry::FaceId, kSingleFeatureLanes> single_faces;
  };

  EnergyLoss advance_pairs(std::size_t begin, std::size_t end, const Motion& motion, double dt,
                           int worker);
  /// Asks for what looking at later pairs will read: pairs and what is kept of them are large.
  PLEKTON_INLINE void ask_ahead(std::size_t pair, std::size_t end) const noexcept {
    constexpr std::size_t kAhead = 8;
    const Pair& later = pairs_[std::min(pair + 2 * kAhead, end - 1)];
    __builtin_prefetch(&later.near);
    __builtin_prefetch(&later.radius);
    __builtin_prefetch(&later.parameters.numbers);
    const Pair& next = pairs_[std::min(pair + kAhead, end - 1)];
    watch_.ask_ahead(next.near);
    if (next.contacts.count > 0) __builtin_prefetch(&previous_.contacts_of(next.contacts)[0]);
  }
  std::size_t find_jobs(std::size_t begin, std::size_t end, const Motion& motion, Worker& worker);
  bool may_be_single_feature(Pair& pair, const Motion& motion, Job& job, SideFlags& sides,
                             Worker& worker);
  void add_lane(const Pair& pair, const SideFlags& sides, Worker& worker) const;
  double keep_single_feature(Pair& pair, std::size_t lane, int worker);
  geometry::FaceId single_face_of(const Pair& pair) const noexcept;
  EnergyLoss advance_pair(Pair& pair, std::span<const geometry::CellId> cells, const Motion& motion,
                          double dt, int worker);
  EnergyLoss advance_alone(const Pair& pair, const PatchesOfPair& now, const Motion& motion,
                           double dt, int worker);
  EnergyLoss advance_patches(const Pair& pair, const PatchesOfPair& now, const Motion& motion,
                             double dt, int worker);
  double add_contact(const Pair& pair, std::span<const PatchTerm> terms, const PatchState& state,
                     std::span<const PatchTermForce> term_forces, const Transferred& transferred,
                     double dt, int worker);
  static void find_states(const PatchesOfPair& now, const Motion& motion, Worker& worker);
  void write_forces(const Pair& pair, std::span<const PatchTerm> terms, const PatchState& state,
                    const ContactForce& answer, std::span<const PatchTermForce> term_forces,
                    int worker);
  double drop(const Pair& pair) const;
  double released_by(const geometry::SurfaceChange& change, std::span<const geometry::CellId> cells,
                     Positions at) const;
  void begin_anew(geometry::FunctionRef<void()> list, geometry::ThreadPool& pool);
  bool is_listed(const geometry::IndexPair& key, std::size_t& place) const noexcept;
  SurfaceContactsState state() const;
  void take(const SurfaceContactsState& state);

  const geometry::Surface* surface_;
  std::vector<Pair> pairs_;
  DeferredPairs watch_;
  PatchContacts current_;
  PatchContacts previous_;  ///< of the step before
  std::vector<Worker> workers_;
  ForceRecords<SurfaceForce> records_;
  Rekey<Pair> rekey_;
  geometry::ParallelSum<EnergyLoss> sum_;
};

}  // namespace plekton::contact

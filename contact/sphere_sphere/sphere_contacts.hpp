// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/pair_numbers.hpp"
#include "contact/sphere_sphere/pair_table.hpp"
#include "contact/sphere_sphere/shared_blocks.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/sphere_sphere/sphere_sums.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/function_ref.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plekton::contact {

/// Contacts between spheres: one lane for each pair that may touch, in the blocks of
/// sphere_blocks.hpp, those of one law together.
class SphereContacts {
 public:
  using Parameters = AnyLaw::Parameters;

  /// From here on ranks share the blocks; to be called before the first list. All of them have all
  /// lists, and the forces on all common nodes; what a contact remembers has the rank that computes
  /// it. What asks for contacts then has to be asked by all ranks.
  void share_among(geometry::Ranks& ranks) { shared_.emplace(ranks); }
  /// Shares out what there is on the lists: before the first step with them.
  /// @param met  as SharedMotion::assign() has it
  void share_out(std::span<const NodeId> met);
  /// Which rank moves which nodes; nothing where this process computes all.
  SharedMotion* shared_motion() noexcept { return shared_ ? &shared_->motion() : nullptr; }

  const SphereBlocks& blocks() const noexcept { return blocks_; }
  /// The rank that computes each block; empty: this process computes all.
  std::span<const int> holders() const noexcept {
    return shared_ ? shared_->holders() : std::span<const int>();
  }

  /// What each rank does alone; nothing where this process computes all.
  std::vector<RankShare> shares_of_ranks() const {
    return shared_ ? shared_->shares() : std::vector<RankShare>();
  }

  /// Takes a new list of pairs of spheres (a < b, sorted); pairs in both lists keep their memory.
  /// @param spheres, materials  must not change until the next list
  /// @param x  m, of nodes, to put what is near together; empty: the spheres are in order already
  /// @returns the energy (J) lost with contacts that left the list
  double rebuild(std::span<const geometry::IndexPair> pairs, std::span<const SphereBody> spheres,
                 const MaterialPairs& materials, geometry::ThreadPool& pool, Positions x = {});

  /// One step of all contacts. Sets the forces of all nodes: of those that touch nothing to zero.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, double dt, geometry::ThreadPool& pool, NodeForces& forces);

  std::size_t touching() const noexcept { return totals_.touching; }
  /// Largest overlap of the last step over the radius of the smaller sphere.
  double largest_overlap_ratio() const noexcept { return totals_.largest_ratio; }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(a, b, parameters, gap) for every touching pair, in the order of the list.
  template <class Visit>
  void for_each_touching(Visit&& visit) const {
    for_each_told<double>([this](std::size_t, std::uint32_t slot) { return table_.gap(slot); },
                          [&](std::size_t i, double gap) {
                            visit(sphere(keys_[i].a).node, sphere(keys_[i].b).node, parameters(i),
                                  gap);
                          });
  }

  /// Calls visit(a, b, parameters, gap) for every listed pair that is nearer than a margin (m) with
  /// the nodes where they are now.
  template <class Visit>
  void for_each_near(double margin, Positions x, Visit&& visit) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const SphereBody &a = sphere(keys_[i].a), &b = sphere(keys_[i].b);
      const Parameters of_pair = parameters(i);
      const double touch = a.radius + b.radius;
      const double range = touch + margin + AnyLaw::interaction_range(of_pair);
      const double squared = (x[index_of(b.node)] - x[index_of(a.node)]).squaredNorm();
      if (squared < range * range) visit(a.node, b.node, of_pair, std::sqrt(squared) - touch);
    }
  }

  /// Gives a number after the last one to every touching pair that has none. A pair keeps its
  /// number as long as it touches.
  void assign_ids(std::int64_t& last);

  /// Calls visit(ContactRecord) for every touching pair, in the order of the list.
  void for_each_record(Positions x, VisitRecord visit) const;

  /// @param list  makes the list anew by rebuild(), as it was
  void exchange(const geometry::StateArchive& archive, geometry::FunctionRef<void()> list);

  /// Goes on with the pairs of others that are listed here too.
  /// @param places  of their spheres among these, ascending; -1: not there
  /// @param list    makes the list anew by rebuild()
  void take_over(const SphereContacts& before, std::span<const std::int32_t> places,
                 geometry::FunctionRef<void()> list);

 private:
  static constexpr std::size_t kLanes = SphereBlocks::kLanes;
  using Outcome = BlockOutcome<kLanes>;

  /// What there is of a touching pair.
  struct PairState {
    double gap = 0.0;  ///< m
    ContactMemory<AnyLaw> memory;
    Vec3 force = Vec3::Zero();  ///< N, on b; where rows keep it
  };

  /// A touching pair in a state.
  struct KeptPair {
    std::array<std::int32_t, 2> spheres;
    PairState state;
    std::int64_t id;  ///< 0: none
  };

  const SphereBody& sphere(std::int32_t index) const noexcept {
    return spheres_[static_cast<std::size_t>(index)];
  }
  Parameters parameters(std::size_t i) const noexcept;
  Vec3 force_on_b(std::size_t i, const PairState& pair) const noexcept;
  void find_kinds();
  void set_parameters();
  double energy_lost(const MaterialPairs& materials) const;
  std::vector<KeptPair> kept_pairs() const;
  std::size_t exchange_pair(geometry::RowFields& row, KeptPair& pair, std::size_t from) const;
  void keep(const KeptPair& pair, std::size_t place);
  void advance_block(const SphereBlocks::Block& block, const Motion& motion, SphereWork& work);
  SphereRange range_of(const SphereBlocks::Range& range) noexcept;
  /// Hands the sums of a block's own spheres to their nodes, and keeps those of ghosts.
  void hand_over(const SphereBlocks::Block& block, const SphereWork& work, NodeForces& forces);
  void set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const;
  /// Adds to all nodes what other blocks than their own have of them.
  void add_ghost_sums(NodeForces& forces, geometry::ThreadPool& pool) const;
  /// The same to the nodes of one block.
  void add_ghost_sums(std::size_t block, NodeForces& forces) const;

  void share_blocks(const Motion& motion, geometry::ThreadPool& pool, NodeForces& forces);
  void compute_block(std::size_t block, const Motion& motion, SphereWork& work, NodeForces& forces);

  /// Ranks know of all pairs which touch, not only of their own.
  void tell_touched() const;

  /// Calls visit(place in the list, what tell(place, slot) comes to) for every touching pair, in
  /// the order of the list. tell() is asked where the pair is held, and comes to plain numbers, whole
  /// ones of 8 bytes.
  template <class Told, class Tell, class Visit>
  void for_each_told(Tell&& tell, Visit&& visit) const {
    tell_touched();
    if (table_.is_shared_out()) {
      for_each_told_by_ranks<Told>(tell, visit);
      return;
    }
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const std::uint32_t slot = blocks_.slot(i);
      if (table_.has_touched(slot)) visit(i, tell(i, slot));
    }
  }

  /// Some pairs at a time, so that a message is not as large as the scene.
  template <class Told, class Tell, class Visit>
  void for_each_told_by_ranks(Tell&& tell, Visit&& visit) const {
    constexpr std::size_t kAtATime = geometry::Ranks::kUsualRoom / sizeof(Told);
    std::vector<Told> told;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < keys_.size();) {
      told.clear();
      places.clear();
      for (; i < keys_.size() && told.size() < kAtATime; ++i) {
        const std::uint32_t slot = blocks_.slot(i);
        if (!table_.has_touched(slot)) continue;
        places.push_back(i);
        told.push_back(table_.holds(slot) ? tell(i, slot) : Told());
      }
      geometry::share(shared_->ranks(), room_, [&](const auto& visit_piece) {
        for (std::size_t n = 0; n < told.size(); ++n)
          visit_piece(table_.holder(blocks_.slot(places[n])),
                      std::as_writable_bytes(std::span(&told[n], 1)));
      });
      for (std::size_t n = 0; n < told.size(); ++n) visit(places[n], told[n]);
    }
  }

  /// The same of all that there is of a pair.
  template <class Visit>
  void for_each_state(Visit&& visit) const {
    for_each_told<PairState>([this](std::size_t, std::uint32_t slot) { return state_of(slot); },
                             [&](std::size_t i, PairState state) {
                               // Where a law is in memory, each process knows for itself.
                               state.memory.history.law = table_.kind(blocks_.slot(i)).law;
                               visit(i, state);
                             });
  }
  PairState state_of(std::uint32_t slot) const noexcept;

  std::vector<geometry::IndexPair> keys_;  ///< of spheres
  std::vector<std::uint8_t> kinds_;        ///< by pair; empty: one of all
  std::span<const SphereBody> spheres_;
  /// Of all spheres, where parameters are not kept.
  struct Common {
    Material material;
    AnyLaw::Properties properties;
  };
  std::optional<Common> common_;
  SphereBlocks blocks_;
  std::optional<SharedBlocks> shared_;        ///< nothing: this process computes all
  const MaterialPairs* materials_ = nullptr;  ///< of the list
  mutable PairTable table_;
  mutable bool is_told_ = true;          ///< which pairs touch
  mutable std::vector<std::byte> room_;  ///< for messages
  PairNumbers numbers_;                  ///< of the pairs that touched when they were numbered last
  std::vector<SphereSum> ghost_sums_;    ///< of ghosts
  std::vector<Outcome> outcomes_;        ///< by block that this process computes
  BlockTotals totals_;                   ///< of all blocks
  std::vector<SphereWork> work_;         ///< by thread
  std::vector<std::uint32_t> old_slots_;  ///< by pair of a new list
  std::vector<std::uint32_t> left_;       ///< touching pairs, by place, that a new list has not
  std::vector<PairKind> kinds_of_list_;
};

}  // namespace plekton::contact

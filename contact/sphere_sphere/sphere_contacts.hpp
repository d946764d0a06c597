// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/pair_numbers.hpp"
#include "contact/sphere_sphere/pair_table.hpp"
#include "contact/sphere_sphere/shared_blocks.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/sphere_sphere/sphere_sums.hpp"
#include "contact/sphere_sphere/told_pairs.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/function_ref.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace plekton::contact {

/// Contacts between spheres: one lane for each pair that may touch, in the blocks of
/// sphere_blocks.hpp, those of one law together.
class SphereContacts {
 public:
  using Parameters = AnyLaw::Parameters;

  /// From here on ranks share the blocks; to be called before the first list. Each has the pairs
  /// that it computes, and what they remember; all have the forces on all common nodes. What asks
  /// for contacts then has to be asked by all ranks, and tells each of all contacts.
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
  /// @param pairs  of ranks each has some, which together are all
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
    visit_gaps([this](std::size_t i) { return gap_of_touching(i); }, visit);
  }

  /// Calls visit(a, b, parameters, gap) for every listed pair that is nearer than a margin (m) with
  /// the nodes where they are now.
  template <class Visit>
  void for_each_near(double margin, Positions x, Visit&& visit) const {
    visit_gaps([&](std::size_t i) { return gap_of_near(i, margin, x); }, visit);
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
  struct KeptPair {
    std::array<std::int32_t, 2> spheres;
    std::int64_t id = 0;  ///< 0: none
    double gap = 0.0;     ///< m
    ContactMemory<AnyLaw> memory;
    Vec3 force = Vec3::Zero();  ///< N, on b; where rows keep it

    geometry::IndexPair key() const noexcept { return {spheres[0], spheres[1]}; }
  };

  const SphereBody& sphere(std::int32_t index) const noexcept {
    return spheres_[static_cast<std::size_t>(index)];
  }
  const AnyLaw::Functions& law_of(const geometry::IndexPair& pair) const {
    return *materials_->properties(sphere(pair.a).material, sphere(pair.b).material).law;
  }
  Parameters parameters(const geometry::IndexPair& pair, std::size_t place) const noexcept;
  Vec3 force_on_b(const KeptPair& pair, const Parameters& parameters) const noexcept;
  std::optional<double> gap_of_touching(std::size_t i) const noexcept;
  std::optional<double> gap_of_near(std::size_t i, double margin, Positions x) const noexcept;

  // A new list.
  void find_old_slots(std::span<const geometry::IndexPair> keys);
  std::vector<KeptPair> kept(std::span<const std::uint32_t> places) const;
  std::vector<KeptPair> dealt_out(std::vector<KeptPair> left, bool were_shared_out) const;
  double take_dealt_out(std::vector<KeptPair> pairs);
  double sum_of_lost(std::vector<ToldPair<double>> lost) const;
  void find_kinds();
  void agree_on_kinds(std::vector<geometry::IndexPair> firsts);
  void set_parameters();

  // What there is of pairs.
  KeptPair kept_pair(std::size_t i, PairNumbers::Reader& numbers) const;
  std::vector<KeptPair> kept_pairs() const;
  std::size_t place_of(const geometry::IndexPair& key, std::size_t from) const;
  bool is_true_anywhere(bool is_true_here) const;
  bool is_of_other_rank(const geometry::IndexPair& key) const;
  void exchange_pair(geometry::RowFields& row, KeptPair& pair) const;
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

  bool has_ranks() const noexcept { return shared_ && shared_->ranks().count() > 1; }
  /// Whether each rank has pairs of its own: else each has all.
  bool is_shared_out() const noexcept { return shared_ && shared_->is_worth_it(); }

  /// Calls visit(pair, place in the list, told) for every pair of which tell(place) comes to
  /// something, in the order of the pairs; kElsewhere is the place on other ranks.
  template <class Told, class Tell, class Visit>
  void for_each_told(const Tell& tell, const Visit& visit) const {
    if (!is_shared_out()) {
      for (std::size_t i = 0; i < keys_.size(); ++i)
        if (const std::optional<Told> told = tell(i)) visit(keys_[i], i, *told);
      return;
    }
    std::size_t next = 0, visited = 0;
    std::vector<std::size_t> places;
    const auto tell_some = [&](std::size_t end, std::vector<ToldPair<Told>>& own) {
      for (; next < keys_.size() && static_cast<std::size_t>(keys_[next].a) < end; ++next) {
        const std::optional<Told> told = tell(next);
        if (!told) continue;
        own.push_back({keys_[next], *told});
        places.push_back(next);
      }
    };
    const int self = shared_->ranks().rank();
    for_each_of_ranks<Told>(shared_->ranks(), blocks_.sphere_count(), tell_some,
                            [&](const ToldPair<Told>& pair, int rank) {
                              const bool is_own = rank == self;
                              visit(pair.pair, is_own ? places[visited++] : kElsewhere, pair.told);
                            });
  }

  template <class Gap, class Visit>
  void visit_gaps(const Gap& gap_of, Visit&& visit) const {
    for_each_told<double>(
        gap_of, [&](const geometry::IndexPair& pair, std::size_t place, double gap) {
          visit(sphere(pair.a).node, sphere(pair.b).node, parameters(pair, place), gap);
        });
  }

  /// Calls visit(KeptPair, place) for every touching pair.
  template <class Visit>
  void for_each_kept(Visit&& visit) const {
    PairNumbers::Reader numbers(numbers_);
    for_each_told<KeptPair>(
        [&](std::size_t i) {
          const bool touches = table_.has_touched(blocks_.slot(i));
          return touches ? std::optional(kept_pair(i, numbers)) : std::nullopt;
        },
        [&](const geometry::IndexPair& key, std::size_t place, KeptPair pair) {
          // Where a law is in memory, each process knows for itself.
          pair.memory.history.law = &law_of(key);
          visit(pair, place);
        });
  }

  static constexpr std::size_t kElsewhere = std::numeric_limits<std::size_t>::max();

  std::vector<geometry::IndexPair> keys_;  ///< of spheres; of this rank
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
  PairTable table_;
  PairNumbers numbers_;                ///< of the pairs that touched when they were numbered last
  std::vector<SphereSum> ghost_sums_;  ///< of ghosts
  std::vector<Outcome> outcomes_;      ///< by block that this process computes
  BlockTotals totals_;                 ///< of all blocks
  std::vector<SphereWork> work_;       ///< by thread
  std::vector<std::uint32_t> old_slots_;  ///< by pair of a new list
  std::vector<std::uint32_t> left_;       ///< touching pairs, by place, that a new list has not
  std::vector<PairKind> kinds_of_list_;
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/material_pairs.hpp"
#include "contact/sphere_sphere/pair_numbers.hpp"
#include "contact/sphere_sphere/shared_blocks.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/sphere_sphere/sphere_sums.hpp"
#include "contact/sphere_sphere/touched_lanes.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/rekey.hpp"
#include "geometry/base/cache_lines.hpp"
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
  /// it, until somebody asks.
  void share_among(geometry::Ranks& ranks) { shared_.emplace(ranks); }
  /// Shares out what there is on the lists: before the first step with them.
  /// @param met  nodes of spheres that something else than spheres is near to
  void share_out(std::span<const NodeId> met);
  /// Which rank moves which nodes; nothing where this process computes all.
  SharedMotion* shared_motion() noexcept { return shared_ ? &shared_->motion() : nullptr; }

  /// What each rank does alone; nothing where this process computes all.
  std::vector<RankShare> shares_of_ranks() const {
    return shared_ ? shared_->shares() : std::vector<RankShare>();
  }

  /// Takes a new list of pairs of spheres (a < b, sorted); pairs in both lists keep their memory.
  /// @param spheres  must not change until the next list
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
    for_each_lane([&](const Touching& pair) {
      visit(sphere(pair.key.a).node, sphere(pair.key.b).node, pair.parameters, pair.gap);
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
  using Rows = geometry::LaneRows<kLanes>;
  using ConstRows = geometry::LaneRows<kLanes, const double>;
  using Outcome = BlockOutcome<kLanes>;

  /// Pairs of one law, and where their rows have what.
  struct Kind {
    const AnyLaw::Functions* law;
    bool keeps_parameters;
    std::size_t force;  ///< 0: not kept
    std::size_t parameters;
    std::size_t row_size;

    Kind(const AnyLaw::Functions& of, bool keeps) noexcept;
    friend bool operator==(const Kind&, const Kind&) = default;
  };
  /// Where the numbers of a row are.
  struct RowPlace {
    std::uint32_t first_line;
    std::uint32_t kind;
  };
  /// A list of rows.
  struct Table {
    std::vector<Kind> kinds;
    std::vector<RowPlace> places;       ///< by row
    std::vector<TouchedLanes> touched;  ///< by row
    geometry::LineNumbers numbers;

    void assign(const SphereBlocks& blocks);
    std::size_t first_number(std::size_t slot) const noexcept {
      return kLanes * std::size_t{places[slot / kLanes].first_line};
    }
    Rows rows(std::size_t slot) noexcept { return Rows(numbers.data() + first_number(slot)); }
    ConstRows rows(std::size_t slot) const noexcept {
      return ConstRows(numbers.data() + first_number(slot));
    }
    const Kind& kind(std::size_t slot) const noexcept { return kinds[places[slot / kLanes].kind]; }
    bool has_touched(std::size_t slot) const noexcept {
      return touched[slot / kLanes].last(slot % kLanes);
    }
    ContactMemory<AnyLaw> memory(std::size_t slot) const noexcept;
    void set_memory(std::size_t slot, const ContactMemory<AnyLaw>& memory) noexcept;
    bool is_numbered(std::size_t slot) const noexcept {
      return touched[slot / kLanes].since_numbered(slot % kLanes);
    }
    /// Rows of the one kind that there is; numbers that are new are 0.
    void resize(std::size_t rows);
  };
  /// What goes from slot to slot when the list is made anew.
  struct Moved {
    ContactMemory<AnyLaw> memory;
    bool is_numbered = false;
  };
  /// A touching pair.
  struct Touching {
    const geometry::IndexPair& key;
    std::size_t slot;
    Parameters parameters;
    ContactMemory<AnyLaw> memory;
    double gap;  ///< m
  };

  /// A touching pair in a state.
  struct KeptPair {
    std::array<std::int32_t, 2> spheres;
    double gap;  ///< m
    ContactMemory<AnyLaw> memory;
    Vec3 force;       ///< N, on b; where rows keep it
    std::int64_t id;  ///< 0: none
  };

  const SphereBody& sphere(std::int32_t index) const noexcept {
    return spheres_[static_cast<std::size_t>(index)];
  }
  Parameters parameters(std::size_t i) const noexcept;
  Vec3 force_on_b(const Touching& pair) const noexcept;
  void find_kinds(std::span<const SphereBody> spheres, const MaterialPairs& materials,
                  std::vector<Kind>& kinds);
  void set_parameters(const MaterialPairs& materials);
  void move_memories();
  void move_memories_in_place();
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

  /// Gives all ranks what each has computed of the rows of the last step. What is read of rows needs
  /// it first.
  void complete() const;
  void share_blocks(const Motion& motion, geometry::ThreadPool& pool, NodeForces& forces);
  template <class Visit>
  void for_each_row_range(std::size_t slice, std::size_t slices, Visit&& visit) const;
  std::size_t slices_of_rows() const;
  void compute_block(std::size_t block, const Motion& motion, SphereWork& work, NodeForces& forces);

  /// Calls visit(touching pair), in the order of the list.
  template <class Visit>
  void for_each_lane(Visit&& visit) const {
    complete();
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const std::uint32_t slot = blocks_.slot(i);
      if (!table_.has_touched(slot)) continue;
      const double gap = table_.rows(slot).from(PairNumbersOfRow::kGap).number(slot % kLanes);
      visit(Touching{keys_[i], slot, parameters(i), table_.memory(slot), gap});
    }
  }

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
  std::optional<SharedBlocks> shared_;  ///< nothing: this process computes all
  bool has_owners_ = false;             ///< each of the blocks of the last list
  /// Of several ranks each has its own rows as of now, and those of others once they are complete.
  mutable Table table_;
  mutable bool is_complete_ = true;
  mutable std::vector<std::byte> room_;  ///< for messages
  Table last_table_;                     ///< its room, and the kinds of the list to come
  PairNumbers numbers_;                  ///< of the pairs that touched when they were numbered last
  std::vector<SphereSum> ghost_sums_;    ///< of ghosts
  std::vector<Outcome> outcomes_;        ///< by block that this process computes
  BlockTotals totals_;                   ///< of all blocks
  std::vector<SphereWork> work_;         ///< by thread
  std::vector<std::uint32_t> old_slots_;  ///< by pair of a new list
  std::vector<std::uint32_t> sources_;    ///< by slot of a new list
  std::vector<bool> is_source_;
};

}  // namespace plekton::contact

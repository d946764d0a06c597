// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/touched_lanes.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/cache_lines.hpp"
#include "geometry/base/lane_rows.hpp"
#include "geometry/base/ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// Pairs of one law, and where their rows have what.
struct PairKind {
  const AnyLaw::Functions* law;
  bool keeps_parameters;
  std::size_t force;  ///< 0: not kept
  std::size_t parameters;
  std::size_t row_size;

  PairKind(const AnyLaw::Functions& of, bool keeps) noexcept;
  friend bool operator==(const PairKind&, const PairKind&) = default;
};

/// Which ranks hold what is kept of the pairs of blocks.
struct BlockHolders {
  geometry::Ranks* ranks = nullptr;  ///< null: there is this process alone
  std::span<const int> of_blocks;    ///< rank by block; empty: each of them holds all
};

/// What is kept of pairs of spheres, in rows of pairs side by side, by the slots of
/// sphere_blocks.hpp. Of several ranks each holds the rows of its own blocks, and knows of all
/// pairs which touch, once they have told each other.
class PairTable {
 public:
  static constexpr std::size_t kLanes = SphereBlocks::kLanes;
  using Rows = geometry::LaneRows<kLanes>;
  using ConstRows = geometry::LaneRows<kLanes, const double>;

  /// Takes a new list. What pairs remember goes to their new slots, and to the ranks that hold
  /// those; all else is to be set anew. Ranks have told each other what touches.
  /// @param kinds      of the blocks' ranges; afterwards of no meaning, for the next list
  /// @param old_slots  by pair of the list: its slot in the list before, if it touched, or kNoSlot
  void take(const SphereBlocks& blocks, std::vector<PairKind>& kinds,
            std::span<const std::uint32_t> old_slots, const BlockHolders& holders);

  const std::vector<PairKind>& kinds() const noexcept { return kinds_; }
  const PairKind& kind(std::size_t slot) const noexcept {
    return kinds_[places_[slot / kLanes].kind];
  }

  // Of any slot.
  TouchedLanes& touched(std::size_t slot) noexcept { return touched_[slot / kLanes]; }
  bool has_touched(std::size_t slot) const noexcept {
    return touched_[slot / kLanes].last(slot % kLanes);
  }
  bool is_numbered(std::size_t slot) const noexcept {
    return touched_[slot / kLanes].since_numbered(slot % kLanes);
  }
  void set_numbered() noexcept {
    for (TouchedLanes& touched : touched_) touched.set_numbered();
  }

  /// Whether this process holds the numbers of a slot.
  bool holds(std::size_t slot) const noexcept { return is_here(places_[slot / kLanes]); }
  /// Whether ranks hold other rows each.
  bool is_shared_out() const noexcept { return is_shared_out_; }
  /// The rank that holds a slot, where rows are shared out.
  int holder(std::size_t slot) const noexcept { return places_[slot / kLanes].holder; }
  /// Tells all ranks which pairs touched on the ranks that hold them.
  void tell_touched();

  // Of slots that this process holds.
  Rows rows(std::size_t slot) noexcept { return Rows(numbers_.data() + first_number(slot)); }
  ConstRows rows(std::size_t slot) const noexcept {
    return ConstRows(numbers_.data() + first_number(slot));
  }
  /// m, of a pair that touches.
  double gap(std::size_t slot) const noexcept;
  ContactMemory<AnyLaw> memory(std::size_t slot) const noexcept {
    return memory_at(kind(slot), rows(slot), slot % kLanes);
  }
  void set_memory(std::size_t slot, const ContactMemory<AnyLaw>& memory) noexcept {
    set_memory_at(kind(slot), rows(slot), slot % kLanes, memory);
  }

 private:
  /// Where the numbers of a row are.
  struct RowPlace {
    std::uint32_t first_line;  ///< kElsewhere: on another rank
    std::uint16_t kind;
    std::uint16_t holder;  ///< rank, or kAll
  };
  /// As it was in the list before.
  struct LastList {
    std::vector<PairKind> kinds;
    std::vector<RowPlace> places;
    std::vector<TouchedLanes> touched;
    geometry::LineNumbers numbers;  ///< room only, but while they are moved
  };
  /// What other ranks tell of pairs that come here.
  struct Received {
    std::vector<double> numbers;     ///< rank by rank
    std::vector<std::size_t> sizes;  ///< bytes, by rank
  };
  static constexpr std::uint32_t kElsewhere = ~std::uint32_t{0};
  static constexpr std::uint16_t kAll = 0xffff;

  static bool is_here(const RowPlace& place) noexcept { return place.first_line != kElsewhere; }
  static bool is_held_by(const RowPlace& place, int rank) noexcept {
    return place.holder == kAll || place.holder == rank;
  }
  static std::size_t first_number(const RowPlace& place) noexcept {
    return kLanes * std::size_t{place.first_line};
  }
  std::size_t first_number(std::size_t slot) const noexcept {
    return first_number(places_[slot / kLanes]);
  }
  static ContactMemory<AnyLaw> memory_at(const PairKind& kind, ConstRows rows,
                                         std::size_t lane) noexcept;
  static void set_memory_at(const PairKind& kind, Rows rows, std::size_t lane,
                            const ContactMemory<AnyLaw>& memory) noexcept;

  std::size_t place_rows(const SphereBlocks& blocks, const BlockHolders& holders);
  // Of pairs that this process held before and holds now.
  void move_memories(std::size_t numbers, const SphereBlocks& blocks,
                     std::span<const std::uint32_t> old_slots);
  void move_memories_in_place(std::size_t numbers, const SphereBlocks& blocks,
                              std::span<const std::uint32_t> old_slots);
  void resize(std::size_t numbers);
  Received exchange_memories(const SphereBlocks& blocks,
                             std::span<const std::uint32_t> old_slots) const;
  void take_memories(const SphereBlocks& blocks, std::span<const std::uint32_t> old_slots,
                     Received& received);

  std::vector<PairKind> kinds_;
  std::vector<RowPlace> places_;       ///< by row
  std::vector<TouchedLanes> touched_;  ///< by row
  geometry::LineNumbers numbers_;      ///< of the rows that are here
  LastList last_;
  geometry::Ranks* ranks_ = nullptr;
  bool is_shared_out_ = false;
  std::vector<std::uint32_t> sources_;  ///< by slot of those that are here
  std::vector<bool> is_source_;
  std::vector<std::byte> room_;  ///< for messages
};

}  // namespace plekton::contact

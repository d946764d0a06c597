// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/any_law.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "contact/sphere_sphere/touched_lanes.hpp"
#include "contact/tracking/contact_memory.hpp"
#include "geometry/base/cache_lines.hpp"
#include "geometry/base/lane_rows.hpp"

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

/// What is kept of pairs of spheres, in rows of pairs side by side, by the slots of
/// sphere_blocks.hpp.
class PairTable {
 public:
  static constexpr std::size_t kLanes = SphereBlocks::kLanes;
  using Rows = geometry::LaneRows<kLanes>;
  using ConstRows = geometry::LaneRows<kLanes, const double>;

  /// Takes a new list. What pairs remember goes to their new slots; all else is to be set anew.
  /// @param kinds      of the blocks' ranges; afterwards of no meaning, for the next list
  /// @param old_slots  by pair of the list: its slot in the list before, if it touched, or kNoSlot
  void take(const SphereBlocks& blocks, std::vector<PairKind>& kinds,
            std::span<const std::uint32_t> old_slots);

  const std::vector<PairKind>& kinds() const noexcept { return kinds_; }
  const PairKind& kind(std::size_t slot) const noexcept {
    return kinds_[places_[slot / kLanes].kind];
  }

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
    std::uint32_t first_line;
    std::uint8_t kind;
  };
  /// As it was in the list before.
  struct LastList {
    std::vector<PairKind> kinds;
    std::vector<RowPlace> places;
    std::vector<TouchedLanes> touched;
    geometry::LineNumbers numbers;  ///< room only, but while they are moved
  };
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

  std::size_t place_rows(const SphereBlocks& blocks);
  void move_memories(std::size_t numbers, const SphereBlocks& blocks,
                     std::span<const std::uint32_t> old_slots);
  void move_memories_in_place(std::size_t numbers, const SphereBlocks& blocks,
                              std::span<const std::uint32_t> old_slots);
  void resize(std::size_t numbers);

  std::vector<PairKind> kinds_;
  std::vector<RowPlace> places_;       ///< by row
  std::vector<TouchedLanes> touched_;  ///< by row
  geometry::LineNumbers numbers_;      ///< of the rows
  LastList last_;
  std::vector<std::uint32_t> sources_;  ///< by slot
  std::vector<bool> is_source_;
};

}  // namespace plekton::contact

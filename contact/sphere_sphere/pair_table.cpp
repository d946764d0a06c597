// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/pair_table.hpp"

#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/tracking/rekey.hpp"

#include <algorithm>
#include <utility>

namespace plekton::contact {

PairKind::PairKind(const AnyLaw::Functions& of, bool keeps) noexcept
    : law(&of), keeps_parameters(keeps) {
  std::size_t rows = PairNumbersOfRow::kHistory + of.history_numbers;
  force = of.force_of_state ? 0 : rows;
  if (force > 0) rows += 3;
  parameters = keeps ? rows : 0;
  if (keeps) rows += of.parameter_numbers;
  row_size = rows * PairTable::kLanes;
}

double PairTable::gap(std::size_t slot) const noexcept {
  return rows(slot).from(PairNumbersOfRow::kGap).number(slot % kLanes);
}

ContactMemory<AnyLaw> PairTable::memory_at(const PairKind& kind, ConstRows rows,
                                           std::size_t lane) noexcept {
  ContactMemory<AnyLaw> memory;
  memory.normal = rows.from(PairNumbersOfRow::kNormal).at<Vec3>(lane);
  memory.history.law = kind.law;
  rows.from(PairNumbersOfRow::kHistory)
      .get_numbers(lane, memory.history.numbers.data(), kind.law->history_numbers);
  return memory;
}

void PairTable::set_memory_at(const PairKind& kind, Rows rows, std::size_t lane,
                              const ContactMemory<AnyLaw>& memory) noexcept {
  rows.from(PairNumbersOfRow::kNormal).set(lane, memory.normal);
  rows.from(PairNumbersOfRow::kHistory)
      .set_numbers(lane, memory.history.numbers.data(), kind.law->history_numbers);
}

void PairTable::take(const SphereBlocks& blocks, std::vector<PairKind>& kinds,
                     std::span<const std::uint32_t> old_slots) {
  std::swap(last_.kinds, kinds_);
  std::swap(kinds_, kinds);
  std::swap(last_.places, places_);
  std::swap(last_.touched, touched_);
  const std::size_t numbers = place_rows(blocks);
  make_room(touched_, places_.size());
  touched_.assign(places_.size(), {});
  for (std::size_t i = 0; i < old_slots.size(); ++i) {
    if (old_slots[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots[i], to = blocks.slot(i);
    touched_[to / kLanes].set_moved(to % kLanes, true,
                                    last_.touched[from / kLanes].since_numbered(from % kLanes));
  }
  if (kinds_.size() == 1 && kinds_ == last_.kinds)
    move_memories_in_place(numbers, blocks, old_slots);
  else
    move_memories(numbers, blocks, old_slots);
}

/// @returns how many numbers the rows have
std::size_t PairTable::place_rows(const SphereBlocks& blocks) {
  make_room(places_, blocks.row_count());
  places_.clear();
  std::size_t line = 0;
  for (const SphereBlocks::Range& range : blocks.ranges()) {
    for (std::uint32_t row = 0; row < range.row_count; ++row) {
      places_.push_back({static_cast<std::uint32_t>(line), range.kind});
      line += kinds_[range.kind].row_size / kLanes;
    }
  }
  return line * kLanes;
}

/// From the slots that pairs had in the list before, to those that they have now.
void PairTable::move_memories(std::size_t numbers, const SphereBlocks& blocks,
                              std::span<const std::uint32_t> old_slots) {
  std::swap(numbers_, last_.numbers);
  make_room(numbers_, numbers);
  numbers_.assign(numbers, 0.0);
  for (std::size_t i = 0; i < old_slots.size(); ++i) {
    if (old_slots[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots[i], to = blocks.slot(i);
    const RowPlace& was = last_.places[from / kLanes];
    set_memory(to, memory_at(last_.kinds[was.kind],
                             ConstRows(last_.numbers.data() + first_number(was)), from % kLanes));
  }
}

/// The same of rows of one size: the numbers of a large bed are not there twice.
void PairTable::move_memories_in_place(std::size_t numbers, const SphereBlocks& blocks,
                                       std::span<const std::uint32_t> old_slots) {
  const PairKind& kind = kinds_.front();
  resize(std::max(numbers_.size(), numbers));
  const std::size_t slots = numbers_.size() / kind.row_size * kLanes;
  make_room(sources_, slots);
  make_room(is_source_, slots);
  sources_.assign(slots, kNoSlot);
  for (std::size_t i = 0; i < old_slots.size(); ++i)
    if (old_slots[i] != kNoSlot) sources_[blocks.slot(i)] = old_slots[i];
  const auto rows_of = [&](std::uint32_t slot) {
    return Rows(numbers_.data() + slot / kLanes * kind.row_size);
  };
  move_slots(
      sources_, is_source_,
      [&](std::uint32_t slot) {
        return memory_at(kind, ConstRows(numbers_.data() + slot / kLanes * kind.row_size),
                         slot % kLanes);
      },
      [&](std::uint32_t slot, const ContactMemory<AnyLaw>& memory) {
        set_memory_at(kind, rows_of(slot), slot % kLanes, memory);
      });
  resize(numbers);
}

/// Numbers that are new are 0.
void PairTable::resize(std::size_t numbers) {
  make_room(numbers_, numbers);
  numbers_.resize(numbers, 0.0);
}

}  // namespace plekton::contact

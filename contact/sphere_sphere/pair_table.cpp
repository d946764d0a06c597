// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/pair_table.hpp"

#include "contact/sphere_sphere/move_slots.hpp"
#include "contact/sphere_sphere/sphere_range.hpp"
#include "contact/tracking/rekey.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
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
                     std::span<const std::uint32_t> old_slots, const BlockHolders& holders) {
  std::swap(last_.kinds, kinds_);
  std::swap(kinds_, kinds);
  std::swap(last_.places, places_);
  std::swap(last_.touched, touched_);
  const std::size_t numbers = place_rows(blocks, holders);
  make_room(touched_, places_.size());
  touched_.assign(places_.size(), {});
  for (std::size_t i = 0; i < old_slots.size(); ++i) {
    if (old_slots[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots[i], to = blocks.slot(i);
    touched_[to / kLanes].set_moved(to % kLanes, true,
                                    last_.touched[from / kLanes].since_numbered(from % kLanes));
  }
  Received received;
  if (ranks_ != nullptr) received = exchange_memories(blocks, old_slots);
  if (kinds_.size() == 1 && kinds_ == last_.kinds)
    move_memories_in_place(numbers, blocks, old_slots);
  else
    move_memories(numbers, blocks, old_slots);
  if (ranks_ != nullptr) take_memories(blocks, old_slots, received);
}

/// @returns how many numbers the rows here have
std::size_t PairTable::place_rows(const SphereBlocks& blocks, const BlockHolders& holders) {
  ranks_ = holders.ranks;
  if (ranks_ != nullptr && ranks_->count() >= int{kAll})
    throw std::length_error("more than " + std::to_string(kAll - 1) + " ranks: take fewer");
  is_shared_out_ = !holders.of_blocks.empty();
  make_room(places_, blocks.row_count());
  places_.clear();
  std::size_t line = 0;
  for (std::size_t k = 0; k < blocks.blocks().size(); ++k) {
    const std::uint16_t holder =
        is_shared_out_ ? static_cast<std::uint16_t>(holders.of_blocks[k]) : kAll;
    const bool is_held = holder == kAll || int{holder} == ranks_->rank();
    for (const SphereBlocks::Range& range : blocks.ranges(blocks.blocks()[k])) {
      for (std::uint32_t row = 0; row < range.row_count; ++row) {
        const std::uint32_t first = is_held ? static_cast<std::uint32_t>(line) : kElsewhere;
        places_.push_back({first, range.kind, holder});
        if (is_held) line += kinds_[range.kind].row_size / kLanes;
      }
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
    if (!is_here(was) || !holds(to)) continue;
    set_memory(to, memory_at(last_.kinds[was.kind],
                             ConstRows(last_.numbers.data() + first_number(was)), from % kLanes));
  }
}

/// The same of rows of one size: the numbers of a large bed are not there twice.
void PairTable::move_memories_in_place(std::size_t numbers, const SphereBlocks& blocks,
                                       std::span<const std::uint32_t> old_slots) {
  const PairKind& kind = kinds_.front();
  resize(std::max(numbers_.size(), numbers));
  // Rows here follow each other: slots of them alone.
  const auto local = [&](const RowPlace& place, std::uint32_t slot) {
    return static_cast<std::uint32_t>(first_number(place) / kind.row_size * kLanes + slot % kLanes);
  };
  const std::size_t slots = numbers_.size() / kind.row_size * kLanes;
  make_room(sources_, slots);
  make_room(is_source_, slots);
  sources_.assign(slots, kNoSlot);
  for (std::size_t i = 0; i < old_slots.size(); ++i) {
    if (old_slots[i] == kNoSlot) continue;
    const std::uint32_t from = old_slots[i], to = blocks.slot(i);
    const RowPlace &was = last_.places[from / kLanes], &is = places_[to / kLanes];
    if (is_here(was) && is_here(is)) sources_[local(is, to)] = local(was, from);
  }
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

// Several ranks.

namespace {

/// What one rank tells another of a pair: its last normal, and its history.
std::size_t told_numbers(const PairKind& kind) noexcept {
  return 3 + kind.law->history_numbers;
}

/// Where the part of each rank begins among parts that follow each other.
std::vector<double*> begins(std::span<const std::size_t> sizes, std::vector<double>& numbers) {
  std::vector<double*> begins;
  double* next = numbers.data();
  for (const std::size_t size : sizes) {
    begins.push_back(next);
    next += size / sizeof(double);
  }
  return begins;
}

}  // namespace

/// Of the list before, from who held a pair to those that hold it now; both go through the pairs in
/// the order of the list. @returns what comes here
PairTable::Received PairTable::exchange_memories(const SphereBlocks& blocks,
                                                 std::span<const std::uint32_t> old_slots) const {
  const int self = ranks_->rank(), count = ranks_->count();
  const auto for_each_message = [&](const auto& send, const auto& receive) {
    for (std::size_t i = 0; i < old_slots.size(); ++i) {
      if (old_slots[i] == kNoSlot) continue;
      const RowPlace& was = last_.places[old_slots[i] / kLanes];
      const RowPlace& is = places_[blocks.slot(i) / kLanes];
      if (was.holder == kAll || was.holder == is.holder) continue;
      if (was.holder != self && is_held_by(is, self)) receive(was.holder, last_.kinds[was.kind]);
      if (was.holder != self) continue;
      for (int rank = 0; rank < count; ++rank)
        if (rank != self && is_held_by(is, rank)) send(rank, was, old_slots[i] % kLanes);
    }
  };
  std::vector<std::size_t> sent_sizes(static_cast<std::size_t>(count), 0);
  Received received{{}, sent_sizes};
  for_each_message(
      [&](int rank, const RowPlace& was, std::size_t) {
        sent_sizes[static_cast<std::size_t>(rank)] +=
            told_numbers(last_.kinds[was.kind]) * sizeof(double);
      },
      [&](int rank, const PairKind& kind) {
        received.sizes[static_cast<std::size_t>(rank)] += told_numbers(kind) * sizeof(double);
      });
  const auto total = [](std::span<const std::size_t> sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) / sizeof(double);
  };
  std::vector<double> sent(total(sent_sizes));
  received.numbers.resize(total(received.sizes));
  std::vector<double*> to = begins(sent_sizes, sent);
  for_each_message(
      [&](int rank, const RowPlace& was, std::size_t lane) {
        const PairKind& kind = last_.kinds[was.kind];
        const ConstRows rows(numbers_.data() + first_number(was));
        double*& next = to[static_cast<std::size_t>(rank)];
        rows.from(PairNumbersOfRow::kNormal).get_numbers(lane, next, 3);
        rows.from(PairNumbersOfRow::kHistory)
            .get_numbers(lane, next + 3, kind.law->history_numbers);
        next += told_numbers(kind);
      },
      [](int, const PairKind&) {});
  ranks_->begin_exchange(std::as_bytes(std::span(sent)), sent_sizes,
                         std::as_writable_bytes(std::span(received.numbers)), received.sizes);
  ranks_->end_exchange();
  return received;
}

void PairTable::take_memories(const SphereBlocks& blocks, std::span<const std::uint32_t> old_slots,
                              Received& received) {
  std::vector<double*> from = begins(received.sizes, received.numbers);
  for (std::size_t i = 0; i < old_slots.size(); ++i) {
    if (old_slots[i] == kNoSlot || !holds(blocks.slot(i))) continue;
    const RowPlace& was = last_.places[old_slots[i] / kLanes];
    if (was.holder == kAll || int{was.holder} == ranks_->rank()) continue;
    const PairKind& kind = last_.kinds[was.kind];
    double*& next = from[was.holder];
    ContactMemory<AnyLaw> memory;
    memory.history.law = kind.law;
    std::copy_n(next, 3, memory.normal.data());
    std::copy_n(next + 3, kind.law->history_numbers, memory.history.numbers.begin());
    set_memory(blocks.slot(i), memory);
    next += told_numbers(kind);
  }
}

/// In slices, so that a message is not as large as the scene.
void PairTable::tell_touched() {
  constexpr std::size_t kAtATime = geometry::Ranks::kUsualRoom / sizeof(TouchedLanes);
  for (std::size_t begin = 0; begin < places_.size(); begin += kAtATime) {
    const std::size_t end = std::min(begin + kAtATime, places_.size());
    geometry::share(*ranks_, room_, [&](const auto& visit) {
      for (std::size_t first = begin; first < end;) {
        std::size_t last = first + 1;
        while (last < end && places_[last].holder == places_[first].holder) ++last;
        visit(int{places_[first].holder},
              std::as_writable_bytes(std::span(touched_).subspan(first, last - first)));
        first = last;
      }
    });
  }
}

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace plekton::geometry {

/// Processes that compute one scene together. All of them have all of it and make the same calls in
/// the same order; work that is shared out is done by one of them, and told to the others.
///
/// Sizes are in bytes and multiples of kUnit. Each function is called by all ranks, from one thread.
class Ranks {
 public:
  static constexpr std::size_t kUnit = sizeof(std::uint64_t);
  /// Bytes that what is told to all at a time should take about: what is more is told in pieces,
  /// so that a rank needs little more memory than one process.
  static constexpr std::size_t kUsualRoom = std::size_t{4} << 20;

  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  /// Of this process, from 0 on.
  virtual int rank() const noexcept = 0;
  virtual int count() const noexcept = 0;

  /// Who does which pieces of work. Any answer that all ranks agree on is right; here each has a
  /// range of the pieces, and about the same work.
  /// @param work  of each piece, in any unit
  /// @returns     rank by piece
  virtual std::vector<int> owners(std::span<const std::uint64_t> work) {
    return ranges_of_equal_work(work, count());
  }

  /// Gives all ranks the parts of all.
  /// @param parts  one after the other in the order of the ranks; that of this rank is filled in
  /// @param sizes  by rank
  virtual void gather(std::span<std::byte> parts, std::span<const std::size_t> sizes) = 0;

  /// Begins to send a part to each rank and to take one from each. Until end_exchange() this rank
  /// may compute, but calls no other function of this class than progress().
  /// @param sent, received  parts one after the other, with their sizes by rank; they stay where
  ///                        they are until the end
  virtual void begin_exchange(std::span<const std::byte> sent,
                              std::span<const std::size_t> sent_sizes,
                              std::span<std::byte> received,
                              std::span<const std::size_t> received_sizes) = 0;
  /// From here on all that was to be received is there.
  virtual void end_exchange() = 0;
  /// Lets an exchange that has begun go on while this rank computes: large messages move only when
  /// both sides look at them. Called from the same thread, at any time.
  virtual void progress() {}

  /// Ranges of pieces, in the order of the ranks: a piece goes to the rank in whose share of the
  /// work its middle lies.
  static std::vector<int> ranges_of_equal_work(std::span<const std::uint64_t> work, int count);
};

/// Whether a rank says so. Called by all of them.
bool any_rank(Ranks& ranks, bool says);

/// Gives every rank what the owners of pieces of memory have in them.
/// @param room            for messages, kept from call to call
/// @param for_each_piece  (visit): calls visit(owner, span of bytes) for all pieces, in the same
///                        order and with the same sizes on all ranks, any number of times
template <class ForEachPiece>
void share(Ranks& ranks, std::vector<std::byte>& room, const ForEachPiece& for_each_piece) {
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<std::size_t> sizes(count, 0);
  for_each_piece([&](int owner, std::span<std::byte> piece) {
    sizes[static_cast<std::size_t>(owner)] += piece.size();
  });
  std::vector<std::size_t> at(count, 0);
  std::size_t total = 0;
  for (std::size_t rank = 0; rank < count; ++rank) {
    at[rank] = total;
    sizes[rank] = (sizes[rank] + Ranks::kUnit - 1) / Ranks::kUnit * Ranks::kUnit;
    total += sizes[rank];
  }
  room.resize(total);
  const int self = ranks.rank();
  std::byte* to = room.data() + at[static_cast<std::size_t>(self)];
  for_each_piece([&](int owner, std::span<std::byte> piece) {
    if (owner != self || piece.empty()) return;
    std::memcpy(to, piece.data(), piece.size());
    to += piece.size();
  });
  ranks.gather(room, sizes);
  for_each_piece([&](int owner, std::span<std::byte> piece) {
    if (owner == self || piece.empty()) return;
    std::size_t& from = at[static_cast<std::size_t>(owner)];
    std::memcpy(piece.data(), room.data() + from, piece.size());
    from += piece.size();
  });
}

}  // namespace plekton::geometry

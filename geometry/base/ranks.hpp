// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace plekton::geometry {

/// Processes that compute one scene together. All of them have all of it and make the same calls in
/// the same order; work that is shared out is done by one of them, which tells the others what they
/// need of it.
///
/// Sizes are in bytes and multiples of kUnit. Each function is called by all ranks, from one thread.
class Ranks {
 public:
  static constexpr std::size_t kUnit = sizeof(std::uint64_t);
  /// Bytes that what is told to all at a time should take about: what is more is told in pieces,
  /// so that a rank needs little more memory than one process.
  static constexpr std::size_t kUsualRoom = std::size_t{1} << 20;

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

/// Things of several ranks, one after the other in the order of the ranks. They are plain numbers;
/// Eigen's small vectors are, though not by the letter trivially copyable.
template <class Thing>
struct ThingsOfRanks {
  static_assert(std::is_trivially_destructible_v<Thing> && sizeof(Thing) % Ranks::kUnit == 0);

  /// Makes room for so many of each rank.
  explicit ThingsOfRanks(std::vector<std::size_t> of_ranks) : counts(std::move(of_ranks)) {
    things.resize(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  }

  std::vector<std::size_t> counts;  ///< by rank
  std::vector<Thing> things;

  std::span<const Thing> of(int rank) const {
    return std::span(things).subspan(begin(rank), count(rank));
  }
  std::span<Thing> of(int rank) { return std::span(things).subspan(begin(rank), count(rank)); }
  /// Bytes of each rank.
  std::vector<std::size_t> sizes() const {
    std::vector<std::size_t> bytes;
    for (const std::size_t of_rank : counts) bytes.push_back(of_rank * sizeof(Thing));
    return bytes;
  }

 private:
  std::size_t count(int rank) const { return counts[static_cast<std::size_t>(rank)]; }
  std::size_t begin(int rank) const {
    return std::accumulate(counts.begin(), counts.begin() + rank, std::size_t{0});
  }
};

/// What each rank says, by rank. Called by all of them.
template <class Thing>
std::vector<Thing> told_by_each(Ranks& ranks, const Thing& own) {
  ThingsOfRanks<Thing> all(std::vector<std::size_t>(static_cast<std::size_t>(ranks.count()), 1));
  all.of(ranks.rank())[0] = own;
  ranks.gather(std::as_writable_bytes(std::span(all.things)), all.sizes());
  return std::move(all.things);
}

/// Tells all ranks the things of each. Called by all of them.
template <class Thing>
ThingsOfRanks<Thing> told_to_all(Ranks& ranks, std::span<const Thing> own) {
  ThingsOfRanks<Thing> all(told_by_each(ranks, own.size()));
  std::ranges::copy(own, all.of(ranks.rank()).begin());
  ranks.gather(std::as_writable_bytes(std::span(all.things)), all.sizes());
  return all;
}

/// Gives each thing to one rank. Called by all of them.
/// @param receiver  (thing) -> rank
/// @returns what comes to this one, of each rank in the order in which it has them
template <class Thing, class Receiver>
ThingsOfRanks<Thing> dealt_out(Ranks& ranks, std::span<const Thing> things,
                               const Receiver& receiver) {
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<std::size_t> counts(count, 0);
  for (const Thing& thing : things) ++counts[static_cast<std::size_t>(receiver(thing))];
  ThingsOfRanks<Thing> sent(counts);
  std::vector<Thing*> next;
  for (int rank = 0; rank < ranks.count(); ++rank) next.push_back(sent.of(rank).data());
  for (const Thing& thing : things) *next[static_cast<std::size_t>(receiver(thing))]++ = thing;
  std::vector<std::size_t> to_come(count, 0);
  const std::vector<std::size_t> units(count, sizeof(std::size_t));
  ranks.begin_exchange(std::as_bytes(std::span(counts)), units,
                       std::as_writable_bytes(std::span(to_come)), units);
  ranks.end_exchange();
  ThingsOfRanks<Thing> received(std::move(to_come));
  ranks.begin_exchange(std::as_bytes(std::span(sent.things)), sent.sizes(),
                       std::as_writable_bytes(std::span(received.things)), received.sizes());
  ranks.end_exchange();
  return received;
}

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

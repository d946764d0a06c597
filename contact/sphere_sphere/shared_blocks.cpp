// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/shared_blocks.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>
#include <utility>

namespace plekton::contact {
namespace {

using geometry::IndexPair;

/// Ranks have equal parts of the order, to count what comes first there.
struct PartsOfOrder {
  std::size_t places;
  std::size_t count;

  int rank_of(std::size_t place) const { return static_cast<int>(place * count / places); }
  std::size_t begin(int rank) const {
    return (static_cast<std::size_t>(rank) * places + count - 1) / count;
  }
};

}  // namespace

std::vector<IndexPair> SharedBlocks::deal_out(std::span<const IndexPair> found,
                                              std::span<const SphereBody> spheres, Positions x,
                                              SphereBlocks& blocks) {
  owners_.clear();
  own_.clear();
  const auto of_ranks = geometry::told_by_each(*ranks_, spheres_in(found));
  blocks.order(spheres.first(std::ranges::max(of_ranks)), x);
  std::vector<IndexPair> pairs;
  if (SphereBlocks::block_count(blocks.sphere_count()) == 1) {
    pairs = geometry::told_to_all(*ranks_, found).things;
    blocks.cut(blocks.find_cuts(pairs, {0, blocks.sphere_count(), 0, pairs.size()}));
  } else {
    pairs = cut_and_deal_out(found, blocks);
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// Pairs go to those who count them first, as owners depend on where blocks begin.
std::vector<IndexPair> SharedBlocks::cut_and_deal_out(std::span<const IndexPair> found,
                                                      SphereBlocks& blocks) {
  const auto count = static_cast<std::size_t>(ranks_->count());
  const int self = ranks_->rank();
  const PartsOfOrder parts{blocks.sphere_count(), count};
  const std::vector<IndexPair> counted =
      geometry::dealt_out(*ranks_, found, [&](const IndexPair& pair) {
        return parts.rank_of(blocks.first_place(pair));
      }).things;
  const std::vector<std::uint64_t> of_ranks =
      geometry::told_by_each(*ranks_, std::uint64_t{counted.size()});
  const auto pairs_before = std::accumulate(of_ranks.begin(), of_ranks.begin() + self, 0UL);
  const auto all_pairs = std::accumulate(of_ranks.begin() + self, of_ranks.end(), pairs_before);
  const std::span<const SphereBlocks::Cut> cuts = blocks.find_cuts(
      counted, {parts.begin(self), parts.begin(self + 1), pairs_before, all_pairs});
  blocks.cut(geometry::told_to_all(*ranks_, cuts).things);
  owners_ = ranks_->owners(blocks.work());
  blocks_of_.assign(count, {});
  for (std::size_t k = 0; k < owners_.size(); ++k)
    blocks_of_[static_cast<std::size_t>(owners_[k])].push_back(static_cast<std::uint32_t>(k));
  own_ = blocks_of_[static_cast<std::size_t>(self)];
  return geometry::dealt_out(*ranks_, std::span<const IndexPair>(counted),
                             [&](const IndexPair& pair) { return rank_of(pair, blocks); })
      .things;
}

int SharedBlocks::rank_of(const IndexPair& pair, const SphereBlocks& blocks) const noexcept {
  const bool is_in_a_block =
      static_cast<std::size_t>(std::max(pair.a, pair.b)) < blocks.sphere_count();
  return is_in_a_block ? owners_[blocks.block_at(blocks.first_place(pair))] : 0;
}

void SharedBlocks::fill(std::span<const IndexPair> pairs, std::span<const SphereBody> spheres,
                        std::span<const std::uint8_t> kinds, geometry::ThreadPool& pool,
                        Positions x, SphereBlocks& blocks) {
  blocks.fill(pairs, spheres, kinds, {holders(), ranks_->rank()}, pool, x);
  find_messages(blocks);
}

void SharedBlocks::share_motion(const SphereBlocks& blocks, std::span<const NodeId> met) {
  if (is_worth_it())
    motion_.assign(blocks, owners_, met);
  else
    motion_.assign_nothing();
}

/// What other ranks have of spheres here is added with what this one has, in the order of the
/// blocks. Ranks tell of their ghosts in the order in which sums are sent later.
void SharedBlocks::find_messages(SphereBlocks& blocks) {
  using GhostOf = SphereBlocks::GhostOf;
  const int self = ranks_->rank();
  const auto owner_of = [&](const GhostOf& ghost) {
    return is_worth_it() ? owners_[blocks.block_of(ghost.sphere)] : self;
  };
  std::vector<std::pair<GhostOf, std::uint32_t>> added;
  std::vector<GhostOf> told;
  std::vector<std::vector<std::uint32_t>> to(static_cast<std::size_t>(ranks_->count()));
  std::vector<std::uint8_t> is_at_border(owners_.size(), 0);
  std::uint32_t here = 0;
  blocks.for_each_ghost_here([&](const GhostOf& of, std::uint32_t ghost) {
    ++here;
    const int owner = owner_of(of);
    if (owner == self) {
      added.emplace_back(of, ghost);
      return;
    }
    told.push_back(of);
    to[static_cast<std::size_t>(owner)].push_back(ghost);
    is_at_border[of.block] = 1;
  });
  const auto of_others =
      is_worth_it() ? geometry::dealt_out(*ranks_, std::span<const GhostOf>(told), owner_of)
                    : geometry::ThingsOfRanks<GhostOf>(std::vector<std::size_t>(to.size(), 0));
  sent_ = {};
  received_ = {};
  for (const std::vector<std::uint32_t>& ghosts : to) {
    sent_.ghosts.insert(sent_.ghosts.end(), ghosts.begin(), ghosts.end());
    sent_.sizes.push_back(ghosts.size() * kSphereBytes);
  }
  for (const GhostOf& of : of_others.things) {
    received_.ghosts.push_back(here + static_cast<std::uint32_t>(received_.ghosts.size()));
    added.emplace_back(of, received_.ghosts.back());
  }
  for (const std::size_t count : of_others.counts) received_.sizes.push_back(count * kSphereBytes);
  for (Messages* const messages : {&sent_, &received_})
    messages->bytes.resize(messages->ghosts.size() * kSphereBytes);
  std::ranges::stable_sort(added, {}, [](const auto& ghost) { return ghost.first.block; });
  blocks.take_ghosts(added, of_others.things.size());
  border_.clear();
  inner_.clear();
  for (const std::uint32_t k : own_) (is_at_border[k] != 0 ? border_ : inner_).push_back(k);
}

void SharedBlocks::begin_ghosts(std::span<const SphereSum> sums) {
  std::byte* to = sent_.bytes.data();
  for (const std::uint32_t ghost : sent_.ghosts) {
    std::memcpy(to, sums[ghost].numbers.data(), kSphereBytes);
    to += kSphereBytes;
  }
  ranks_->begin_exchange(sent_.bytes, sent_.sizes, received_.bytes, received_.sizes);
}

void SharedBlocks::end_ghosts(std::span<SphereSum> sums) {
  ranks_->end_exchange();
  const std::byte* from = received_.bytes.data();
  for (const std::uint32_t ghost : received_.ghosts) {
    std::memcpy(sums[ghost].numbers.data(), from, kSphereBytes);
    from += kSphereBytes;
  }
}

void SharedBlocks::find_sizes_of_gather() {
  sizes_.resize(blocks_of_.size());
  std::size_t total = 0;
  for (std::size_t rank = 0; rank < sizes_.size(); ++rank) {
    const std::size_t nodes = motion_.common_in_blocks(static_cast<int>(rank)).size();
    sizes_[rank] = sizeof(BlockTotals) + nodes * kSphereBytes;
    total += sizes_[rank];
  }
  parts_.resize(total);
}

/// Each rank tells what its blocks came to, then force and torque of each of its common spheres.
BlockTotals SharedBlocks::gather(NodeForces& forces, const BlockTotals& of_own) {
  static_assert(std::is_trivially_copyable_v<BlockTotals> &&
                sizeof(BlockTotals) % geometry::Ranks::kUnit == 0);
  find_sizes_of_gather();
  const auto self = static_cast<std::size_t>(ranks_->rank());
  std::byte* to = std::accumulate(sizes_.begin(), sizes_.begin() + ranks_->rank(), parts_.data());
  std::memcpy(to, &of_own, sizeof(BlockTotals));
  to += sizeof(BlockTotals);
  for (const NodeId node : motion_.common_in_blocks(ranks_->rank())) {
    std::memcpy(to, forces.force[index_of(node)].data(), sizeof(Vec3));
    std::memcpy(to + sizeof(Vec3), forces.torque[index_of(node)].data(), sizeof(Vec3));
    to += kSphereBytes;
  }
  ranks_->gather(parts_, sizes_);
  BlockTotals totals;
  const std::byte* from = parts_.data();
  for (std::size_t rank = 0; rank < sizes_.size(); ++rank) {
    BlockTotals of_rank;
    std::memcpy(&of_rank, from, sizeof(BlockTotals));
    totals += of_rank;
    if (rank == self) {
      from += sizes_[rank];
      continue;
    }
    from += sizeof(BlockTotals);
    for (const NodeId node : motion_.common_in_blocks(static_cast<int>(rank))) {
      std::memcpy(forces.force[index_of(node)].data(), from, sizeof(Vec3));
      std::memcpy(forces.torque[index_of(node)].data(), from + sizeof(Vec3), sizeof(Vec3));
      from += kSphereBytes;
    }
  }
  return totals;
}

std::vector<RankShare> SharedBlocks::shares() const {
  if (!is_worth_it() || !motion_.is_of_use()) return {};
  std::vector<RankShare> shares;
  for (int rank = 0; rank < ranks_->count(); ++rank)
    shares.push_back(
        {blocks_of_[static_cast<std::size_t>(rank)].size(), motion_.private_to(rank).size()});
  return shares;
}

}  // namespace plekton::contact

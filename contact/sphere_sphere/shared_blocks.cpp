// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/shared_blocks.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>

namespace plekton::contact {

std::uint64_t SharedBlocks::work_of(const SphereBlocks& blocks, const SphereBlocks::Block& block) {
  std::uint64_t pairs = 0;
  for (const SphereBlocks::Range& range : blocks.ranges(block)) pairs += range.pair_count;
  return pairs + 2 * std::uint64_t{block.owned};
}

void SharedBlocks::assign(const SphereBlocks& blocks) {
  std::vector<std::uint64_t> work;
  for (const SphereBlocks::Block& block : blocks.blocks()) work.push_back(work_of(blocks, block));
  owners_ = ranks_->owners(work);
  const auto count = static_cast<std::size_t>(ranks_->count());
  blocks_of_.assign(count, {});
  for (std::size_t k = 0; k < owners_.size(); ++k) {
    const auto owner = static_cast<std::size_t>(owners_[k]);
    blocks_of_[owner].push_back(static_cast<std::uint32_t>(k));
  }
  own_ = blocks_of_[static_cast<std::size_t>(ranks_->rank())];
  find_messages(blocks);
}

void SharedBlocks::share_motion(const SphereBlocks& blocks, std::span<const NodeId> met) {
  if (is_worth_it())
    motion_.assign(blocks, owners_, met);
  else
    motion_.assign_nothing();
}

/// Both sides go through the ghosts in the same order: by block of the owner, then by ghost.
void SharedBlocks::find_messages(const SphereBlocks& blocks) {
  const auto count = static_cast<std::size_t>(ranks_->count());
  const int self = ranks_->rank();
  std::vector<std::vector<std::uint32_t>> to(count), from(count);
  std::vector<std::uint32_t> computes(blocks.ghost_count());  // block by ghost
  std::vector<std::uint8_t> is_at_border(owners_.size(), 0);
  for (std::size_t k = 0; k < owners_.size(); ++k) {
    const SphereBlocks::Block& block = blocks.blocks()[k];
    std::fill_n(computes.begin() + block.first_ghost, block.ghosts(),
                static_cast<std::uint32_t>(k));
  }
  for (std::size_t k = 0; k < owners_.size(); ++k) {
    const int owner = owners_[k];
    const auto add = [&](NodeId, std::uint32_t ghost) {
      const int computing = owners_[computes[ghost]];
      if (computing == owner) return;
      is_at_border[computes[ghost]] = 1;
      if (computing == self) to[static_cast<std::size_t>(owner)].push_back(ghost);
      if (owner == self) from[static_cast<std::size_t>(computing)].push_back(ghost);
    };
    blocks.for_each_ghost(k, add, [](NodeId, std::uint32_t) {});
  }
  border_.clear();
  inner_.clear();
  for (const std::uint32_t k : own_) (is_at_border[k] != 0 ? border_ : inner_).push_back(k);
  const auto set = [](Messages& messages, const std::vector<std::vector<std::uint32_t>>& ghosts) {
    messages.ghosts.clear();
    messages.sizes.clear();
    for (const auto& of_rank : ghosts) {
      messages.ghosts.insert(messages.ghosts.end(), of_rank.begin(), of_rank.end());
      messages.sizes.push_back(of_rank.size() * kSphereBytes);
    }
    messages.bytes.resize(messages.ghosts.size() * kSphereBytes);
  };
  set(sent_, to);
  set(received_, from);
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_pieces.hpp"

#include "contact/tracking/rekey.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace plekton::contact {

void PlanePieces::clear() {
  pieces_.clear();
  order_.clear();
  sum_of_.clear();
  planes_.clear();
  tellers_.clear();
  motion_ = nullptr;
}

void PlanePieces::assign(std::span<const geometry::IndexPair> keys,
                         std::span<const SphereBody> spheres, const SphereHolders& holders) {
  clear();
  make_room(order_, keys.size());
  make_room(sum_of_, keys.size());
  if (!holders.of_blocks.empty()) {
    motion_ = holders.motion;
    for (const geometry::IndexPair& key : keys)
      tellers_.push_back(motion_->owner_of(spheres[static_cast<std::size_t>(key.a)].node));
  }
  sort_by_block(keys, *holders.blocks);
  cut(keys, holders);
}

/// By counting.
void PlanePieces::sort_by_block(std::span<const geometry::IndexPair> keys,
                                const SphereBlocks& blocks) {
  const std::size_t count = blocks.blocks().size();
  const auto block_of = [&](std::size_t i) {
    const std::int32_t sphere = keys[i].a;
    return static_cast<std::size_t>(sphere) < blocks.sphere_count() ? blocks.block_of(sphere)
                                                                    : count;
  };
  std::vector<std::uint32_t>& first = first_of_block_;
  first.assign(count + 2, 0);
  for (std::size_t i = 0; i < keys.size(); ++i) ++first[block_of(i)];
  std::exclusive_scan(first.begin(), first.end(), first.begin(), 0U);
  make_room(sorted_, keys.size());
  sorted_.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    sorted_[first[block_of(i)]++] = static_cast<std::uint32_t>(i);
  // Now each entry is where the next one's contacts begin.
  std::copy_backward(first.begin(), first.end() - 1, first.end());
  first[0] = 0;
}

/// Pieces are cut from all contacts of a block, so that they are the same on all ranks.
void PlanePieces::cut(std::span<const geometry::IndexPair> keys, const SphereHolders& holders) {
  const int self = motion_ == nullptr ? 0 : motion_->ranks().rank();
  for (std::size_t block = 0; block + 1 < first_of_block_.size(); ++block) {
    const int holder = block < holders.of_blocks.size() ? holders.of_blocks[block] : 0;
    const std::uint32_t last = first_of_block_[block + 1];
    for (std::uint32_t begin = first_of_block_[block], end = begin; begin < last; begin = end) {
      const auto is_of_last = [&] { return keys[sorted_[end]].a == keys[sorted_[end - 1]].a; };
      end = static_cast<std::uint32_t>(std::min<std::size_t>(last, begin + kFull));
      while (end < last && is_of_last()) ++end;
      const auto contacts = std::span(sorted_).subspan(begin, end - begin);
      if (motion_ == nullptr || holder == self) {
        add_piece(contacts, keys, true);
        continue;
      }
      common_.clear();
      std::ranges::copy_if(contacts, std::back_inserter(common_), [this](std::uint32_t i) {
        return tellers_[i] == SharedMotion::kCommon;
      });
      if (!common_.empty()) add_piece(common_, keys, false);
    }
  }
}

void PlanePieces::add_piece(std::span<const std::uint32_t> contacts,
                            std::span<const geometry::IndexPair> keys, bool counts) {
  Piece piece{};
  piece.begin = static_cast<std::uint32_t>(order_.size());
  piece.first = static_cast<std::uint32_t>(planes_.size());
  piece.counts = counts;
  for (const std::uint32_t i : contacts) {
    const auto known = std::find(planes_.begin() + piece.first, planes_.end(), keys[i].b);
    order_.push_back(i);
    sum_of_.push_back(static_cast<std::uint32_t>(known - planes_.begin()));
    if (known == planes_.end()) planes_.push_back(keys[i].b);
  }
  piece.end = static_cast<std::uint32_t>(order_.size());
  piece.last = static_cast<std::uint32_t>(planes_.size());
  pieces_.push_back(piece);
}

}  // namespace plekton::contact

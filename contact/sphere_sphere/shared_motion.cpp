// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/shared_motion.hpp"

#include <algorithm>
#include <cstring>

namespace plekton::contact {
namespace {

/// Calls visit(numbers, how many) for what a neighbour has to know of a node: position, velocity,
/// angular velocity.
template <class Visit>
void for_each_part_of_ghost(const NodesInMotion& nodes, NodeId node, Visit&& visit) {
  const std::size_t i = index_of(node);
  for (const std::span<Vec3>* const vectors :
       {&nodes.position, &nodes.velocity, &nodes.angular_velocity})
    visit((*vectors)[i].data(), 3);
}
constexpr std::size_t kGhostBytes = 9 * sizeof(double);

/// The same for all that there is of a node.
template <class Visit>
void for_each_part(const NodesInMotion& nodes, NodeId node, Visit&& visit) {
  const std::size_t i = index_of(node);
  for_each_part_of_ghost(nodes, node, visit);
  visit(nodes.orientation[i].coeffs().data(), 4);
  visit(nodes.force[i].data(), 3);
  visit(nodes.torque[i].data(), 3);
}
constexpr std::size_t kNodeBytes = 19 * sizeof(double);

/// Appends numbers to a message.
struct Write {
  std::byte* to;
  void operator()(const double* numbers, std::size_t count) noexcept {
    std::memcpy(to, numbers, count * sizeof(double));
    to += count * sizeof(double);
  }
};

/// Takes the next numbers of a message.
struct Read {
  const std::byte* from;
  void operator()(double* numbers, std::size_t count) noexcept {
    std::memcpy(numbers, from, count * sizeof(double));
    from += count * sizeof(double);
  }
};

void sort_and_unite(std::vector<NodeId>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

}  // namespace

void SharedMotion::keep_common(std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) kept_[index_of(node)] = 1;
  is_due_ = true;
}

void SharedMotion::assign_nothing() noexcept {
  is_due_ = false;
  owners_.clear();
  common_.clear();
}

void SharedMotion::assign(const SphereBlocks& blocks, std::span<const int> owners,
                          std::span<const NodeId> met) {
  is_due_ = false;
  find_owners(blocks, owners, met);
  common_.clear();
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    if (owners_[i] == kCommon) common_.push_back(geometry::id_at<NodeId>(i));
  }
  find_ghosts(blocks, owners);
}

void SharedMotion::find_owners(const SphereBlocks& blocks, std::span<const int> owners,
                               std::span<const NodeId> met) {
  const auto count = static_cast<std::size_t>(ranks_->count());
  std::vector<std::uint8_t> is_common = kept_;
  is_common.resize(blocks.node_count());
  for (const NodeId node : met) is_common[index_of(node)] = 1;
  owners_.assign(blocks.node_count(), kCommon);
  common_in_blocks_.assign(count, {});
  private_to_.assign(count, {});
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const auto rank = static_cast<std::size_t>(owners[k]);
    for (const std::int32_t sphere : blocks.spheres_of(k)) {
      const NodeId node = blocks.node_of(sphere);
      if (is_common[index_of(node)] != 0) {
        common_in_blocks_[rank].push_back(node);
      } else {
        private_to_[rank].push_back(node);
        owners_[index_of(node)] = owners[k];
      }
    }
  }
  for (auto& nodes : common_in_blocks_) std::sort(nodes.begin(), nodes.end());
  for (auto& nodes : private_to_) std::sort(nodes.begin(), nodes.end());
}

/// Each rank tells of which nodes it has to be told.
void SharedMotion::find_ghosts(const SphereBlocks& blocks, std::span<const int> owners) {
  const int self = ranks_->rank();
  std::vector<std::vector<NodeId>> from(static_cast<std::size_t>(ranks_->count()));
  blocks.for_each_ghost_here([&](const SphereBlocks::GhostOf& ghost, std::uint32_t) {
    if (owners[ghost.block] != self) return;
    const NodeId node = blocks.node_of(ghost.sphere);
    const std::int32_t owner = owner_of(node);
    if (owner != kCommon && owner != self) from[static_cast<std::size_t>(owner)].push_back(node);
  });
  std::vector<std::uint64_t> asked;  // nodes, as what is told has 8 bytes
  received_ = {};
  for (std::vector<NodeId>& nodes : from) {
    sort_and_unite(nodes);
    for (const NodeId node : nodes) asked.push_back(index_of(node));
    received_.nodes.insert(received_.nodes.end(), nodes.begin(), nodes.end());
    received_.sizes.push_back(nodes.size() * kGhostBytes);
  }
  const auto to = geometry::dealt_out(
      *ranks_, std::span<const std::uint64_t>(asked),
      [&](std::uint64_t node) { return owner_of(geometry::id_at<NodeId>(node)); });
  sent_ = {};
  for (const std::uint64_t node : to.things) sent_.nodes.push_back(geometry::id_at<NodeId>(node));
  for (const std::size_t count : to.counts) sent_.sizes.push_back(count * kGhostBytes);
  for (Messages* const messages : {&sent_, &received_})
    messages->bytes.resize(messages->nodes.size() * kGhostBytes);
}

void SharedMotion::tell_neighbours(const NodesInMotion& nodes) {
  Write write{sent_.bytes.data()};
  for (const NodeId node : sent_.nodes) for_each_part_of_ghost(nodes, node, write);
  ranks_->begin_exchange(sent_.bytes, sent_.sizes, received_.bytes, received_.sizes);
  ranks_->end_exchange();
  Read read{received_.bytes.data()};
  for (const NodeId node : received_.nodes) for_each_part_of_ghost(nodes, node, read);
}

void SharedMotion::tell_all(const NodesInMotion& nodes) {
  if (!is_of_use()) return;
  std::size_t most = 0;
  for (const std::vector<NodeId>& of_rank : private_to_) most = std::max(most, of_rank.size());
  const std::size_t at_a_time =
      std::max<std::size_t>(1, geometry::Ranks::kUsualRoom / (kNodeBytes * private_to_.size()));
  for (std::size_t begin = 0; begin < most; begin += at_a_time)
    tell_all(nodes, begin, begin + at_a_time);
}

/// @param begin, end  of the private nodes of each rank, or as far as there are any
void SharedMotion::tell_all(const NodesInMotion& nodes, std::size_t begin, std::size_t end) {
  const auto part_of = [&](std::size_t rank) {
    const std::span<const NodeId> all = private_to_[rank];
    const std::size_t first = std::min(begin, all.size());
    return all.subspan(first, std::min(end, all.size()) - first);
  };
  const auto self = static_cast<std::size_t>(ranks_->rank());
  std::vector<std::size_t> sizes;
  std::size_t total = 0, first = 0;
  for (std::size_t rank = 0; rank < private_to_.size(); ++rank) {
    if (rank == self) first = total;
    sizes.push_back(part_of(rank).size() * kNodeBytes);
    total += sizes.back();
  }
  room_.resize(total);
  Write write{room_.data() + first};
  for (const NodeId node : part_of(self)) for_each_part(nodes, node, write);
  ranks_->gather(room_, sizes);
  Read read{room_.data()};
  for (std::size_t rank = 0; rank < private_to_.size(); ++rank) {
    if (rank == self) {
      read.from += sizes[rank];
      continue;
    }
    for (const NodeId node : part_of(rank)) for_each_part(nodes, node, read);
  }
}

}  // namespace plekton::contact

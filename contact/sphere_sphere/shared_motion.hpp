// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/sphere_sphere/sphere_blocks.hpp"
#include "geometry/base/ranks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace plekton::contact {

/// The motion of all nodes, and the forces on them, for ranks to tell each other of.
struct NodesInMotion {
  std::span<Vec3> position;          ///< m
  std::span<Vec3> velocity;          ///< m/s
  std::span<Vec3> angular_velocity;  ///< rad/s
  std::span<geometry::Quat> orientation;
  std::span<Vec3> force;   ///< N
  std::span<Vec3> torque;  ///< N m
};

/// Which rank moves which nodes.
///
/// A sphere with nothing but other spheres and planes near it concerns few: it is *private* to the
/// rank that has its block, which moves it, and tells those that have it as a ghost. All other nodes
/// are *common*: all ranks find the forces on them and move them, as one process would. So whatever
/// works on common nodes knows nothing of ranks; only what looks at all nodes has to ask for the
/// private ones of others first (tell_all()).
class SharedMotion {
 public:
  explicit SharedMotion(geometry::Ranks& ranks) : ranks_(&ranks) {}

  /// Nodes that are common whatever is near them. @param nodes  by NodeId, 1 or 0
  void keep_common(std::vector<std::uint8_t> nodes) { kept_ = std::move(nodes); }
  /// These too, from the next assign() on, which is due then.
  void keep_common(std::span<const NodeId> nodes);
  /// So are spheres near some planes, at which something looks in each step; from the next assign()
  /// on. @param planes  by plane, 1 or 0
  void keep_common_near(std::vector<std::uint8_t> planes) { kept_planes_ = std::move(planes); }
  bool keeps_common_near(std::size_t plane) const noexcept {
    return plane < kept_planes_.size() && kept_planes_[plane] != 0;
  }
  /// Whether other nodes are kept than those that assign() knew of.
  bool is_due() const noexcept { return is_due_; }

  /// Takes the blocks of a new list, those of this rank at least. All ranks have to know all nodes.
  /// @param owners  by block
  /// @param met     nodes of spheres that something is near to that makes them common; may be
  ///                there several times
  void assign(const SphereBlocks& blocks, std::span<const int> owners, std::span<const NodeId> met);
  /// All nodes are common.
  void assign_nothing() noexcept;

  geometry::Ranks& ranks() const noexcept { return *ranks_; }
  /// Whether any node is private.
  bool is_of_use() const noexcept { return !owners_.empty(); }
  /// The rank that a node is private to; kCommon: it is common.
  static constexpr std::int32_t kCommon = -1;
  std::int32_t owner_of(NodeId node) const noexcept {
    return owners_.empty() ? kCommon : owners_[index_of(node)];
  }

  // Ascending.
  std::span<const NodeId> common() const noexcept { return common_; }
  /// Private to this rank; asked for after assign().
  std::span<const NodeId> own() const noexcept { return private_to(ranks_->rank()); }
  /// Private to a rank.
  std::span<const NodeId> private_to(int rank) const noexcept {
    return private_to_[static_cast<std::size_t>(rank)];
  }
  /// Common nodes of spheres in the blocks of a rank.
  std::span<const NodeId> common_in_blocks(int rank) const noexcept {
    return common_in_blocks_[static_cast<std::size_t>(rank)];
  }

  /// Tells those who have a private sphere as a ghost where it is and how it moves.
  void tell_neighbours(const NodesInMotion& nodes);
  /// Tells all ranks all of all private nodes, some of each rank at a time.
  void tell_all(const NodesInMotion& nodes);

  /// Adds to sums over common nodes those that each rank made over its own. Sums may not depend on
  /// the order in which they are added.
  template <class Sums>
  void add_up(const Sums& of_own, Sums& sums) {
    add_up(std::span(&of_own, 1), std::span(&sums, 1));
  }
  /// The same of several, each by itself. @param sums  as many
  template <class Sums>
  void add_up(std::span<const Sums> of_own, std::span<Sums> sums) {
    static_assert(std::is_trivially_copyable_v<Sums> && sizeof(Sums) % geometry::Ranks::kUnit == 0);
    const auto count = static_cast<std::size_t>(ranks_->count());
    const std::size_t bytes = of_own.size_bytes();
    sizes_.assign(count, bytes);
    sums_.resize(count * bytes);
    std::memcpy(sums_.data() + static_cast<std::size_t>(ranks_->rank()) * bytes, of_own.data(),
                bytes);
    ranks_->gather(sums_, sizes_);
    for (std::size_t i = 0; i < count * of_own.size(); ++i) {
      Sums of_rank;
      std::memcpy(&of_rank, sums_.data() + i * sizeof(Sums), sizeof(Sums));
      sums[i % sums.size()] += of_rank;
    }
  }

 private:
  void find_owners(const SphereBlocks& blocks, std::span<const int> owners,
                   std::span<const NodeId> met);
  void find_ghosts(const SphereBlocks& blocks, std::span<const int> owners);
  void tell_all(const NodesInMotion& nodes, std::size_t begin, std::size_t end);

  /// Private nodes that are ghosts of other ranks.
  struct Messages {
    std::vector<NodeId> nodes;  ///< rank by rank
    std::vector<std::size_t> sizes;
    std::vector<std::byte> bytes;
  };

  geometry::Ranks* ranks_;
  std::vector<std::uint8_t> kept_;
  std::vector<std::uint8_t> kept_planes_;
  bool is_due_ = false;
  std::vector<std::int32_t> owners_;  ///< rank by node, or kCommon; empty: all are common
  std::vector<NodeId> common_;
  std::vector<std::vector<NodeId>> common_in_blocks_;  ///< by rank
  std::vector<std::vector<NodeId>> private_to_;        ///< by rank
  Messages sent_;
  Messages received_;
  std::vector<std::byte> room_;
  // Of add_up().
  std::vector<std::size_t> sizes_;
  std::vector<std::byte> sums_;
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/link.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

/// The spanning forest of least resistance: no link of it resists more than one left out that
/// closes a ring with it. Keeps its working space, so that a warm call does not allocate.
class SpanningForest {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// What a vertex hangs on in its tree; all kNone, but a depth of 0, of a root.
  struct Parent {
    std::uint32_t vertex;
    std::uint32_t link;
    std::uint32_t depth;
  };

  /// Of links of equal resistance the first ones are taken.
  /// @param links  loops (a == b) are in neither list
  void grow(std::uint32_t vertex_count, std::span<const Link> links);
  /// Finds the parents; of the last grow(), with the same links.
  void hang(std::span<const Link> links);

  std::span<const std::uint32_t> tree_links() const noexcept { return tree_links_; }
  /// The links left out.
  std::span<const std::uint32_t> closing_links() const noexcept { return closing_links_; }
  /// Vertices that hang together have the same root, the lowest of them.
  std::uint32_t root_of(std::uint32_t vertex) const noexcept;

  const Parent& parent(std::uint32_t vertex) const noexcept { return parent_[vertex]; }
  /// All vertices, parents before what hangs on them.
  std::span<const std::uint32_t> downwards() const noexcept { return downwards_; }

 private:
  std::vector<std::uint32_t> order_;  ///< links by rising resistance
  std::vector<std::uint32_t> root_;
  std::vector<std::uint32_t> tree_links_;
  std::vector<std::uint32_t> closing_links_;
  std::vector<Parent> parent_;
  std::vector<std::uint32_t> downwards_;
  std::vector<std::uint32_t> first_;  ///< by vertex: where its links begin in at_
  std::vector<std::uint32_t> at_;     ///< tree links by vertex
};

}  // namespace plekton::contact

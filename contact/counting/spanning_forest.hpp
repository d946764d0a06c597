// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/link.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

/// A spanning forest of little resistance: no link of it resists more than twice what one does that
/// is left out and closes a cycle with it, nor at all if that one does not. Keeps its working
/// space, so that a warm call does not allocate.
class SpanningForest {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// What a vertex hangs on in its tree; kNone, of a root.
  struct Parent {
    std::uint32_t vertex;
    std::uint32_t link;
  };

  /// Almost linear in the links.
  /// @param links  resistances >= 0; loops (a == b) are in neither list
  void grow(std::uint32_t vertex_count, std::span<const Link> links);
  /// Finds the parents; of the last grow(), with the same links.
  void hang(std::span<const Link> links);

  /// The links left out, by rising resistance, but for a factor of 2.
  std::span<const std::uint32_t> closing_links() const noexcept { return closing_links_; }

  const Parent& parent(std::uint32_t vertex) const noexcept { return parent_[vertex]; }
  /// All vertices, parents before what hangs on them.
  std::span<const std::uint32_t> downwards() const noexcept { return downwards_; }

 private:
  void sort_by_resistance(std::span<const Link> links);

  std::vector<std::uint32_t> order_;  ///< links by rising resistance, but for a factor of 2
  std::vector<std::uint32_t> root_;   ///< by vertex: the lowest of its tree, or one on the way
  std::vector<std::uint32_t> tree_links_;
  std::vector<std::uint32_t> closing_links_;
  std::vector<Parent> parent_;
  std::vector<std::uint32_t> downwards_;
  std::vector<std::uint32_t> first_;  ///< by exponent, then by vertex: where its links begin
  std::vector<std::uint32_t> at_;     ///< tree links by vertex
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/link.hpp"
#include "contact/counting/spanning_forest.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// A cycle that a piece of surface fills: what goes along it can be pulled across, so it holds no
/// hole.
struct Filling {
  std::uint32_t upper;  ///< its highest vertex
  std::array<std::uint32_t, 4> links;
  std::array<std::int8_t, 4> signs;  ///< 1: the cycle goes from a to b, -1: from b to a
  std::uint8_t count;                ///< of links, at most 4
};

/// A part of a complex: vertices with the links between them, and the cycles that are filled.
struct ComplexPart {
  std::uint32_t vertex_count;   ///< of vertices, the first ones
  std::uint32_t filling_count;  ///< cycles are filled whose upper vertex is below this one
};

/// The open cycles of a complex of vertices, links and filled cycles, of every part of it.
///
/// Each link that closes a cycle opens a hole; each filling shuts the youngest hole that it is the
/// first, with older ones, to close. So it is known once for all levels which holes are open.
/// Source: persistence, Edelsbrunner & Harer, Computational Topology (2010), VII.
class CycleBasis {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param links     a > b (the upper vertex is a), ascending by a
  /// @param fillings  ascending by upper
  void build(std::uint32_t vertex_count, std::span<const Link> links,
             std::span<const Filling> fillings);

  /// Upper vertices of the fillings that shut a hole which was open at lower vertices; ascending.
  std::span<const std::uint32_t> fillers() const noexcept { return fillers_; }

  /// Vertices that shut holes, and those whose fillings find none that is open and shut a void;
  /// ascending.
  std::span<const std::uint32_t> maxima() const noexcept { return maxima_; }

  /// By vertex: how many links go down from it, but for those that close a cycle which is filled at
  /// once; 0 of a minimum. All but one of them join pieces or open holes.
  std::span<const std::uint32_t> branches() const noexcept { return branches_; }

  /// The lowest of the vertices that hang together with one.
  std::uint32_t root_of(std::uint32_t vertex) const noexcept {
    while (root_[vertex] != vertex) vertex = root_[vertex];
    return vertex;
  }

  /// Holes of a part.
  std::size_t hole_count(const ComplexPart& part) const noexcept;

  /// How many holes of a part are shut by fillings with an upper vertex in [part.filling_count,
  /// end).
  std::size_t shut_count(const ComplexPart& part, std::uint32_t end) const noexcept;

  /// How many holes fillings with an upper vertex in [first, end) shut that were open at lower
  /// vertices, or at lower ones of these.
  std::size_t shut_count(std::uint32_t first, std::uint32_t end) const noexcept;

  /// As many independent sets of drops along the links of a part as it has holes, row by row: sums
  /// of drops round filled cycles are 0. They are small whole numbers, on links that resist at
  /// least half as much as any on the way round them, and 0 on the others. Of each row one of the
  /// links that resist least, but for a factor of 2, is in no other row: so rows stay independent
  /// however different the resistances are.
  /// @param links  those of the part, with resistances > 0 (any unit)
  /// @param drops  row x link; hole_count(part) rows
  /// @param shut   row x shut_count(part, end): the sums of these drops round the cycles that are
  ///               filled then
  void find_drops(const ComplexPart& part, std::uint32_t end, std::span<const Link> links,
                  std::span<double> drops, std::span<double> shut);

 private:
  /// A link that closes a cycle, and the filling that closes the cycle, if any does.
  struct Closing {
    std::uint32_t link;
    std::uint32_t upper;      ///< vertex from which on the cycle is there
    std::uint32_t filled_at;  ///< upper vertex of that filling, or kNone
    std::uint32_t first;      ///< currents of the filling in this and older closing links, which
    std::uint32_t count;      ///< say all of them; this one is the last
    bool is_open(const ComplexPart& part) const noexcept {
      return upper < part.vertex_count && filled_at >= part.filling_count;
    }
    bool is_shut(const ComplexPart& part, std::uint32_t end) const noexcept {
      return is_open(part) && filled_at < end;
    }
  };
  struct Current {
    std::uint32_t closing;
    double current;
  };

  void find_closings(std::uint32_t vertex_count, std::span<const Link> links);
  void reduce(const Filling& filling);
  void list_fillers();
  void count_branches(std::uint32_t vertex_count, std::span<const Link> links);
  void set_circulation(std::size_t open, const ComplexPart& part);
  void set_shut(const ComplexPart& part, std::uint32_t end, std::span<double> shut) const;
  void set_apart(std::size_t rows, std::span<double> drops, std::span<double> shut) const;
  void set_on_no_tree(std::span<const Link> links, std::span<double> drops);

  std::vector<Closing> closings_;     ///< by link, oldest first
  std::vector<std::uint32_t> place_;  ///< by link: its place among the closings, or kNone
  std::vector<std::uint32_t> root_;   ///< by vertex: the lowest of its piece, or one on the way
  std::vector<Current> currents_;
  std::vector<double> row_;  ///< by closing
  std::vector<std::uint32_t> fillers_;
  std::vector<std::uint32_t> maxima_;
  std::vector<std::uint32_t> branches_;
  // Working space of find_drops().
  SpanningForest forest_;          ///< of little resistance
  std::vector<double> potential_;  ///< by vertex
};

}  // namespace plekton::contact

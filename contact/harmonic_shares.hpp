// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/elimination.hpp"
#include "contact/spanning_forest.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// A ring that a piece of surface fills: what goes along it can be pulled across, so it holds no
/// hole.
struct Filling {
  std::uint32_t upper;  ///< its highest vertex
  std::array<std::uint32_t, 4> links;
  std::array<std::int8_t, 4> signs;  ///< 1: the ring goes from a to b, -1: from b to a
  std::uint8_t count;                ///< of links, at most 4
};

/// How the holes of a complex of vertices, links and filled rings are shared over its links, for
/// every part of it below a vertex.
///
/// The share of a link is its diagonal entry of the projection on the harmonic currents: those that
/// flow round the holes, without sources, and are orthogonal to every filled ring, when a current i
/// in a link weighs resistance * i^2. So the shares of all links add up to the number of holes; a
/// hole is shared over the links around it in proportion to how much of the current passes through
/// each, and how much that link resists; a link on no such way has none. Without fillings it is one
/// minus the weight of spanning_weights.hpp.
/// Source: Eckmann, Harmonische Funktionen und Randwertaufgaben in einem Komplex, Comment. Math.
/// Helv. 17 (1945); which rings are open below a vertex: Edelsbrunner & Harer, Computational
/// Topology (2010), VII (persistence; here once for all levels).
class HarmonicShares {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  /// @param links     a > b (the upper vertex is a), ascending by a
  /// @param fillings  ascending by upper
  void build(std::uint32_t vertex_count, std::span<const Link> links,
             std::span<const Filling> fillings);

  /// Holes of the part of all vertices below this number.
  std::size_t hole_count(std::uint32_t vertex_count) const noexcept;

  /// Shares of the links of that part, which come first among all links.
  /// @param links  with the resistances (any unit) to be used; the same links as were given to
  ///               build()
  /// @returns      in the order of the links; valid until the next call
  std::span<const double> find(std::uint32_t vertex_count, std::span<const Link> links);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// A link that closes a ring, and the filling that closes the ring, if any does.
  struct Closing {
    std::uint32_t link;
    std::uint32_t upper;      ///< vertex from which on the ring is there
    std::uint32_t filled_at;  ///< upper vertex of that filling, or kNone
    std::uint32_t first;      ///< currents of the filling in this and older closing links, which
    std::uint32_t count;      ///< say all of them; this one is the last
    bool is_open(std::uint32_t vertex_count) const noexcept {
      return upper < vertex_count && filled_at >= vertex_count;
    }
  };
  struct Current {
    std::uint32_t closing;
    double current;
  };

  void find_closings(std::uint32_t vertex_count, std::span<const Link> links);
  void reduce(const Filling& filling);
  void set_circulation(std::size_t open, std::uint32_t vertex_count, std::span<const Link> links);
  void set_on_no_tree(std::span<const Link> links);
  void set_conductances(std::span<const Link> links);
  void take_off_potential(std::span<const Link> links);
  void orthonormalise(std::size_t hole_count, std::size_t link_count);

  std::uint32_t vertex_count_ = 0;
  std::vector<Closing> closings_;     ///< by link, oldest first
  std::vector<std::uint32_t> place_;  ///< by link: its place among the closings, or kNone
  std::vector<std::uint32_t> root_;
  std::vector<Current> currents_;
  std::vector<double> row_;  ///< by closing
  // Working space of find().
  SpanningForest forest_;                               ///< of little resistance
  std::vector<double> potential_;                       ///< by vertex
  std::vector<double> conductance_, root_conductance_;  ///< by link
  Elimination elimination_;
  bool is_planned_ = false;     ///< elimination_, for the links of the last build()
  std::vector<double> source_;  ///< by vertex, then the potential
  std::vector<double> flows_;   ///< open ring x link
  std::vector<double> shares_;
};

}  // namespace plekton::contact

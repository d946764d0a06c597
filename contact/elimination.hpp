// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/link.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Potentials of a network of links with sources at its vertices, for every part of it below a
/// vertex.
///
/// Vertices are eliminated one after the other: what coupled one couples its neighbours instead.
/// Nothing is ever subtracted (Grassmann, Taksar & Heyman, Operations Research 33 (1985)), so the
/// couplings are accurate however different the conductances are. Of all vertices left the one with
/// the fewest neighbours goes first (minimum degree); the order and the places of the couplings are
/// found once for all parts, as a part couples no vertices that the whole does not.
class Elimination {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  void plan(std::uint32_t vertex_count, std::span<const Link> links);

  /// Eliminates the part below a vertex.
  /// @param conductances  >= 0, of the links of that part, which come first among all links
  void eliminate(std::uint32_t vertex_count, std::span<const double> conductances);

  /// Potentials of the last part, in place of its sources, which add up to 0 in each piece; 0 at
  /// the vertex of each piece that is eliminated last.
  /// @param sources  by vertex of the part
  void solve(std::span<double> sources) const noexcept;

  /// Memory and time of a part grow with it; a little more than linear in the links of a surface.
  std::size_t coupling_count() const noexcept { return columns_.size(); }

 private:
  void order_vertices(std::uint32_t vertex_count);
  void join_neighbours(std::uint32_t vertex);
  void place_links(std::span<const Link> links);

  /// The vertices that one may be coupled to when it is eliminated.
  struct Row {
    std::uint32_t vertex;
    std::uint32_t first;  ///< in columns_
    std::uint32_t count;
  };
  struct Coupling {
    std::uint32_t row;
    std::uint32_t vertex;
    double conductance;
  };
  /// A vertex of the part, and its couplings.
  struct Eliminated {
    std::uint32_t vertex;
    std::uint32_t first;
    std::uint32_t end;
    double pivot;  ///< sum of the couplings; 0 of the last of a piece
  };
  void couple(std::span<const Coupling> couplings, double pivot);

  std::vector<Row> rows_;                  ///< in the order of elimination
  std::vector<std::uint32_t> row_of_;      ///< by vertex
  std::vector<std::uint32_t> columns_;     ///< rows; ascending in each row
  std::vector<std::uint32_t> link_place_;  ///< by link: in columns_
  std::vector<double> room_;               ///< by place in columns_
  std::vector<Eliminated> eliminated_;     ///< in order
  std::vector<Coupling> couplings_;
  // Working space of plan().
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< by vertex, of those left, ascending
  std::vector<std::uint32_t> joined_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> queue_;  ///< neighbour count and vertex
};

}  // namespace plekton::contact

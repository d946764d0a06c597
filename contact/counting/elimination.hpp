// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/link.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// What is left of drops along the links of a network when potentials at its vertices take off as
/// much as they can, for every part of it below a vertex: the drops h with the least sum of
/// conductance * h^2, whose currents have no sources.
///
/// Vertices are eliminated one after the other. The links of a vertex become links between its
/// neighbours (from star to mesh), whose drops are those of the way over the vertex; two links side
/// by side become one, with the mean of their drops, and what they differ by is left over for good.
/// So the least sum is one of positive numbers, one for every two links that were joined, and going
/// back finds the drop of every link from differences alone. Conductances may differ by any factor:
/// links that conduct well and have no drop keep their small ones to the last digit. Of all
/// vertices left one with the fewest neighbours goes first (minimum degree, counted as often as
/// stars they are in overlap); the order and the places of the couplings are found once for all
/// parts, as a part couples no vertices that the whole does not.
/// Source: nothing is ever subtracted from a conductance, Grassmann, Taksar & Heyman, Operations
/// Research 33 (1985). Order: Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl. 17 (1996).
class Elimination {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  void plan(std::uint32_t vertex_count, std::span<const Link> links);

  /// Eliminates the part below a vertex.
  /// @param conductances  > 0, of the links of that part, which come first among all links
  void eliminate(std::uint32_t vertex_count, std::span<const double> conductances);

  /// How often two links were joined in the last part, and the conductance of each time: of two in
  /// series.
  std::size_t join_count() const noexcept { return join_count_; }
  double weight(std::size_t join) const noexcept { return joins_[join].weight; }

  /// What is left of drops in the last part.
  /// @param drops        by link of the part, from a to b; becomes what is left
  /// @param differences  by join: of the drops of the two links. The sum of weight * product of two
  ///                     lists of differences is that of conductance * product of what is left.
  void relax(std::span<double> drops, std::span<double> differences);

  /// How likely a random spanning forest of the last part leaves each link out, when forests are as
  /// likely as the products of their conductances: 0 of a bridge, and the sum is the number of
  /// independent cycles. Each is found to its last digits, however small it is: going back from
  /// mesh to star, what a star leaves out is a sum of what its mesh does.
  /// Source: Kirchhoff, Annalen der Physik 148 (1847); Burton & Pemantle, Annals of Probability 21
  /// (1993).
  /// @param values   by link: every conductance grows at the rate conductance * value
  /// @param chances  by link of the part
  /// @param rates    by link of the part: of the chances
  void leave_out(std::span<const double> values, std::span<double> chances,
                 std::span<double> rates);

  /// Memory and time of a part grow with it; a little more than linear in the links of a surface.
  std::size_t coupling_count() const noexcept { return columns_.size(); }

 private:
  void order_vertices(std::uint32_t vertex_count);
  void queue(std::uint32_t vertex, std::size_t degree);
  void add_row(std::uint32_t vertex);
  void place_links(std::span<const Link> links);

  /// The vertices that one may be coupled to when it is eliminated.
  struct Row {
    std::uint32_t vertex;
    std::uint32_t first;  ///< in columns_
    std::uint32_t count;
  };
  std::size_t update_degrees(const Row& last);
  /// Of a link: in columns_, and 1 if it goes from the row to the column, -1 if back.
  struct Place {
    std::uint32_t at;
    double sign;
  };
  struct Coupling {
    std::uint32_t at;  ///< in columns_
    double share;      ///< of the conductance of the vertex
  };
  /// A vertex of the part, its couplings, and the first of the joins of two of them each.
  struct Eliminated {
    std::uint32_t first;
    std::uint32_t end;
    std::size_t first_join;
  };
  /// A link that comes beside what is at its place.
  struct Join {
    std::uint32_t at;  ///< in columns_
    double old_share;  ///< of the conductance of both, 0 where there was none
    double new_share;
    double weight;
  };
  void join(std::uint32_t at, double conductance);
  void make_mesh(std::span<const Coupling> star, double pivot);
  void put(const Join& join, double drop, double& difference) noexcept;
  double take(const Join& join, double difference) noexcept;
  void find_star(const Eliminated& row, std::span<const double> differences) noexcept;
  /// A number with its rate.
  struct Rated {
    double value = 0.0;
    double rate = 0.0;
    friend Rated operator+(const Rated& a, const Rated& b) noexcept {
      return {a.value + b.value, a.rate + b.rate};
    }
    friend Rated operator*(const Rated& a, const Rated& b) noexcept {
      return {a.value * b.value, a.rate * b.value + a.value * b.rate};
    }
  };
  /// How likely a link is in the forest, and how likely it is not.
  struct Chance {
    Rated in, out;
  };
  void rate_places(std::span<const double> values);
  Chance take_out(const Join& join, double difference) noexcept;
  void rate_star(std::span<const Coupling> star);
  void find_star_chances(const Eliminated& row);

  std::vector<Row> rows_;               ///< in the order of elimination
  std::vector<std::uint32_t> row_of_;   ///< by vertex
  std::vector<std::uint32_t> columns_;  ///< rows; ascending in each row
  std::vector<Place> places_;           ///< by link
  std::vector<double> room_;            ///< by place in columns_: conductances, then drops
  std::vector<Eliminated> eliminated_;  ///< in order
  std::vector<Coupling> couplings_;
  std::vector<Join> joins_;  ///< of the links, then of the meshes; room for all of the whole
  std::size_t join_count_ = 0;
  // Of leave_out().
  std::vector<double> rates_;        ///< by place in columns_: of the logarithm of conductances
  std::vector<double> differences_;  ///< by join: of those of the two links
  std::vector<Chance> chances_;      ///< by place in columns_
  std::vector<double> star_rates_;   ///< by coupling: as it was when its vertex was eliminated
  std::vector<Rated> star_, others_, with_, below_, across_;  ///< by link of a star
  // Working space of plan().
  /// What a star has beside a later one.
  struct Beside {
    std::uint32_t last;   ///< the later one
    std::uint32_t count;  ///< of vertices that it does not have
    bool is_gone;         ///< a later one has all
  };
  // A star is what its row couples, until a later one has all of it: vertices left are neighbours
  // by links or as they are in one star.
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< by vertex: by links that no star has
  std::vector<std::vector<std::uint32_t>> stars_;       ///< by vertex: rows
  std::vector<std::uint32_t> star_of_;                  ///< by vertex: the last one
  std::vector<Beside> beside_;                          ///< by row
  std::vector<std::size_t> degree_;                     ///< by vertex: of neighbours, at most
  std::vector<std::vector<std::uint32_t>> by_degree_;   ///< vertices, some no more
};

}  // namespace plekton::contact

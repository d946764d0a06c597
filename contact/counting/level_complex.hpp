// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/cycle_basis.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// What is nearer than a level, for all levels below a range, of anything that is made of convex
/// cells: the cells of a surface around a point (near_complex.hpp), the pairs of cells of two
/// surfaces (surface_surface/product_complex.hpp).
///
/// A cell and every side of it stand where they are nearest: cells that stand at the same place are
/// one vertex. A link joins the vertices of a cell and of a side of it, so it is there from the
/// level of its upper end on, the side's. A cell, a corner of it (a side of a side) and the two
/// sides between them are a cycle of up to four links, which the cell fills. So what is nearer than
/// s has the pieces and the holes of the vertices, links and fillings below s: these are the order
/// complex of the cells that reach below s, and a convex cell meets what is nearer than s in a
/// convex set (nerve theorem). A cell that reaches below s does so with all it is a side of, so all
/// that lies between two cells is there with them, and what hangs together over more than two
/// dimensions is filled by such cycles already.
/// Source: Björner, Topological Methods, Handbook of Combinatorics (1995), 10 and 12.
class LevelComplex {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  /// @param distances  m, by vertex, ascending
  /// @param vertices   by cell
  void start(std::span<const double> distances, std::span<const std::uint32_t> vertices);
  /// All of them, then sort_links().
  void add_link(std::uint32_t side, std::uint32_t cell);
  void sort_links();
  /// First index_links(), then all of them, then sort_fillings() or merge_links().
  void index_links();
  void add_filling(std::uint32_t corner, std::uint32_t first_side, std::uint32_t cell,
                   std::uint32_t last_side);
  void sort_fillings();
  /// Lets one link stand for all of two vertices that cycles of these fill, at their level.
  /// Currents that go round no filled cycle are the same in all of them, so nothing changes.
  void merge_links();

  /// m, by vertex, ascending.
  std::span<const double> distances() const noexcept { return distances_; }
  /// By upper vertex; without resistances.
  std::span<const Link> links() const noexcept { return links_; }
  /// By link: how many it stands for.
  std::span<const double> multiplicities() const noexcept { return multiplicities_; }
  /// By upper vertex.
  std::span<const Filling> fillings() const noexcept { return fillings_; }

 private:
  /// Which cells a link joins.
  struct LinkKey {
    std::uint32_t side;
    std::uint32_t cell;
    std::uint32_t upper;  ///< vertices
    std::uint32_t lower;
    int sign;  ///< 1: the side's vertex is the upper one
    std::uint32_t link;
    friend bool operator<(const LinkKey& a, const LinkKey& b) noexcept {
      return a.side != b.side ? a.side < b.side : a.cell < b.cell;
    }
  };
  Filling merged(const Filling& filling) const noexcept;
  bool unite_links() noexcept;
  void number_links();
  std::uint32_t root_of(std::uint32_t link) const noexcept {
    while (root_[link] != link) link = root_[link];
    return link;
  }
  void add_to(Filling& filling, std::uint32_t side, std::uint32_t cell, int sign) const;

  std::vector<double> distances_;
  std::vector<std::uint32_t> vertices_;  ///< by cell
  std::vector<Link> links_;              ///< by upper vertex
  std::vector<LinkKey> keys_;            ///< by cells
  std::vector<Filling> fillings_;
  std::vector<double> multiplicities_;  ///< by link
  std::vector<std::uint32_t> root_;     ///< by link: the lowest that it is merged with, or one on
                                        ///< the way
  std::vector<std::uint32_t> places_;   ///< by link: where it is after merging
};

}  // namespace plekton::contact

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/counting/level_complex.hpp"
#include "geometry/closest/core_pair.hpp"
#include "geometry/critical/product_features.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// Where two bodies are nearer than a level, for every level below a range: the pairs of points (x
/// of one, y of the other) with |x - y| < s, as a complex of product cells (level_complex.hpp).
///
/// A product cell is a pair of features, one of each body: of two cells, or of sides and corners of
/// these. It is convex, and so is what it has nearer than s. It stands at its nearest points, on
/// the features that hold them.
class ProductComplex {
 public:
  /// A pair of cells in range.
  struct CellPair {
    const geometry::FeatureNodes* a;
    const geometry::FeatureNodes* b;
    const geometry::CoreProximity* cores;
  };

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param pairs  each once; nearer than range
  void build(std::span<const CellPair> pairs, double range, geometry::Positions x);

  const LevelComplex& levels() const noexcept { return levels_; }

  /// Where a vertex is: nearest points of two features, that have these nodes among others.
  struct Place {
    geometry::FeatureNodes a;
    geometry::FeatureNodes b;
    geometry::CoreProximity cores;
  };
  const Place& place(std::uint32_t vertex) const noexcept {
    return places_[cells_[apexes_[vertex]].place];
  }

  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// The vertex that a pair of features stands at; kNone if it is not in range.
  std::uint32_t vertex_of(const geometry::FeatureNodes& a,
                          const geometry::FeatureNodes& b) const noexcept;

  /// The pairs of cells that have the features of a vertex, ascending; valid until the next call.
  std::span<const std::uint32_t> holders(std::uint32_t vertex);

 private:
  /// Nodes of both features: those of each ascending, and the lower feature first.
  using Key = std::array<std::array<NodeId, 3>, 2>;
  struct Cell {
    Key key;
    Key foot;  ///< the features that hold its nearest points
    std::uint32_t place;
    std::uint32_t pair;  ///< kNone, if it is of sides or corners
    double level;        ///< m, its distance; but for rounding no less than that of a cell it is a
                         ///< side of
  };
  /// A side of a cell, or a pair of cells.
  struct Candidate {
    Key key;
    std::uint32_t cell;  ///< kNone of a pair of cells
    std::uint32_t pair;
    friend bool operator<(const Candidate& p, const Candidate& q) noexcept {
      return p.key != q.key ? p.key < q.key : p.cell < q.cell;
    }
  };
  struct Face {
    std::uint32_t side;
    std::uint32_t cell;
    friend constexpr auto operator<=>(const Face&, const Face&) = default;
  };

  static Key key_of(std::span<const NodeId> a, std::span<const NodeId> b) noexcept;
  static bool holds(const Key& key, const Key& lower) noexcept;
  void take(std::span<const Candidate> same, std::span<const CellPair> pairs, double range,
            geometry::Positions x);
  void set_foot(Cell& cell) const noexcept;
  void add_sides(std::uint32_t cell, std::vector<Candidate>& to) const;
  std::uint32_t find(const Key& key) const noexcept;
  void number_vertices();
  void list_links();
  void list_fillings();

  LevelComplex levels_;
  std::vector<Cell> cells_;             ///< of highest dimension first; of one dimension by key
  std::array<std::uint32_t, 6> first_;  ///< cell, by dimension
  std::vector<Place> places_;
  std::vector<std::uint32_t> vertices_;  ///< by cell
  std::vector<std::uint32_t> apexes_;    ///< by vertex: the cell of its features
  std::vector<Face> by_side_, by_cell_;
  // Working space.
  std::array<std::vector<Candidate>, 5> candidates_;  ///< by dimension
  std::vector<double> distances_;
  std::vector<std::uint32_t> first_sides_;  ///< by cell, in by_cell_
  std::vector<Face> corners_;
  std::vector<std::uint32_t> above_, holders_;
};

}  // namespace plekton::contact::structure

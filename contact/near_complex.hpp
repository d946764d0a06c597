// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "contact/ring_basis.hpp"
#include "geometry/critical_features.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

using geometry::Feature;

/// The part of a surface nearer than a range to a point, as nodes, links and filled rings that hang
/// together as it does, at any level (distance) below the range.
///
/// Every cell of the surface and every side of it stands where it is nearest to the point: at the
/// foot point on the feature that holds it. Cells that share it are one vertex. A link joins the
/// vertices of a cell and of a side of it (of an edge and an end, of a facet and a side), so it is
/// there from the level of its upper end on, the side's. A node of a facet, the two sides and the
/// facet around it are a ring of up to four links, which the facet fills. So the part of the
/// surface nearer than s has the pieces and the holes of the vertices, links and fillings below s:
/// these are the order complex of the cells that reach below s, and a convex cell meets a ball in a
/// convex set (nerve theorem).
class NearComplex {
 public:
  /// A feature that holds its own nearest point.
  struct Vertex {
    geometry::CorePoint core;
    Vec3 normal;      ///< unit, from the point to the core point
    double distance;  ///< m
  };

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param cells  ascending; every cell nearer than range
  void build(const geometry::Surface& surface, const Vec3& point, double range,
             std::span<const geometry::CellId> cells, Positions x);

  /// Nearest first; of equals the lowest feature first.
  std::span<const Vertex> vertices() const noexcept { return vertices_; }

  /// By upper vertex; without resistances.
  std::span<const Link> links() const noexcept { return links_; }
  /// By upper vertex.
  std::span<const Filling> fillings() const noexcept { return fillings_; }

 private:
  struct Cell {
    Feature feature;
    Feature foot;  ///< the feature that holds its nearest point
    std::uint32_t vertex;
    friend bool operator<(const Cell& a, const Cell& b) noexcept { return a.feature < b.feature; }
  };

  void list_cells(const geometry::Surface& surface, std::span<const geometry::CellId> cells);
  void find_feet(const geometry::Surface& surface, const Vec3& point, double range, Positions x);
  void number_vertices();
  void list_links(const geometry::Surface& surface);
  void list_fillings(const geometry::Surface& surface);
  const Cell* cell_of(Feature feature) const noexcept;
  void add_link(const Cell* side, const Cell& cell);
  void add_to(Filling& filling, const Cell& side, const Cell& cell, int sign) const;

  /// Which cells a link joins.
  struct LinkKey {
    Feature side;
    Feature cell;
    std::uint32_t upper;  ///< vertices
    std::uint32_t lower;
    int sign;  ///< 1: the side's vertex is the upper one
    std::uint32_t link;
    friend bool operator<(const LinkKey& a, const LinkKey& b) noexcept {
      return a.side != b.side ? a.side < b.side : a.cell < b.cell;
    }
  };
  std::vector<Cell> cells_;  ///< by feature
  std::vector<Vertex> vertices_;
  std::vector<Link> links_;    ///< by upper vertex
  std::vector<LinkKey> keys_;  ///< by cells
  std::vector<Filling> fillings_;
  std::vector<std::uint32_t> order_, place_;  // of the sorting
  std::vector<Vertex> sorted_;
};

}  // namespace plekton::contact

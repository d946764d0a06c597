// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/counting/level_complex.hpp"
#include "geometry/critical/critical_features.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

using geometry::Feature;

/// The part of a surface nearer than a range to a point, as nodes, links and filled cycles that
/// hang together as it does, at any level (distance) below the range (level_complex.hpp). A cell
/// and every side of it stand at the foot point, on the feature that holds it.
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

  const LevelComplex& levels() const noexcept { return levels_; }

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
  void start_levels();
  void list_links(const geometry::Surface& surface);
  void list_fillings(const geometry::Surface& surface);
  const Cell* cell_of(Feature feature) const noexcept;
  std::uint32_t place_of(const Cell& cell) const noexcept {
    return static_cast<std::uint32_t>(&cell - cells_.data());
  }
  void add_link(const Cell* side, const Cell& cell);

  std::vector<Cell> cells_;  ///< by feature
  std::vector<Vertex> vertices_;
  LevelComplex levels_;
  std::vector<double> distances_;  // of its start
  std::vector<std::uint32_t> of_cells_;
  std::vector<std::uint32_t> order_, place_;  // of the sorting
  std::vector<Vertex> sorted_;
};

}  // namespace plekton::contact

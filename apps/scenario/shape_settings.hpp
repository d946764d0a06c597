// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/closed_tube.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/lattice.hpp"
#include "geometry/mesh/generate/polygon.hpp"

#include <algorithm>
#include <array>
#include <variant>
#include <vector>

namespace plekton::apps {

/// Tube for geometry::closed_tube.
struct TubeShape {
  geometry::Tube tube;
  std::array<bool, 2> is_closed{};  ///< at z_min and z_max
};

/// Sphere for geometry::icosphere.
struct SphereShape {
  double radius;  ///< m
  int subdivisions;
};

/// Box for geometry::box_shell, without some of its sides.
struct BoxShape {
  geometry::Vec3 size;         ///< m
  std::array<int, 3> cells;    ///< along each axis
  std::array<bool, 6> open{};  ///< sides that are left out: x_min, x_max, y_min, ... z_max
};

/// Facets between points, and bars that are no side of a facet.
struct FacetShape {
  geometry::Mesh mesh;
  std::vector<std::array<geometry::NodeId, 2>> bars;  ///< lower node first, ascending
};

/// What a membrane without a mesh file is made from. Of a mesh and a lattice every point is told.
using ShapeSettings =
    std::variant<geometry::PlaneSheet, geometry::Polygon, TubeShape, SphereShape, BoxShape,
                 geometry::BiaxialGeogrid, geometry::UniaxialGeogrid, geometry::HexagonalNet,
                 geometry::RingNet, geometry::Chain, FacetShape, geometry::Lattice>;

/// Whether a shape is of bars anywhere in space: it has ends for a rim, and no area.
inline bool is_chain(const ShapeSettings& shape) noexcept {
  return std::holds_alternative<geometry::Chain>(shape) ||
         std::holds_alternative<geometry::Lattice>(shape);
}

/// Whether a shape has bars only and no facets.
inline bool is_net(const ShapeSettings& shape) noexcept {
  return std::holds_alternative<geometry::BiaxialGeogrid>(shape) ||
         std::holds_alternative<geometry::UniaxialGeogrid>(shape) ||
         std::holds_alternative<geometry::HexagonalNet>(shape) ||
         std::holds_alternative<geometry::RingNet>(shape) || is_chain(shape);
}

/// Whether a shape of facets has bars beside them.
inline bool has_bars(const ShapeSettings& shape) noexcept {
  const auto* const facets = std::get_if<FacetShape>(&shape);
  return facets != nullptr && !facets->bars.empty();
}

/// Of a shape whose points are told, how many there are; otherwise 0.
inline std::size_t told_points(const ShapeSettings& shape) noexcept {
  if (const auto* const facets = std::get_if<FacetShape>(&shape)) return facets->mesh.points.size();
  const auto* const bars = std::get_if<geometry::Lattice>(&shape);
  return bars != nullptr ? bars->points.size() : 0;
}

/// Whether a shape has no rim.
inline bool is_closed(const ShapeSettings& shape) noexcept {
  const auto* const box = std::get_if<BoxShape>(&shape);
  const bool is_whole_box =
      box != nullptr && std::none_of(box->open.begin(), box->open.end(), [](bool o) { return o; });
  const auto* const tube = std::get_if<TubeShape>(&shape);
  const bool is_whole_tube = tube != nullptr && tube->is_closed[0] && tube->is_closed[1];
  return std::holds_alternative<SphereShape>(shape) || is_whole_box || is_whole_tube;
}

}  // namespace plekton::apps

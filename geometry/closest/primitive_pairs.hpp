// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/core_pair.hpp"
#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/proximity.hpp"

#include <concepts>
#include <tuple>

/// The pairs of primitives that can touch, and where they are nearest to each other.
///
///               sphere          cylinder          facet
///     sphere    two spheres     sphere and cell   sphere and cell
///     cylinder                  two cells         two cells
///     facet                                       two cells
///
/// A cylinder or a facet is asked as a cell of its Surface, so that the answer names the node, edge
/// or face that neighbouring cells share. Which features are nearest is decided exactly
/// (closest/closest_points.hpp), and corners are taken in the order of their node ids: two facets
/// agree bit for bit about a foot point on their common edge. A tie, as between parallel edges,
/// goes to the lowest-dimensional features, then to the lowest ids. A facet without area is the
/// union of its sides, a cylinder without length its node.
///
/// The relative error of the distance of the cores is at most 1e-12. Nothing is checked: ids must
/// be those of the surface, coordinates and radii finite and below 1e75 m, radii not negative.
namespace plekton::geometry {

/// Two spheres. Of coincident centres the normal is the z axis.
Proximity proximity(const Sphere& a, const Sphere& b, Positions x) noexcept;

/// A sphere (a) and a cell of a surface (b), rim and ends included. A centre on the core itself
/// gets a normal perpendicular to the feature, chosen by the feature alone.
Proximity proximity(const Sphere& a, const Surface& surface, CellId cell, Positions x) noexcept;

/// Two cells of one surface, of the same structure or of two. Cells that share a node touch there.
Proximity proximity(const Surface& surface, CellId a, CellId b, Positions x) noexcept;

/// A surface and the positions of its nodes (m), for queries between scenes.
struct PlacedSurface {
  const Surface& surface;
  Positions x;
};

/// A cell each of two surfaces, which may be the same one.
Proximity proximity(const PlacedSurface& on_a, CellId a, const PlacedSurface& on_b,
                    CellId b) noexcept;

/// A primitive that belongs to no surface: a point, ball, cylinder or facet to ask others with.
struct Probe {
  Core core;      ///< m; with one to three corners
  double radius;  ///< m, >= 0

  static Probe point(const Vec3& x) { return ball(x, 0.0); }
  static Probe ball(const Vec3& centre, double radius) {
    return {{{centre, centre, centre}, 1}, radius};
  }
  static Probe cylinder(const Vec3& x0, const Vec3& x1, double radius) {
    return {{{x0, x1, x1}, 2}, radius};
  }
  static Probe facet(const std::array<Vec3, 3>& x, double radius) { return {{x, 3}, radius}; }
};

/// A probe (a) and a cell (b). The core point of the probe names its corners as nodes 0, 1, 2; its
/// sides are edges 0, 1, 2 between corners 0 1, 1 2 and 2 0; its face is 0.
Proximity proximity(const Probe& a, const PlacedSurface& on_b, CellId b) noexcept;

/// Two probes; the core points name their corners, sides and face as above. Of coincident points
/// the normal is the z axis.
Proximity proximity(const Probe& a, const Probe& b) noexcept;

/// A swept simplex: an array of one to three corners that core() makes of it and of the positions
/// of nodes (m), and a radius (m). A new one needs no more than these, and box() for the broad
/// phase.
template <class Type>
concept Primitive = requires(const Type& primitive, Positions x) {
  { primitive.radius } -> std::convertible_to<double>;
  requires std::tuple_size_v<decltype(core(primitive, x))>
  <= 3;
};

/// A primitive as it stands now. Takes it through every pair of the table.
template <Primitive Type>
Probe probe_of(const Type& primitive, Positions x) {
  Probe probe{{}, primitive.radius};
  for (const Vec3& corner : core(primitive, x)) probe.core.x[probe.core.count++] = corner;
  return probe;
}

}  // namespace plekton::geometry

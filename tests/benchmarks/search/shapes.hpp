// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace plekton::benchmarks {

/// A surface of triangles, as every code of the comparison takes it.
struct Shape {
  std::vector<geometry::Vec3> points;  ///< m
  std::vector<std::array<std::int32_t, 3>> facets;
};

/// A closed ring of radius 1 m and thickness 0.6 m with ripples of 2 cm, of about as many facets.
Shape rippled_ring(int facets);

/// A sheet over the unit square (m) of about as many facets.
/// @param height  m, of its waves
Shape sheet(int facets, double height);

/// Turned about an oblique axis, then moved (m): nothing of a shape is along the world's axes.
Shape placed(Shape shape, double angle, const geometry::Vec3& way);

}  // namespace plekton::benchmarks

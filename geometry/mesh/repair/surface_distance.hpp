// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace plekton::geometry {

/// How far two surfaces are from each other: the Hausdorff distance lies between both values.
struct SurfaceDistance {
  double sampled = 0.0;  ///< m, the largest distance of a sample from the other surface
  double bound = 0.0;    ///< m, no point of either surface is farther from the other
};

/// Samples both surfaces on a regular grid of each facet and measures the distance of every sample
/// from the other surface (CGAL's AABB tree), about 2e5 samples a surface or its corners if these
/// are more. No point of a facet is farther from a sample than 1 / sqrt(3) of the longest side of a
/// grid triangle, and the distance from a surface changes by no more than the point moves; that
/// makes the bound. Both must have facets.
SurfaceDistance surface_distance(const Mesh& a, const Mesh& b);

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/resolution.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

namespace plekton::geometry {

void require_resolved(const Mesh& mesh, double length, std::string_view what) {
  constexpr double kLargest = 1e30;  // m; of its inverse six factors are a number too
  constexpr double kRoundings = 256.0;
  if (mesh.points.empty()) return;
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& p : mesh.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double size = (upper - lower).maxCoeff();
  std::ostringstream text;
  if (!(size > 1.0 / kLargest && size < kLargest)) {
    text << what << ": the mesh is " << size << " m large; expected 1e-30 m to 1e30 m; scale it";
    throw MeshError(text.str());
  }
  const double furthest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
  const double rounding = std::numeric_limits<double>::epsilon() * furthest;
  if (!(length > 0.0 && length < kRoundings * rounding)) return;
  text << what << ": coordinates of " << furthest << " m are rounded to " << rounding
       << " m; bring the mesh nearer to the origin, or take a longer length";
  throw MeshError(text.str());
}

}  // namespace plekton::geometry

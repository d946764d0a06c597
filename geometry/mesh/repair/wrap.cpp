// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/wrap.hpp"

#include "geometry/mesh/repair/cgal_mesh.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/resolution.hpp"

#include <CGAL/alpha_wrap_3.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace plekton::geometry {
namespace {

constexpr double kOffsetRatio =
    30.0;  // Recommended by CGAL's manual for meshes: alpha over offset.
constexpr double kFinestRatio = 2000.0;
constexpr double kCoarseRatio = 30.0;  // A wrap of this part of the size takes about a second.
constexpr double kMostWrapFacets = 1e6;

double size_of(const Mesh& mesh) {
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& p : mesh.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return (upper - lower).norm();
}

void require_wrappable(double size, double finest) {
  const double least = size / kFinestRatio;
  if (finest >= least && finest > 0.0 && std::isfinite(finest)) return;
  std::ostringstream text;
  text << "a wrap of " << finest << " m; expected a length of at least " << least
       << " m, 1/2000 of the size of the mesh";
  throw MeshError(text.str());
}

SurfaceMesh wrapped(const Mesh& mesh, double finest) {
  const CgalSoup soup = to_cgal(mesh);
  SurfaceMesh surface;
  CGAL::alpha_wrap_3(soup.points, soup.triangles, finest, finest / kOffsetRatio, surface);
  return surface;
}

/// The facets of a wrap are 2 to 8 to the square of its detail, as the body is thick or thin, on
/// that part of the area which is outside. So a coarse wrap tells how many a fine one will have.
void require_few_facets(const Mesh& mesh, double size, double finest) {
  constexpr double kMostOfSquare = 16.0;  // on both sides of a sheet
  const double coarse = size / kCoarseRatio;
  if (finest >= coarse ||
      kMostOfSquare * measure(mesh, false).area <= kMostWrapFacets * finest * finest)
    return;
  const auto coarse_facets = static_cast<double>(wrapped(mesh, coarse).number_of_faces());
  const double facets = coarse_facets * (coarse / finest) * (coarse / finest);
  if (facets <= kMostWrapFacets) return;
  std::ostringstream text;
  text << "a wrap of " << finest << " m would make about " << facets << " facets; expected at most "
       << kMostWrapFacets << "; use a length of at least " << std::setprecision(3)
       << 1.005 * coarse * std::sqrt(coarse_facets / kMostWrapFacets) << " m";  // rounded up
  throw MeshError(text.str());
}

}  // namespace

Mesh wrap(const Mesh& mesh, double finest) {
  const double size = size_of(mesh);
  std::ostringstream what;
  what << "a wrap of " << finest << " m";
  require_resolved(mesh, finest / kOffsetRatio, what.str());
  require_wrappable(size, finest);
  require_few_facets(mesh, size, finest);
  return to_mesh(wrapped(mesh, finest));
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/surface_distance.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace plekton::geometry {
namespace {

using Doubles = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Doubles::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Doubles, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Doubles, Primitive>>;

constexpr double kSamples = 2e5;

std::array<Vec3, 3> corners_of(const Mesh& mesh, const std::array<NodeId, 3>& facet) {
  return {mesh.points[index_of(facet[0])], mesh.points[index_of(facet[1])],
          mesh.points[index_of(facet[2])]};
}

Triangles triangles_of(const Mesh& mesh) {
  const auto point = [](const Vec3& p) { return Doubles::Point_3(p[0], p[1], p[2]); };
  Triangles triangles;
  triangles.reserve(mesh.facets.size());
  for (const auto& facet : mesh.facets) {
    const auto x = corners_of(mesh, facet);
    triangles.emplace_back(point(x[0]), point(x[1]), point(x[2]));
  }
  return triangles;
}

double longest_side(const std::array<Vec3, 3>& x) {
  return std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
}

/// Spacing at which the grids of all facets together have about kSamples points; a grid of spacing
/// h on a facet with longest side L has about (L / h)^2 / 2.
double spacing_of(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& facet : mesh.facets) {
    const double side = longest_side(corners_of(mesh, facet));
    sum += 0.5 * side * side;
  }
  // Sides below 1e-160 m have no square.
  return std::max(std::sqrt(sum / kSamples), std::numeric_limits<double>::min());
}

double distance_from(const Tree& tree, const Vec3& p) {
  const Doubles::Point_3 point(p[0], p[1], p[2]);
  return std::sqrt(CGAL::squared_distance(point, tree.closest_point(point)));
}

/// From every point of one surface to the other.
SurfaceDistance one_way(const Mesh& from, const Mesh& to) {
  const Triangles triangles = triangles_of(to);
  const Tree tree(triangles.begin(), triangles.end());
  const double spacing = spacing_of(from);
  SurfaceDistance distance;
  for (const auto& facet : from.facets) {
    const auto x = corners_of(from, facet);
    const double side = longest_side(x);
    const int n = static_cast<int>(std::clamp(std::ceil(side / spacing), 1.0, 1000.0));
    double farthest = 0.0;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = x[0] + (static_cast<double>(i) / n) * (x[1] - x[0]) +
                       (static_cast<double>(j) / n) * (x[2] - x[0]);
        farthest = std::max(farthest, distance_from(tree, p));
      }
    }
    distance.sampled = std::max(distance.sampled, farthest);
    distance.bound = std::max(distance.bound, farthest + side / n * std::numbers::inv_sqrt3);
  }
  return distance;
}

}  // namespace

SurfaceDistance surface_distance(const Mesh& a, const Mesh& b) {
  const SurfaceDistance there = one_way(a, b), back = one_way(b, a);
  return {std::max(there.sampled, back.sampled), std::max(there.bound, back.bound)};
}

}  // namespace plekton::geometry

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/polygon.hpp"

#include "geometry/mesh/repair/triangulate_polygon.hpp"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>

namespace plekton::geometry {
namespace {

/// Of the distance between points: what is narrower is a line.
constexpr double kLine = 1e-9;
/// Of the distance between points: points of a tilted plane are written with four digits.
constexpr double kPlane = 1e-4;

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  text << "a polygon ";
  (text << ... << parts);
  throw MeshError(text.str());
}

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << '(' << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  return text.str();
}

void require_corners(const std::vector<Vec3>& points) {
  const std::size_t n = points.size();
  if (n < 3 || n > kLargestPolygon)
    refuse("of ", n, " points; expected from 3 to ", kLargestPolygon, " of them");
  for (std::size_t i = 0; i < n; ++i) {
    if (!points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < kLargestCoordinate))
      refuse("with point ", i, " at ", place(points[i]), "; expected finite places within ",
             kLargestCoordinate, " m of the origin");
    if (points[i] != points[(i + 1) % n]) continue;
    if (i + 1 == n)
      refuse(
          "whose last point is the first one again; leave it out, the last one is joined to the "
          "first");
    refuse("whose points ", i, " and ", i + 1, " are both at ", place(points[i]),
           "; leave one out");
  }
}

/// Index of the point at which something is largest, and how large.
template <class Measure>
std::pair<std::size_t, double> largest(const std::vector<Vec3>& points, Measure&& measure) {
  std::pair<std::size_t, double> best{0, -1.0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = measure(points[i]);
    if (value > best.second) best = {i, value};
  }
  return best;
}

void require_plane(const std::vector<Vec3>& points) {
  const Vec3& origin = points.front();
  const auto [far, size] = largest(points, [&](const Vec3& x) { return (x - origin).norm(); });
  const Vec3 along = (points[far] - origin) / size;
  const auto across = [&](const Vec3& x) -> Vec3 { return along.cross(x - origin); };
  const auto [beside, width] = largest(points, [&](const Vec3& x) { return across(x).norm(); });
  if (!(width > kLine * size))
    refuse(
        "whose points are all on one line, so that it has no area; expected corners of a part "
        "of a plane");
  const Vec3 normal = across(points[beside]) / width;
  const auto [off, height] =
      largest(points, [&](const Vec3& x) { return std::abs(normal.dot(x - origin)); });
  if (height > kPlane * size)
    refuse("whose point ", off, " is ", height, " m out of the plane of points 0, ", far, " and ",
           beside, "; expected at most ", kPlane, " of its size, ", kPlane * size,
           " m; give points of one plane, or facets");
}

}  // namespace

Mesh polygon(const Polygon& polygon) {
  require_corners(polygon.points);
  require_plane(polygon.points);
  const auto triangles = triangulate_polygon(polygon.points);
  if (!triangles)
    refuse(
        "whose sides touch or cross; give its corners in their order around it, and a polygon "
        "each for what hangs together in a point alone");
  Mesh mesh{polygon.points, {}};
  for (const auto& [a, b, c] : *triangles)
    mesh.facets.push_back({id_at<NodeId>(a), id_at<NodeId>(b), id_at<NodeId>(c)});
  return mesh;
}

}  // namespace plekton::geometry

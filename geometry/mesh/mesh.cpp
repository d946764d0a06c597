// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh.hpp"

#include "geometry/base/printable.hpp"

#include <sstream>

namespace plekton::geometry {

MeshError::MeshError(const std::string& text) : std::runtime_error(printable(text)) {}

void require_corners(const Mesh& mesh) {
  constexpr std::size_t kMostListed = 8;
  std::ostringstream problems;
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    for (const NodeId node : mesh.facets[f]) {
      if (index_of(node) < mesh.points.size() || ++count > kMostListed) continue;
      problems << (count > 1 ? "\n  " : "") << "facet " << f << " names point "
               << static_cast<std::int32_t>(node) << ", but there are " << mesh.points.size()
               << " points, counted from 0";
    }
  }
  if (count == 0) return;
  if (count > kMostListed)
    problems << "\n  and " << count - kMostListed << " more corners like these";
  problems << "; add the points, or leave out the facets";
  throw MeshError(problems.str());
}

PolygonSoup to_soup(const Mesh& mesh) {
  PolygonSoup soup{mesh.points, {}, 0};
  soup.polygons.reserve(mesh.facets.size());
  for (const auto& [a, b, c] : mesh.facets)
    soup.polygons.push_back({index_of(a), index_of(b), index_of(c)});
  return soup;
}

}  // namespace plekton::geometry

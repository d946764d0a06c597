// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh.hpp"

#include "geometry/base/printable.hpp"

namespace plekton::geometry {

MeshError::MeshError(const std::string& text) : std::runtime_error(printable(text)) {}

PolygonSoup to_soup(const Mesh& mesh) {
  PolygonSoup soup{mesh.points, {}, 0};
  soup.polygons.reserve(mesh.facets.size());
  for (const auto& [a, b, c] : mesh.facets)
    soup.polygons.push_back({index_of(a), index_of(b), index_of(c)});
  return soup;
}

}  // namespace plekton::geometry

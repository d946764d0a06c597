// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generator_checks.hpp"
#include "geometry/mesh/generate/lattice.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace plekton::geometry {
namespace {

/// @throws MeshError
void require_way(const std::vector<Vec3>& points) {
  if (points.size() < 2)
    throw MeshError("a chain through " + std::to_string(points.size()) +
                    " points; expected at least 2");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || !(points[i].cwiseAbs().maxCoeff() < kLargestCoordinate))
      throw MeshError("point " + std::to_string(i) + " of a chain is not finite, or too far away");
    if (i > 0 && points[i] == points[i - 1])
      throw MeshError("points " + std::to_string(i - 1) + " and " + std::to_string(i) +
                      " of a chain are equal; leave one of them out");
  }
}

}  // namespace

Lattice chain(const Chain& chain) {
  require_way(chain.points);
  require_at_least(1, chain.divisions, "links between two points of a chain");
  const std::size_t parts = chain.points.size() - 1;
  const auto divisions = static_cast<std::size_t>(chain.divisions);
  require_numbers_for(static_cast<double>(parts) * static_cast<double>(divisions) + 1.0, "a chain");
  const bool is_closed = chain.points.front() == chain.points.back();
  if (is_closed && parts * divisions < 3)
    throw MeshError("a closed chain has " + std::to_string(parts * divisions) +
                    " links; expected at least 3");
  Lattice lattice;
  for (std::size_t i = 0; i < parts; ++i) {
    const Vec3 way = chain.points[i + 1] - chain.points[i];
    for (std::size_t k = 0; k < divisions; ++k)
      lattice.points.emplace_back(chain.points[i] +
                                  (static_cast<double>(k) / static_cast<double>(divisions)) * way);
  }
  if (!is_closed) lattice.points.push_back(chain.points.back());
  for (std::size_t i = 0; i + 1 < lattice.points.size(); ++i) {
    lattice.edges.push_back({{id_at<NodeId>(i), id_at<NodeId>(i + 1)}, LatticePart::link});
    if (i == 0 && is_closed)
      lattice.edges.push_back(
          {{NodeId{0}, id_at<NodeId>(lattice.points.size() - 1)}, LatticePart::link});
  }
  return lattice;
}

}  // namespace plekton::geometry

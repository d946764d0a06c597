// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/facet_traction.hpp"

namespace plekton::dynamics {

using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

namespace {

/// m², along the normal.
Vec3 area_vector(const geometry::Facet& facet, geometry::Positions x) {
  const Vec3& corner = x[index_of(facet.nodes[0])];
  return 0.5 * (x[index_of(facet.nodes[1])] - corner).cross(x[index_of(facet.nodes[2])] - corner);
}

}  // namespace

std::vector<FacetTraction> facet_tractions(std::span<const geometry::Facet> facets,
                                           std::span<const Vec3> forces, geometry::Positions x) {
  std::vector<double> areas(x.size(), 0.0);  // m², around each node
  for (const geometry::Facet& facet : facets) {
    const double area = area_vector(facet, x).norm();
    for (const NodeId node : facet.nodes) areas[index_of(node)] += area;
  }
  std::vector<FacetTraction> tractions;
  tractions.reserve(facets.size());
  for (const geometry::Facet& facet : facets) {
    Vec3 traction = Vec3::Zero();
    for (const NodeId node : facet.nodes) {
      const std::size_t i = index_of(node);
      if (areas[i] > 0.0) traction += forces[i] / areas[i];
    }
    const Vec3 normal = area_vector(facet, x).stableNormalized();  // zero of a facet without area
    const double outward = traction.dot(normal);
    tractions.push_back({-outward, traction - outward * normal});
  }
  return tractions;
}

}  // namespace plekton::dynamics

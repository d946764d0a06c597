// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/lumped_mass.hpp"

#include <numbers>

namespace plekton::dynamics {
namespace {

/// @param length_squared  m², of the bar of which a half belongs to the node
void add_lump(NodeProperties& properties, NodeId node, double mass, double radius_squared,
              double length_squared, NodalInertia inertia) noexcept {
  properties.mass[index_of(node)] += mass;
  properties.inertia[index_of(node)] +=
      inertia == NodalInertia::ball ? 0.4 * mass * radius_squared
                                    : mass * (0.25 * radius_squared + length_squared / 12.0);
}

}  // namespace

void add_beam_mass(NodeProperties& properties, const BeamBond& beam, double density,
                   NodalInertia inertia) noexcept {
  const double area = beam.section.area;
  const double mass = 0.5 * density * area * beam.length;
  for (const NodeId node : beam.nodes)
    add_lump(properties, node, mass, area / std::numbers::pi, beam.length * beam.length, inertia);
}

void add_edge_mass(NodeProperties& properties, const std::array<NodeId, 2>& nodes,
                   geometry::Positions positions, double radius, double density,
                   NodalInertia inertia) noexcept {
  const double length = (positions[index_of(nodes[1])] - positions[index_of(nodes[0])]).norm();
  const double mass = 0.5 * density * std::numbers::pi * radius * radius * length;
  for (const NodeId node : nodes)
    add_lump(properties, node, mass, radius * radius, length * length, inertia);
}

void add_facet_mass(NodeProperties& properties, const geometry::Facet& facet,
                    geometry::Positions positions, double density, NodalInertia inertia) noexcept {
  const double mass = density * geometry::volume(facet, positions) / 3.0;
  for (std::size_t i = 0; i < facet.nodes.size(); ++i) {
    const Vec3& corner = positions[index_of(facet.nodes[i])];
    double squares = 0.0;  // m², of both sides
    for (const std::size_t other : {(i + 1) % 3, (i + 2) % 3})
      squares += (positions[index_of(facet.nodes[other])] - corner).squaredNorm();
    add_lump(properties, facet.nodes[i], mass, facet.radius * facet.radius, 0.5 * squares, inertia);
  }
}

}  // namespace plekton::dynamics

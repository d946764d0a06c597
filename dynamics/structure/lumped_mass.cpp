// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/lumped_mass.hpp"

#include <numbers>

namespace plekton::dynamics {
namespace {

void add_ball(NodeProperties& properties, NodeId node, double mass,
              double radius_squared) noexcept {
  properties.mass[index_of(node)] += mass;
  properties.inertia[index_of(node)] += 0.4 * mass * radius_squared;
}

}  // namespace

void add_beam_mass(NodeProperties& properties, const BeamBond& beam, double density) noexcept {
  const double area = beam.section.area;
  const double mass = 0.5 * density * area * beam.length;
  for (const NodeId node : beam.nodes) add_ball(properties, node, mass, area / std::numbers::pi);
}

void add_edge_mass(NodeProperties& properties, const std::array<NodeId, 2>& nodes,
                   geometry::Positions positions, double radius, double density) noexcept {
  const double length = (positions[index_of(nodes[1])] - positions[index_of(nodes[0])]).norm();
  const double mass = 0.5 * density * std::numbers::pi * radius * radius * length;
  for (const NodeId node : nodes) add_ball(properties, node, mass, radius * radius);
}

void add_facet_mass(NodeProperties& properties, const geometry::Facet& facet,
                    geometry::Positions positions, double density) noexcept {
  const double mass = density * geometry::volume(facet, positions) / 3.0;
  for (const NodeId node : facet.nodes) {
    add_ball(properties, node, mass, facet.radius * facet.radius);
  }
}

}  // namespace plekton::dynamics

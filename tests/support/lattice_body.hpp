// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <cstddef>

namespace plekton::test {

/// A surface to touch: a mesh, made of facets with a beam along every side.
struct LatticeMaterial {
  double radius;  ///< m, of facets and beams
  dynamics::BeamSection section;
  double density;  ///< kg/m³
  contact::MaterialId contact{0};
};

/// Adds a mesh to a scene, its facets and beams, its mass along the sides of the facets.
/// @param held_at  what of a node is held, by its place
/// @returns  the node of the first point; the others follow
template <class HeldAt>
std::size_t add_lattice(dynamics::Scene& scene, const geometry::Mesh& mesh,
                        const geometry::Vec3& shift, const LatticeMaterial& material,
                        HeldAt held_at) {
  const std::size_t first = scene.state.size();
  for (const geometry::Vec3& x : mesh.points) scene.add_node(x + shift, held_at(x));
  const auto membrane =
      geometry::make_membrane(mesh, {.thickness = 2.0 * material.radius, .first_node = first});
  for (const auto& facet : membrane.facets)
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], material.radius,
                    material.contact);
  for (const auto& [a, b] : membrane.edges)
    scene.add_beam(a, b, material.section, material.density);
  return first;
}

/// Centre of mass and its velocity, of nodes that follow each other.
struct CentreOfMass {
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< m
  geometry::Vec3 velocity = geometry::Vec3::Zero();  ///< m/s
};

template <class AnySimulation>
CentreOfMass centre_of_mass(const AnySimulation& simulation, std::size_t first, std::size_t count) {
  CentreOfMass sum;
  double mass = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    const double m = simulation.properties().mass[i];
    mass += m;
    sum.position += m * simulation.state().position[i];
    sum.velocity += m * simulation.state().velocity[i];
  }
  return {sum.position / mass, sum.velocity / mass};
}

}  // namespace plekton::test

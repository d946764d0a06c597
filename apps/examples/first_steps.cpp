// SPDX-License-Identifier: GPL-3.0-or-later
// A ball falls on a sheet of geotextile that is held at its rim.
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generators.hpp"
#include "geometry/mesh/membrane.hpp"

#include <iostream>

int main() {
  using namespace plekton;
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = 5e6, .stiffness_ratio = 0.3, .friction = 0.5}};
  const contact::MaterialId material{0};

  const auto mesh = geometry::plane_sheet({.width = 0.4, .length = 0.4, .cells_x = 8, .cells_y = 8});
  const auto sheet = geometry::make_membrane(mesh, {.thickness = 0.004});
  for (const auto& x : sheet.nodes) {
    const bool on_rim = x.cwiseAbs().maxCoeff() > 0.199;
    scene.add_node(x, on_rim ? dynamics::Held::everything : dynamics::Held::nothing);
  }
  for (const auto& f : sheet.facets) scene.add_facet(f.nodes[0], f.nodes[1], f.nodes[2], f.radius, material);
  const auto fibre = dynamics::circular_section(0.002, 1e7, 0.3);  // radius (m), Young's modulus (Pa), Poisson's ratio
  for (const auto& [a, b] : sheet.edges) scene.add_beam(a, b, fibre, 300.0);
  scene.add_sphere({0.01, 0.02, 0.06}, 0.03, 2650.0, material);  // centre (m), radius (m), density (kg/m³)

  dynamics::Simulation<contact::LinearFrictional> simulation(scene, {.motion = {.gravity = {0.0, 0.0, -9.81}}});
  const auto ball = index_of(simulation.elements().spheres[0].nodes[0]);
  for (double next = 0.0; next <= 0.3; next += 0.03) {
    while (simulation.time() < next) simulation.step();
    std::cout << simulation.time() << " s: height " << simulation.state().position[ball].z() << " m\n";
  }
}

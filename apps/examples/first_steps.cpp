// SPDX-License-Identifier: GPL-3.0-or-later
// A ball falls on a sheet of geotextile that is held at its rim. SI units throughout.
#include <plekton/dynamics/simulation.hpp>
#include <plekton/geometry/mesh/generate/generators.hpp>
#include <plekton/geometry/mesh/generate/membrane.hpp>

#include <iostream>

int main() {
  using namespace plekton;
  using dynamics::Held;
  const contact::MaterialId cloth{0};
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = 5e6, .stiffness_ratio = 0.3, .friction = 0.5}};
  const auto mesh = geometry::plane_sheet({0.4, 0.4, 8, 8});  // width, length, cells
  const auto sheet = geometry::make_membrane(mesh, {.thickness = 0.004});
  for (const auto& x : sheet.nodes)
    scene.add_node(x, x.cwiseAbs().maxCoeff() > 0.199 ? Held::everything : Held::nothing);
  for (const auto& [n, r] : sheet.facets) scene.add_facet(n[0], n[1], n[2], r, cloth);
  const auto fibre = dynamics::circular_section(0.002, 1e7, 0.3);  // radius, E, Poisson's ratio
  for (const auto& [a, b] : sheet.edges) scene.add_beam(a, b, fibre, 300.0);  // density
  scene.add_sphere({0.01, 0.02, 0.06}, 0.03, 2650.0, cloth);  // centre, radius, density

  dynamics::Simulation run(scene, {.motion = {.gravity = {0, 0, -9.81}}});
  const auto ball = index_of(run.elements().spheres[0].nodes[0]);
  for (int i = 0; i <= 10; ++i) {
    while (run.time() < 0.03 * i) run.step();
    std::cout << run.time() << " s: height " << run.state().position[ball].z() << " m\n";
  }
}

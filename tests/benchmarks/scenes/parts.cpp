// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/parts.hpp"

#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/neighbor/space_order.hpp"

namespace plekton::benchmarks {

BenchmarkScene empty_scene(double damping) {
  BenchmarkScene result{};
  result.scene.materials = {{kYoungModulus, kStiffnessRatio, kFriction},
                            {kBeamYoungModulus, kBeamPoissonRatio, kFriction}};
  result.options.time_step = kTimeStep;
  result.options.motion = {kGravity, damping, true};
  return result;
}

void add_spheres(const Bed& bed, dynamics::Scene& scene) {
  std::vector<Vec3> centres;
  for (const Bed::Grain& grain : bed.grains) centres.push_back(grain.position);
  for (const std::int32_t i : geometry::order_along_curve(centres)) {
    const Bed::Grain& grain = bed.grains[static_cast<std::size_t>(i)];
    const auto sphere =
        scene.add_sphere(grain.position, grain.radius, kSphereDensity, kCommonMaterial);
    const std::size_t node = index_of(scene.elements.spheres[index_of(sphere)].nodes[0]);
    scene.state.velocity[node] = grain.velocity;
    scene.state.angular_velocity[node] = grain.angular_velocity;
  }
}

void add_walls(const Walls& walls, dynamics::Scene& scene) {
  const Vec3 near = Vec3::Zero();
  const Vec3 far(walls.length, walls.width, 0.0);
  const Vec3 still = Vec3::Zero();
  scene.planes.push_back({near, Vec3::UnitX(), still, walls.material});
  scene.planes.push_back({far, -Vec3::UnitX(), still, walls.material});
  scene.planes.push_back({near, Vec3::UnitY(), still, walls.material});
  scene.planes.push_back({far, -Vec3::UnitY(), still, walls.material});
}

void add_floor(MaterialId material, dynamics::Scene& scene) {
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), material});
}

dynamics::BeamSection beam_section(double radius) {
  return dynamics::circular_section(radius, kBeamYoungModulus, kBeamPoissonRatio);
}

std::size_t add_lattice(const geometry::Lattice& lattice, double radius,
                        const dynamics::BeamSection& section, double density,
                        dynamics::Scene& scene) {
  const std::size_t first_node = scene.state.size();
  for (const Vec3& point : lattice.points) scene.add_node(point);
  for (const auto& bar : geometry::cylinders_of(lattice, radius, first_node)) {
    scene.add_cylinder(bar.nodes[0], bar.nodes[1], bar.radius, kCommonMaterial);
    scene.add_beam(bar.nodes[0], bar.nodes[1], section, density);
  }
  return first_node;
}

std::size_t add_membrane(const geometry::Mesh& mesh, dynamics::Scene& scene) {
  const std::size_t first_node = scene.state.size();
  const auto membrane = geometry::make_membrane(mesh, {2.0 * kMembraneRadius, first_node});
  for (const Vec3& node : membrane.nodes) scene.add_node(node);
  for (const auto& [nodes, radius] : membrane.facets) {
    scene.add_facet(nodes[0], nodes[1], nodes[2], radius, kCommonMaterial);
  }
  const auto section = beam_section(kMembraneRadius);
  for (const auto& [a, b] : membrane.edges) scene.add_beam(a, b, section, kBeamDensity);
  return first_node;
}

}  // namespace plekton::benchmarks

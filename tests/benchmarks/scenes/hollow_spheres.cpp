// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/hollow_spheres.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/benchmarks/scenes/parts.hpp"

namespace plekton::benchmarks {
namespace {

struct HollowSphere {
  Vec3 centre;    // m
  Vec3 velocity;  // m/s
};

void add_hollow_sphere(const geometry::Mesh& shape, const HollowSphere& sphere,
                       BenchmarkScene& scene) {
  geometry::Mesh mesh = shape;
  for (Vec3& point : mesh.points) point += sphere.centre;
  const std::size_t first_node = add_membrane(mesh, scene.scene);
  for (std::size_t i = first_node; i < scene.scene.state.size(); ++i)
    scene.scene.state.velocity[i] = sphere.velocity;
  scene.element_count += mesh.facets.size();
}

}  // namespace

BenchmarkScene hollow_sphere_on_floor() {
  constexpr double kRadius = 0.02;
  constexpr double kGap = 1e-3;
  BenchmarkScene result = empty_scene(0.3);
  add_hollow_sphere(geometry::icosphere(kRadius, 3),
                    {{0.0, 0.0, kRadius + kMembraneRadius + kGap}, {0.0, 0.0, -0.5}}, result);
  add_floor(kStiffWallMaterial, result.scene);
  return result;
}

BenchmarkScene colliding_hollow_spheres() {
  constexpr double kRadius = 0.01;
  constexpr double kSpacing = 2.0 * (kRadius + kMembraneRadius) + 5e-5;
  constexpr double kSpeed = 0.2;
  BenchmarkScene result = empty_scene(0.3);
  const geometry::Mesh shape = geometry::icosphere(kRadius, 2);
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        add_hollow_sphere(shape,
                          {kSpacing * Vec3(i + 0.5, j + 0.5, k + 0.5),
                           kSpeed * Vec3(1 - 2 * i, 1 - 2 * j, -(1 + k))},
                          result);
      }
    }
  }
  add_walls({2.0 * kSpacing, 2.0 * kSpacing, kStiffWallMaterial}, result.scene);
  add_floor(kStiffWallMaterial, result.scene);
  return result;
}

}  // namespace plekton::benchmarks

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/layer_of_spheres.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/benchmarks/scenes/parts.hpp"
#include "tests/support/seeded_random.hpp"

#include <numbers>

namespace plekton::benchmarks {
namespace {

constexpr int kAlongSide = 64;       // spheres
constexpr double kSpacing = 2.6e-3;  // m; two of 1.1 mm at 0.05 m/s do not meet in 3.2 ms
constexpr double kSide = kAlongSide * kSpacing;  // m
constexpr int kCells = 83;                       // of 2.005 mm
constexpr double kLargestVelocity = 0.035;       // m/s, along each side

Vec3 velocity_along(test::Random& random) {
  return {random.uniform(-kLargestVelocity, kLargestVelocity),
          random.uniform(-kLargestVelocity, kLargestVelocity), 0.0};
}

/// m, the place of sphere i in the plane of the ground, whose middle is the origin.
Vec3 place(int i) {
  return {(i % kAlongSide + 0.5) * kSpacing - 0.5 * kSide,
          (i / kAlongSide + 0.5) * kSpacing - 0.5 * kSide, 0.0};
}

/// m, of the spheres of the ground, or of the membrane.
double radius_of(Ground ground) {
  return ground == Ground::sheet ? kMembraneRadius : kSphereRadius;
}

/// m, where the weight of a sphere of a radius is borne.
double overlap(double radius, double ground_radius) {
  const double mass = 4.0 / 3.0 * std::numbers::pi * kSphereDensity * radius * radius * radius;
  const double stiffness = 2.0 * kYoungModulus * radius * ground_radius / (radius + ground_radius);
  return mass * kGravity.norm() / stiffness;
}

void add_layer(Ground ground, double height, test::Random& random, dynamics::Scene& scene) {
  for (int i = 0; i < kAlongSide * kAlongSide; ++i) {
    const double radius = kSphereRadius * random.uniform(0.9, 1.1);
    const double distance = radius + radius_of(ground) - overlap(radius, radius_of(ground));
    scene.add_sphere(place(i) + (height + distance) * Vec3::UnitZ(), radius, kSphereDensity,
                     kCommonMaterial);
    scene.state.velocity.back() = velocity_along(random);
  }
}

void add_ground(Ground ground, dynamics::Scene& scene) {
  if (ground == Ground::sheet) {
    add_membrane(geometry::plane_sheet({kSide, kSide, kCells, kCells}), scene);
    return;
  }
  for (int i = 0; i < kAlongSide * kAlongSide; ++i)
    scene.add_sphere(place(i), kSphereRadius, kSphereDensity, kCommonMaterial);
}

}  // namespace

BenchmarkScene layer_of_spheres(Ground ground, double height) {
  BenchmarkScene result = empty_scene(0.3);
  dynamics::Scene& scene = result.scene;
  test::Random random(1);
  add_layer(ground, height, random, scene);
  const std::size_t first_of_ground = scene.state.size();
  add_ground(ground, scene);
  for (std::size_t node = first_of_ground; node < scene.state.size(); ++node) {
    scene.properties.held[node] = dynamics::Held::everything;
    scene.state.velocity[node] = velocity_along(random);
  }
  result.element_count = scene.elements.spheres.size() + scene.elements.facets.size();
  return result;
}

}  // namespace plekton::benchmarks

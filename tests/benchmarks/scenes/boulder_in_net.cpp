// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/boulder_in_net.hpp"

#include "geometry/mesh/generate/lattice.hpp"
#include "tests/benchmarks/scenes/parts.hpp"

#include <cmath>
#include <numbers>

namespace plekton::benchmarks {
namespace {

constexpr int kMeshes = 60;
constexpr double kMesh = 0.05;           // m
constexpr double kWireRadius = 1.35e-3;  // m
constexpr double kWireModulus = 1e10;    // Pa
constexpr double kWireDensity = 7850.0;  // kg/m³
constexpr double kContactModulus = 1e8;  // Pa
constexpr double kBoulderRadius = 0.5;   // m
constexpr double kBoulderMass = 500.0;   // kg
constexpr double kBoulderSpeed = 5.0;    // m/s
constexpr double kGap = 5e-3;            // m
constexpr double kBoulderDamping = 0.1;

/// Around the origin, held at its rim.
void add_net(dynamics::Scene& scene) {
  constexpr double kHalfSide = 0.5 * kMeshes * kMesh;
  const auto net = geometry::biaxial_geogrid({kMesh, kMesh, kMeshes, kMeshes});
  const std::size_t first = add_lattice(
      net, kWireRadius, dynamics::circular_section(kWireRadius, kWireModulus, kBeamPoissonRatio),
      kWireDensity, scene);
  for (std::size_t i = 0; i < net.points.size(); ++i) {
    const double outermost = net.points[i].head<2>().cwiseAbs().maxCoeff();
    if (outermost > kHalfSide - 0.5 * kMesh)
      scene.properties.held[first + i] = dynamics::Held::everything;
  }
}

void add_boulder(dynamics::Scene& scene) {
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(kBoulderRadius, 3);
  const auto boulder = scene.add_sphere({0.0, 0.0, kBoulderRadius + kWireRadius + kGap},
                                        kBoulderRadius, kBoulderMass / volume, kCommonMaterial);
  const NodeId node = scene.elements.spheres[index_of(boulder)].nodes[0];
  scene.state.velocity[index_of(node)] = -kBoulderSpeed * Vec3::UnitZ();
}

}  // namespace

BenchmarkScene boulder_in_net() {
  BenchmarkScene result = empty_scene(kBoulderDamping);
  result.scene.materials[index_of(kCommonMaterial)].young_modulus = kContactModulus;
  add_net(result.scene);
  add_boulder(result.scene);
  result.element_count = 2 * kMeshes * (kMeshes + 1) + 1;
  return result;
}

}  // namespace plekton::benchmarks

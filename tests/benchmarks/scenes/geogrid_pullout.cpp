// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/geogrid_pullout.hpp"

#include "geometry/mesh/generate/lattice.hpp"
#include "tests/benchmarks/scenes/parts.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::benchmarks {
namespace {

constexpr double kAperture = 4e-3;      // m
constexpr double kBarRadius = 4e-4;     // m
constexpr double kClearOfWalls = 2e-3;  // m, at least, on either side
constexpr double kPullVelocity = 0.1;   // m/s

double median_height(const Bed& bed) {
  std::vector<double> heights;
  for (const Bed::Grain& grain : bed.grains) heights.push_back(grain.position.z());
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

double largest_radius(const Bed& bed) {
  double radius = 0.0;
  for (const Bed::Grain& grain : bed.grains) radius = std::max(radius, grain.radius);
  return radius;
}

/// The bed with a horizontal slot for the grid, whose axis comes to lie at the height returned (m).
double open_slot(Bed& bed) {
  const double middle = median_height(bed);
  const double radius = largest_radius(bed);
  for (Bed::Grain& grain : bed.grains) {
    if (grain.position.z() > middle) grain.position.z() += 2.0 * (radius + kBarRadius);
  }
  return middle + radius + kBarRadius;
}

geometry::Lattice grid_in_box(double side, double height) {
  const int apertures = static_cast<int>((side - 2.0 * kClearOfWalls) / kAperture);
  if (apertures < 1) {
    throw std::invalid_argument("the box is " + std::to_string(side) +
                                " m wide; the geogrid needs 0.008 m: take a bed of more spheres");
  }
  auto grid = geometry::biaxial_geogrid({kAperture, kAperture, apertures, apertures, 2});
  for (Vec3& point : grid.points) point += Vec3(0.5 * side, 0.5 * side, height);
  return grid;
}

/// Pulls at the nodes with the largest x.
void pull(const geometry::Lattice& grid, std::size_t first_node, dynamics::Scene& scene) {
  double far = grid.points.front().x();
  for (const Vec3& point : grid.points) far = std::max(far, point.x());
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    if (grid.points[i].x() < far - 0.25 * kAperture) continue;
    scene.properties.held[first_node + i] = dynamics::Held::everything;
    scene.state.velocity[first_node + i] = kPullVelocity * Vec3::UnitX();
  }
}

}  // namespace

BenchmarkScene geogrid_pullout(const Bed& bed) {
  Bed opened = bed;
  const double height = open_slot(opened);
  BenchmarkScene result = empty_scene(0.3);
  add_spheres(opened, result.scene);
  add_walls({bed.side, bed.side}, result.scene);
  add_floor(kCommonMaterial, result.scene);
  const auto grid = grid_in_box(bed.side, height);
  pull(grid, add_lattice(grid, kBarRadius, beam_section(kBarRadius), kBeamDensity, result.scene),
       result.scene);
  result.element_count = bed.grains.size() + grid.edges.size();
  return result;
}

}  // namespace plekton::benchmarks

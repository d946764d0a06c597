// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/grains/random.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

/// A lattice is pulled out of a bed of 1368 grains, four layers on either side of it, between two
/// plates that press with 20 kPa.
namespace plekton::apps::pull_out {

/// The linear law but for pairs of materials that do not touch: the walls around the bed are there
/// for the grains, the lattice passes through them.
struct LinearButForSomePairs : contact::LinearFrictional {
  static constexpr std::string_view name = "linear_but_for_some_pairs";
  struct Properties {
    bool touch = true;
  };
  using contact::LawDefaults::list_problems;  // those of the linear law are of its own properties
  static Parameters combine(const Properties& pair, const contact::Body& a,
                            const contact::Body& b) noexcept {
    return pair.touch ? contact::LinearFrictional::combine(a, b) : Parameters{0.0, 0.0, 0.0};
  }
};
static_assert(contact::ContactLaw<LinearButForSomePairs>);

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

inline constexpr double kLength = 0.10;     // m, of the bed along the pull
inline constexpr double kWidth = 0.05;      // m
inline constexpr double kCell = 0.01;       // m
inline constexpr double kThickness = 1e-3;  // m, radius of the lattice
inline constexpr double kGrain = 2.5e-3;    // m, radius of the largest
inline constexpr double kModulus = 5e6;     // Pa, of contacts; of the lattice ten times as much
inline constexpr double kDensity = 2650.0;  // kg/m³
inline constexpr double kPressure = 20e3;   // Pa
inline constexpr double kSpeed = 0.1;       // m/s
inline constexpr double kPull = 0.012;      // m
inline constexpr double kSettling = 0.06;   // s
inline constexpr double kStep = 1.2e-5;     // s
inline constexpr contact::MaterialId kGrains{0}, kLattice{1}, kWalls{2};
inline const double kFriction = elementary::tan(20.0 / 180.0 * std::numbers::pi);

enum class Kind { membrane, grid };

inline Held held_at(const Vec3& x, Kind kind) {
  if (x.x() < -0.5 * kLength + 1e-9) return Held::everything;
  return kind == Kind::membrane ? Held::rotation : Held::nothing;
}

/// Of a membrane facets with bars, since it has no stiffness of its own across them, along every
/// side; of a grid beams and cylinders along the sides of the cells.
inline void add_lattice(dynamics::Scene& scene, Kind kind) {
  const bool is_grid = kind == Kind::grid;
  const auto mesh = geometry::plane_sheet({kLength, kWidth, 10, 5});
  for (const Vec3& x : mesh.points) scene.add_node(x, held_at(x, kind));
  const auto membrane = geometry::make_membrane(mesh, {.thickness = 2.0 * kThickness});
  if (!is_grid)
    for (const auto& facet : membrane.facets)
      scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], kThickness, kLattice);
  const auto section = is_grid ? dynamics::circular_section(kThickness, 10.0 * kModulus, 0.3)
                               : dynamics::bar_section(kThickness, 10.0 * kModulus);
  for (const auto& [a, b] : membrane.edges) {
    const Vec3 side = mesh.points[index_of(b)] - mesh.points[index_of(a)];
    if (is_grid && side.norm() > 1.1 * kCell) continue;  // a diagonal
    scene.add_beam(a, b, section, kDensity);
    if (is_grid) scene.add_cylinder(a, b, kThickness, kLattice);
  }
  if (!is_grid) return;
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scene.properties.inertia[i] = scene.properties.mass[i] * kCell * kCell / 12.0;
}

/// Layers on either side of the lattice, and the planes around them; the last two are the plates.
inline void add_bed(dynamics::Scene& scene, std::uint64_t seed) {
  constexpr double kPitch = 2.04 * kGrain;
  constexpr double kAside = 1e-4;  // m
  constexpr int kLayers = 4;
  const int columns = static_cast<int>(kLength / kPitch);
  const int rows = static_cast<int>(kWidth / kPitch);
  Random random(seed);
  const Vec3 corner(kAside, kAside, kAside);
  for (const double side : {1.0, -1.0}) {
    for (int layer = 0; layer < kLayers; ++layer) {
      const double z = side * (kThickness + kGrain + 2e-4 + layer * kPitch);
      for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
          const double radius = kGrain * random.uniform(0.88, 1.0);
          const Vec3 off = random.in_box(-corner, corner);
          const double x = ((i + 0.5) / columns - 0.5) * kLength + off.x();
          const double y = ((j + 0.5) / rows - 0.5) * kWidth + off.y();
          scene.add_sphere(Vec3(x, y, z), radius, kDensity, kGrains);
        }
      }
    }
  }
  const double height = kThickness + 2.0 * kGrain + 9e-4 + (kLayers - 1) * kPitch;
  const Vec3 half(0.5 * kLength, 0.5 * kWidth, height);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 outward = side * Vec3::Unit(axis);
      scene.planes.push_back({half[axis] * outward, -outward, Vec3::Zero(), kWalls});
    }
  }
}

inline dynamics::Scene scene_of(Kind kind, std::uint64_t seed) {
  dynamics::Scene scene;
  scene.materials = {{kModulus, 0.3, kFriction}, {kModulus, 0.3, kFriction}, {kModulus, 0.3, 0.0}};
  add_lattice(scene, kind);
  add_bed(scene, seed);
  for (const std::size_t plate : {std::size_t{4}, std::size_t{5}}) {
    dynamics::PlaneServo servo;
    servo.plane = plate;
    servo.pressure = kPressure;
    servo.area = kLength * kWidth;
    servo.largest_speed = 0.3;
    scene.loads.servos.push_back(servo);
  }
  return scene;
}

struct PullOut {
  std::size_t grains = 0;
  std::int64_t steps = 0;
  double largest = 0.0;        ///< of the pull over 2 sigma A, A what is still in the bed
  double mean = 0.0;           ///< of the last half
  double pressure = 0.0;       ///< Pa, on the upper plate, mean of the last half
  std::vector<double> out;     ///< m, way of the front edge
  std::vector<double> shares;  ///< the pull over 2 sigma A there
};

/// @param seed       of the bed
/// @param time_step  s; 0: the simulation chooses
inline PullOut pulled_out(Kind kind, std::uint64_t seed, double time_step = kStep) {
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  options.motion.damping = 0.2;
  const dynamics::Scene scene = scene_of(kind, seed);
  PullOut result;
  result.grains = scene.elements.spheres.size();
  dynamics::Simulation simulation(
      scene, options, contact::model_of<LinearButForSomePairs>({{{kLattice, kWalls}, {false}}}));
  while (simulation.time() < kSettling) simulation.step();
  std::vector<NodeId> front;
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    if (scene.properties.held[i] != Held::everything) continue;
    front.push_back(geometry::id_at<NodeId>(i));
    simulation.set_velocity(front.back(), Vec3(-kSpeed, 0.0, 0.0));
  }
  int samples = 0;
  while (simulation.time() < kSettling + kPull / kSpeed) {
    simulation.step();
    double force = 0.0;
    for (const NodeId node : front) force += simulation.forces().force[index_of(node)].x();
    const double out = kSpeed * (simulation.time() - kSettling);
    result.out.push_back(out);
    result.shares.push_back(force / (2.0 * kPressure * (kLength - out) * kWidth));
    result.largest = std::max(result.largest, result.shares.back());
    if (out < 0.5 * kPull) continue;
    ++samples;
    result.mean += result.shares.back();
    result.pressure += simulation.contacts().on_plane(5).force.z() / (kLength * kWidth);
  }
  result.steps = simulation.steps();
  result.mean /= samples;
  result.pressure /= samples;
  return result;
}

}  // namespace plekton::apps::pull_out

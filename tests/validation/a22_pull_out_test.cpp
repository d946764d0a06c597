// SPDX-License-Identifier: GPL-3.0-or-later
// A22: a membrane, then a grid of the same lattice, is pulled out of a bed of 1368 grains between
// two plates that press with 20 kPa. The pull over 2 sigma A, A what is still in the bed, is at
// most tan(phi) where grains slide on a membrane; grains that interlock with a grid hold it better.
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/lattice_body.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

namespace plekton::test {

using contact::LinearFrictional;

/// The linear law but for pairs of materials that do not touch: the walls around the bed are there
/// for the grains, the membrane passes through them.
struct LinearButForSomePairs : LinearFrictional {
  static constexpr std::string_view name = "linear_but_for_some_pairs";
  struct Properties {
    bool touch = true;
  };
  static Parameters combine(const Properties& pair, const contact::Body& a,
                            const contact::Body& b) noexcept {
    return pair.touch ? LinearFrictional::combine(a, b) : Parameters{0.0, 0.0, 0.0};
  }
};
static_assert(contact::ContactLaw<LinearButForSomePairs>);

}  // namespace plekton::test

namespace plekton::test {
namespace {

using contact::MaterialId;
using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kLength = 0.10;     // m, of the bed along the pull
constexpr double kWidth = 0.05;      // m
constexpr double kCell = 0.01;       // m
constexpr double kThickness = 1e-3;  // m, radius of the lattice
constexpr double kGrain = 2.5e-3;    // m, radius of the largest
constexpr double kModulus = 5e6;     // Pa, of contacts; of the lattice ten times as much
constexpr double kDensity = 2650.0;  // kg/m³
constexpr double kPressure = 20e3;   // Pa
constexpr double kSpeed = 0.1;       // m/s
constexpr double kPull = 0.012;      // m
constexpr double kSettling = 0.06;   // s
constexpr MaterialId kGrains{0}, kLattice{1}, kWalls{2};
const double kFriction = std::tan(20.0 / 180.0 * std::numbers::pi);

enum class Kind { membrane, grid };

Held held_at(const Vec3& x, Kind kind) {
  if (x.x() < -0.5 * kLength + 1e-9) return Held::everything;
  return kind == Kind::membrane ? Held::rotation : Held::nothing;
}

/// Bars, as a membrane has no stiffness of its own across them, and facets.
void add_membrane(Scene& scene) {
  const auto mesh = geometry::plane_sheet({kLength, kWidth, 10, 5});
  add_lattice(scene, mesh, Vec3::Zero(),
              {kThickness, dynamics::bar_section(kThickness, 10.0 * kModulus), kDensity, kLattice},
              [](const Vec3& x) { return held_at(x, Kind::membrane); });
}

/// Beams along the sides of the cells, and cylinders.
void add_grid(Scene& scene) {
  const auto mesh = geometry::plane_sheet({kLength, kWidth, 10, 5});
  for (const Vec3& x : mesh.points) scene.add_node(x, held_at(x, Kind::grid));
  const auto section = dynamics::circular_section(kThickness, 10.0 * kModulus, 0.3);
  for (const auto& [a, b] : geometry::make_membrane(mesh, {.thickness = 2.0 * kThickness}).edges) {
    const Vec3 side = mesh.points[index_of(b)] - mesh.points[index_of(a)];
    if (side.norm() > 1.1 * kCell) continue;  // a diagonal
    scene.add_beam(a, b, section, kDensity);
    scene.add_cylinder(a, b, kThickness, kLattice);
  }
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scene.properties.inertia[i] = scene.properties.mass[i] * kCell * kCell / 12.0;
}

/// Four layers on either side of the lattice, and the planes around them; the last two are the
/// plates.
void add_bed(Scene& scene) {
  constexpr double kPitch = 2.04 * kGrain;
  constexpr int kLayers = 4;
  const int columns = static_cast<int>(kLength / kPitch);
  const int rows = static_cast<int>(kWidth / kPitch);
  Random random(3);
  for (const double side : {1.0, -1.0}) {
    for (int layer = 0; layer < kLayers; ++layer) {
      const double z = side * (kThickness + kGrain + 2e-4 + layer * kPitch);
      for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
          const double radius = kGrain * random.uniform(0.88, 1.0);
          const Vec3 off = random.in_cube(1e-4);
          scene.add_sphere(Vec3(((i + 0.5) / columns - 0.5) * kLength + off.x(),
                                ((j + 0.5) / rows - 0.5) * kWidth + off.y(), z),
                           radius, kDensity, kGrains);
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

Scene pull_out_scene(Kind kind) {
  Scene scene;
  scene.materials = {{kModulus, 0.3, kFriction}, {kModulus, 0.3, kFriction}, {kModulus, 0.3, 0.0}};
  kind == Kind::membrane ? add_membrane(scene) : add_grid(scene);
  add_bed(scene);
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
  double largest = 0.0;   ///< of the pull over 2 sigma A
  double mean = 0.0;      ///< of the last half
  double pressure = 0.0;  ///< Pa, on the upper plate, mean of the last half
};

PullOut pull_out(Kind kind) {
  dynamics::SimulationOptions options;
  options.time_step = 1.2e-5;
  options.motion.damping = 0.2;
  const Scene scene = pull_out_scene(kind);
  PullOut result;
  result.grains = scene.elements.spheres.size();
  Simulation simulation(scene, options,
                        contact::model_of<LinearButForSomePairs>({{{kLattice, kWalls}, {false}}}));
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
    const double share = force / (2.0 * kPressure * (kLength - out) * kWidth);
    result.largest = std::max(result.largest, share);
    if (out < 0.5 * kPull) continue;
    ++samples;
    result.mean += share;
    result.pressure += simulation.contacts().force_on_plane(5).z() / (kLength * kWidth);
  }
  result.mean /= samples;
  result.pressure /= samples;
  std::printf("pull-out of a %s: mean %.3f, largest %.3f of 2 sigma A, sigma %.2f kPa\n",
              kind == Kind::membrane ? "membrane" : "grid", result.mean, result.largest,
              1e-3 * result.pressure);
  return result;
}

TEST(A22PullOut, AMembraneSlidesAndAGridInterlocks) {
  const PullOut membrane = pull_out(Kind::membrane);
  const PullOut grid = pull_out(Kind::grid);

  EXPECT_EQ(membrane.grains, 1368u);
  EXPECT_NEAR(membrane.pressure, kPressure, 0.05 * kPressure);
  EXPECT_NEAR(grid.pressure, kPressure, 0.05 * kPressure);
  EXPECT_GT(membrane.mean, 0.18);
  EXPECT_LT(membrane.mean, kFriction);
  EXPECT_LT(membrane.largest, 1.02 * kFriction);
  EXPECT_GT(grid.mean, 0.35);
  EXPECT_LT(grid.mean, 0.65);
  EXPECT_GT(grid.mean, membrane.mean);
}

}  // namespace
}  // namespace plekton::test

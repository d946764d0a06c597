// SPDX-License-Identifier: GPL-3.0-or-later
// A24: the same bits for any number of threads.
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace plekton::a24_threads_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;
using geometry::NodeId;
using geometry::ParallelSum;
using geometry::Vec3;

constexpr contact::MaterialId kFabric{0};
constexpr contact::MaterialId kGrains{1};
constexpr double kHalfWidth = 0.06;  // m, of sheet and wires

/// m; the sheet lies 0.2 mm under the wires that sink onto it.
constexpr double kBelowTheWires = 0.0027;

void add_sheet(dynamics::Scene& scene) {
  const auto mesh = geometry::plane_sheet(
      {.width = 2.0 * kHalfWidth, .length = 2.0 * kHalfWidth, .cells_x = 6, .cells_y = 6});
  const auto sheet = geometry::make_membrane(mesh, {.thickness = 0.003});
  const std::size_t first = scene.state.size();
  const auto node = [&](NodeId point) { return geometry::id_at<NodeId>(first + index_of(point)); };
  for (const Vec3& x : mesh.points) {
    const bool on_rim = x.cwiseAbs().maxCoeff() > 0.999 * kHalfWidth;
    scene.add_node(x - Vec3(0.0, 0.0, kBelowTheWires), on_rim ? Held::everything : Held::nothing);
  }
  for (const auto& [a, b, c] : mesh.facets) {
    scene.add_facet(node(a), node(b), node(c), 0.0015, kFabric);
  }
  const auto fibre = dynamics::circular_section(0.0015, 2e7, 0.3);
  for (const auto& [a, b] : sheet.edges) scene.add_beam(node(a), node(b), fibre, 600.0);
}

/// Parallel wires in the plane of the sheet, each a structure of its own, clamped at their ends.
void add_wires(dynamics::Scene& scene) {
  constexpr int kWires = 45;
  constexpr int kSegments = 12;
  constexpr double kSpacing = 0.0025;
  const auto section = dynamics::circular_section(0.001, 2e8, 0.3);
  for (int wire = 0; wire < kWires; ++wire) {
    const double x = kSpacing * (wire - 0.5 * (kWires - 1));
    for (int i = 0; i <= kSegments; ++i) {
      const double y = kHalfWidth * (2.0 * i / kSegments - 1.0);
      const bool is_end = i == 0 || i == kSegments;
      const NodeId node =
          scene.add_node(Vec3(x, y, 0.0), is_end ? Held::everything : Held::nothing);
      if (i == 0) continue;
      const NodeId last = geometry::id_at<NodeId>(index_of(node) - 1);
      scene.add_cylinder(last, node, 0.001, kFabric);
      scene.add_beam(last, node, section, 1000.0);
    }
  }
}

/// Two layers of grains, nearly a closest packing, just above the fabric.
void add_grains(dynamics::Scene& scene) {
  constexpr double kSpacing = 0.0115;
  constexpr int kRow = 9;
  constexpr int kRows = 11;
  const double row_distance = std::sqrt(0.75) * kSpacing;
  test::Random random(11);
  for (int layer = 0; layer < 2; ++layer) {
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kRow; ++i) {
        const double x = kSpacing * (i - 0.5 * kRow + 0.5 * (row % 2) + 0.25);
        const double y = row_distance * (row - 0.5 * (kRows - 1) + layer / 3.0);
        const double z = 0.0070 + layer * std::sqrt(2.0 / 3.0) * kSpacing;
        const Vec3 centre(x + 0.5 * layer * kSpacing, y, z);
        scene.add_sphere(centre + random.in_cube(1e-4), random.uniform(0.005, 0.0054), 2650.0,
                         kGrains);
      }
    }
  }
}

dynamics::Scene catch_of_several_chunks() {
  dynamics::Scene scene;
  scene.materials = {{5e6, 0.3, 0.4}, {5e6, 0.3, 0.6}};
  add_sheet(scene);
  add_wires(scene);
  add_grains(scene);
  return scene;
}

/// Otherwise everything of a kind would be the work of one thread, and the test would show nothing.
void expect_several_chunks(const Simulation& simulation) {
  constexpr std::size_t kSeveral = 2 * ParallelSum<double>::kChunk + 88;
  static_assert(kSeveral >= 600);
  const auto& neighbours = simulation.contacts().neighbours();
  EXPECT_GE(simulation.state().size(), kSeveral);
  EXPECT_GE(simulation.bonds().size(), kSeveral);
  EXPECT_GE(neighbours.sphere_pairs().size(), kSeveral);
  EXPECT_GE(neighbours.sphere_structures().size(), kSeveral);
}

dynamics::NodeState state_after_20000_steps(int threads) {
  dynamics::SimulationOptions options;
  options.motion = {Vec3(0.0, 0.0, -9.81), 0.3, true};
  options.skin = 0.0015;
  options.threads = threads;
  Simulation simulation(catch_of_several_chunks(), options);
  expect_several_chunks(simulation);
  for (int i = 0; i < 20000; ++i) simulation.step();
  expect_several_chunks(simulation);
  EXPECT_GE(simulation.contacts().neighbours().rebuild_count(), 3);
  EXPECT_GE(simulation.contacts().counts().sphere_sphere, 100u);
  EXPECT_GE(simulation.contacts().counts().sphere_surface, 100u);
  return simulation.state();
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Vec3& p, const Vec3& q) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::bit_cast<std::uint64_t>(p[axis]) != std::bit_cast<std::uint64_t>(q[axis]))
        return false;
    }
    return true;
  });
}

TEST(A24Threads, OneTwoAndFourGiveTheSameBitsOver20000Steps) {
  const dynamics::NodeState one = state_after_20000_steps(1);

  for (const int threads : {2, 4}) {
    const dynamics::NodeState many = state_after_20000_steps(threads);
    EXPECT_TRUE(same_bits(one.position, many.position)) << threads << " threads";
    EXPECT_TRUE(same_bits(one.velocity, many.velocity)) << threads << " threads";
    EXPECT_TRUE(same_bits(one.angular_velocity, many.angular_velocity)) << threads << " threads";
  }
}

}  // namespace
}  // namespace plekton::a24_threads_test

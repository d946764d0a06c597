// SPDX-License-Identifier: GPL-3.0-or-later
// A24: the same result for any order of creation.
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace plekton::a24_determinism_test {
namespace {

using dynamics::Simulation;
using geometry::NodeId;
using geometry::Vec3;

/// A small catch: grains fall on a sheet held at its rim. Everything is created in the order of
/// `order`'s shuffles.
struct SmallCatch {
  dynamics::Scene scene;
  std::vector<std::size_t> sheet_node;  ///< by point of the mesh
  std::vector<std::size_t> grain_node;  ///< by grain
};

std::vector<std::size_t> order(std::size_t count, test::Random* shuffle) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (shuffle == nullptr) return places;
  for (std::size_t i = count; i > 1; --i) std::swap(places[i - 1], places[shuffle->index(i)]);
  return places;
}

void add_sheet(SmallCatch& made, test::Random* shuffle) {
  const auto mesh =
      geometry::plane_sheet({.width = 0.12, .length = 0.12, .cells_x = 6, .cells_y = 6});
  const auto sheet = geometry::make_membrane(mesh, {.thickness = 0.003});
  made.sheet_node.resize(mesh.points.size());
  for (const std::size_t i : order(mesh.points.size(), shuffle)) {
    const bool on_rim = mesh.points[i].cwiseAbs().maxCoeff() > 0.0599;
    const auto held = on_rim ? dynamics::Held::everything : dynamics::Held::nothing;
    made.sheet_node[i] = index_of(made.scene.add_node(mesh.points[i], held));
  }
  const auto node = [&](NodeId point) {
    return geometry::id_at<NodeId>(made.sheet_node[index_of(point)]);
  };
  for (const std::size_t f : order(mesh.facets.size(), shuffle)) {
    const auto& [a, b, c] = mesh.facets[f];
    made.scene.add_facet(node(a), node(b), node(c), 0.0015, contact::MaterialId{0});
  }
  const auto fibre = dynamics::circular_section(0.0015, 2e7, 0.3);
  for (const std::size_t e : order(sheet.edges.size(), shuffle)) {
    made.scene.add_beam(node(sheet.edges[e][0]), node(sheet.edges[e][1]), fibre, 600.0);
  }
}

void add_grains(SmallCatch& made, test::Random* shuffle) {
  constexpr std::size_t kGrains = 48;
  test::Random random(11);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  for (std::size_t i = 0; i < kGrains; ++i) {
    const auto column = static_cast<double>(i % 4);
    const auto row = static_cast<double>(i / 4 % 4);
    const auto layer = static_cast<double>(i / 16);
    centres.push_back(Vec3(0.018 * (column - 1.5), 0.018 * (row - 1.5), 0.011 + 0.018 * layer) +
                      random.in_cube(1e-3));
    radii.push_back(random.uniform(0.005, 0.007));
  }
  made.grain_node.resize(kGrains);
  for (const std::size_t i : order(kGrains, shuffle)) {
    const auto sphere = made.scene.add_sphere(centres[i], radii[i], 2650.0, contact::MaterialId{1});
    made.grain_node[i] = index_of(made.scene.elements.spheres[index_of(sphere)].nodes[0]);
  }
}

SmallCatch small_catch(test::Random* shuffle = nullptr) {
  SmallCatch made;
  made.scene.materials = {{5e6, 0.3, 0.4}, {5e6, 0.3, 0.6}};
  add_sheet(made, shuffle);
  add_grains(made, shuffle);
  return made;
}

dynamics::NodeState state_after_20000_steps(const dynamics::Scene& scene) {
  dynamics::SimulationOptions options;
  options.time_step = 2.5e-6;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  Simulation simulation(scene, options);
  for (int i = 0; i < 20000; ++i) simulation.step();
  return simulation.state();
}

TEST(A24Determinism, TheOrderOfCreationChangesTheResultByRoundingOnlyOver20000Steps) {
  const SmallCatch plain = small_catch();
  test::Random shuffle(5);
  const SmallCatch shuffled = small_catch(&shuffle);

  const dynamics::NodeState a = state_after_20000_steps(plain.scene);
  const dynamics::NodeState b = state_after_20000_steps(shuffled.scene);

  // 1e-9 of the size of the scene, 0.12 m. Colliding grains are chaotic: rounding grows tenfold
  // every 10 ms or so, and numerical damping, which asks for signs, makes it worse; so 20000 steps
  // are 50 ms here, without damping.
  double largest = 0.0;
  for (std::size_t i = 0; i < plain.grain_node.size(); ++i) {
    largest = std::max(
        largest, (a.position[plain.grain_node[i]] - b.position[shuffled.grain_node[i]]).norm());
  }
  for (std::size_t i = 0; i < plain.sheet_node.size(); ++i) {
    largest = std::max(
        largest, (a.position[plain.sheet_node[i]] - b.position[shuffled.sheet_node[i]]).norm());
  }
  EXPECT_LT(largest, 1e-9 * 0.12);
}

}  // namespace
}  // namespace plekton::a24_determinism_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/neighbours.hpp"

#include "geometry/base/state_archive.hpp"
#include "geometry/closest/foot_point.hpp"
#include "geometry/critical/descent.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace plekton::test::neighbours_test {
namespace {

/// Spheres among a sheet, a net and a ball of facets, all nodes of their own.
struct Scene {
  explicit Scene(Random& random) {
    for (const Complex& part : {sheet(4), net(3), ball(1)}) {
      const int first = static_cast<int>(complex.x.size());
      const Vec3 place = random.in_cube(0.5) - Vec3(2, 2, 0);
      for (const Vec3& x : part.x) complex.node(x + place);
      const auto at = [&](NodeId node) { return first + static_cast<int>(node); };
      for (const auto& f : part.facets)
        complex.facet(at(f.nodes[0]), at(f.nodes[1]), at(f.nodes[2]));
      for (const auto& c : part.cylinders) complex.cylinder(at(c.nodes[0]), at(c.nodes[1]));
    }
    for (int k = 0; k < 60; ++k) {
      spheres.push_back({{NodeId{complex.node(random.in_cube(2.0))}}, random.uniform(0.1, 0.4)});
    }
    surface = complex.surface();
  }

  double distance(const Sphere& sphere, CellId cell) const {
    const Vec3& p = complex.x[index_of(sphere.nodes[0])];
    const auto n =
        test::nodes_of(surface, closest_feature(surface, surface.feature_of(cell), p, complex.x));
    const auto at = [&](std::size_t i) { return complex.x[index_of(n[i])]; };
    if (n.size() == 1) return foot_on_node(p, at(0)).distance;
    if (n.size() == 2) return foot_on_edge(p, {at(0), at(1)}).distance;
    return foot_on_face(p, {at(0), at(1), at(2)}).distance;
  }

  Complex complex;
  std::vector<Sphere> spheres;
  Surface surface;
};

bool lists(const Neighbours& neighbours, std::size_t sphere, CellId cell, StructureId structure) {
  const auto keys = neighbours.sphere_structures();
  const IndexPair key{static_cast<std::int32_t>(sphere), static_cast<std::int32_t>(structure)};
  const auto found = std::lower_bound(keys.begin(), keys.end(), key);
  if (found == keys.end() || *found != key) return false;
  const NearCells near = neighbours.near_cells()[static_cast<std::size_t>(found - keys.begin())];
  const auto cells = neighbours.cells().subspan(near.first, near.count);
  return std::binary_search(cells.begin(), cells.end(), cell);
}

/// @returns how many pairs touch
int expect_all_touching_listed(const Scene& scene, const Neighbours& neighbours) {
  int touching = 0;
  const auto pairs = neighbours.sphere_pairs();
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere& a = scene.spheres[i];
    for (std::size_t j = i + 1; j < scene.spheres.size(); ++j) {
      const Sphere& b = scene.spheres[j];
      const double distance =
          (scene.complex.x[index_of(a.nodes[0])] - scene.complex.x[index_of(b.nodes[0])]).norm();
      if (distance >= a.radius + b.radius) continue;
      ++touching;
      const IndexPair key{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
      EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), key));
    }
    for (std::size_t c = 0; c < scene.surface.cell_count(); ++c) {
      const CellId cell = id_at<CellId>(c);
      const StructureId structure = scene.surface.structure_of(cell);
      if (scene.distance(a, cell) >= a.radius + scene.surface.radius(structure)) continue;
      ++touching;
      EXPECT_TRUE(lists(neighbours, i, cell, structure)) << "sphere " << i << ", cell " << c;
    }
  }
  return touching;
}

TEST(Neighbours, ListEveryPairThatTouchesWhileAllNodesMove) {
  Random random(1);
  for (const double skin : {0.0, 0.02, 0.3}) {
    SCOPED_TRACE(skin);
    Scene scene(random);
    Neighbours neighbours(scene.spheres, scene.surface, skin);
    ThreadPool pool(2);
    int touching = 0;
    for (int step = 0; step < 60; ++step) {
      for (Vec3& x : scene.complex.x) x += random.in_cube(0.02);
      neighbours.update(scene.complex.x, pool);
      touching += expect_all_touching_listed(scene, neighbours);
      ASSERT_TRUE(std::is_sorted(neighbours.sphere_structures().begin(),
                                 neighbours.sphere_structures().end()));
      ASSERT_TRUE(
          std::is_sorted(neighbours.sphere_pairs().begin(), neighbours.sphere_pairs().end()));
    }
    EXPECT_GE(touching, 1000);
    if (skin == 0.3) {
      EXPECT_LE(neighbours.rebuild_count(), 30);
    }
  }
}

TEST(Neighbours, ListEveryPairThatTouchesWithASkinThatFollowsTheMotion) {
  Random random(3);
  Scene scene(random);
  Neighbours neighbours(scene.spheres, scene.surface, 0.1);
  neighbours.tune_skin(0.2);
  ThreadPool pool(2);
  int touching = 0;
  const auto move = [&](double step, int steps) {
    for (int i = 0; i < steps; ++i) {
      for (Vec3& x : scene.complex.x) x += random.in_cube(step);
      scene.complex.x[0].x() += step;  // steadily
      neighbours.update(scene.complex.x, pool);
      touching += expect_all_touching_listed(scene, neighbours);
    }
  };

  move(0.02, 100);
  const double fast_skin = neighbours.skin();
  move(1e-3, 400);

  EXPECT_GE(touching, 1000);
  EXPECT_DOUBLE_EQ(fast_skin, 0.8 * 0.2);
  EXPECT_LT(neighbours.skin(), 0.6 * fast_skin);
}

TEST(Neighbours, AreMadeOnceWhileNothingMoves) {
  Random random(2);
  Scene scene(random);
  Neighbours neighbours(scene.spheres, scene.surface, 0.1);
  ThreadPool pool;

  EXPECT_TRUE(neighbours.update(scene.complex.x, pool));
  EXPECT_FALSE(neighbours.update(scene.complex.x, pool));
  EXPECT_EQ(neighbours.rebuild_count(), 1);
  EXPECT_EQ(neighbours.skin(), 0.1);
}

/// A scene at rest, whose steps outnumber an int, begins to move.
TEST(Neighbours, ChooseASoundSkinAfterAListThatLastedForBillionsOfSteps) {
  constexpr double kRadius = 0.2;
  Random random(31);
  const Scene scene(random);
  ThreadPool pool;
  Neighbours neighbours(scene.spheres, scene.surface, 0.1);
  neighbours.tune_skin(kRadius);
  neighbours.update(scene.complex.x, pool);
  StateTree state;
  neighbours.exchange(StateArchive::writer(state), pool);
  state.arrays.at("steps_of_list").numbers =
      std::vector<std::int32_t>{std::numeric_limits<std::int32_t>::max() - 1};
  neighbours.exchange(StateArchive::reader(state), pool);

  for (int k = 0; k < 3; ++k) EXPECT_FALSE(neighbours.update(scene.complex.x, pool));
  std::vector<Vec3> moved = scene.complex.x;
  for (Vec3& x : moved) x.x() += 1.0;

  EXPECT_TRUE(neighbours.update(moved, pool));
  EXPECT_DOUBLE_EQ(neighbours.skin(), 0.7 * 0.1);  // as short as it may become at once
}

}  // namespace
}  // namespace plekton::test::neighbours_test

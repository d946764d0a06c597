// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/parallel_sum.hpp"
#include "geometry/base/thread_pool.hpp"
#include "geometry/critical/critical_features.hpp"
#include "geometry/critical/descent.hpp"
#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/neighbor/skin.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace plekton::geometry::allocation_test {
namespace {

TEST(Allocation, IsCounted) {
  EXPECT_EQ(test::allocations_of([] { ::operator delete(::operator new(1)); }), 1u);
}

TEST(Allocation, DoesNotHappenWhenTheBroadPhaseFollowsMovingBoxes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Box> boxes(2000);
  for (Box& box : boxes) {
    box.lower = Vec3(unit(random), unit(random), unit(random));
    box.upper = box.lower + Vec3::Constant(0.1);
  }
  std::vector<IndexPair> pairs;
  std::vector<std::int32_t> indices;
  BroadPhase broad_phase;
  broad_phase.rebuild(boxes);
  const auto step = [&](double length) {
    for (Box& box : boxes) {
      const Vec3 move = length * Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
      box.lower += move;
      box.upper += move;
    }
    broad_phase.refit(boxes);
    broad_phase.self_pairs(pairs);
    broad_phase.rebuild(boxes);
    broad_phase.self_pairs(pairs);
    broad_phase.pairs_with(broad_phase, pairs);
    broad_phase.query(boxes[0], indices);
  };
  step(0.0);
  // The motion changes the number of pairs: make room with a scene that has more of them.
  std::vector<Box> wide = boxes;
  for (Box& box : wide) box.upper += Vec3::Constant(0.03);
  broad_phase.refit(wide);
  broad_phase.pairs_with(broad_phase, pairs);
  broad_phase.query(wide[0], indices);
  indices.reserve(boxes.size());

  const std::size_t count = test::allocations_of([&] {
    for (int k = 0; k < 50; ++k) step(0.01);
  });

  EXPECT_EQ(count, 0u);
}

TEST(Allocation, DoesNotHappenInLoopsSumsAndTheSkinAfterTheFirst) {
  const std::vector<Vec3> x(3000, Vec3::Ones());
  ThreadPool pool(3);
  ParallelSum<Vec3> sum;
  Skin skin(0.1);
  const auto step = [&] {
    pool.for_each_range(x.size(), [](std::size_t, std::size_t, int) {});
    sum(x.size(), pool, [&](std::size_t begin, std::size_t, int) { return x[begin]; });
    skin.mark_built(x);
    skin.needs_rebuild(x, pool);
  };
  step();

  EXPECT_EQ(test::allocations_of(step), 0u);
}

TEST(Allocation, DoesNotHappenInAWarmSearchForCriticalFeaturesNorInADescent) {
  const test::Complex cube = test::cube(3);
  const Surface surface = cube.surface();
  CriticalFeatureFinder finder(surface);
  std::vector<CellId> cells(surface.cell_count());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = id_at<CellId>(c);
  // On the lattice many signs are ties, which need the exact stage.
  const auto search = [&] {
    for (int k = 0; k < 1000; ++k) {
      const Vec3 point = 0.5 * Vec3(k % 10, k / 10 % 10, k / 100);
      const auto found = finder.find(point, 10.0, cells, cube.x);
      finder.branches(found.front().core.feature, point, cube.x);
      descend(surface, found.back().core.feature, point, cube.x);
    }
  };
  search();

  EXPECT_EQ(test::allocations_of(search), 0u);
}

}  // namespace
}  // namespace plekton::geometry::allocation_test

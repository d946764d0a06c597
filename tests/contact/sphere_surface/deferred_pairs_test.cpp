// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/deferred_pairs.hpp"

#include "contact/law/linear_frictional.hpp"
#include "contact/sphere_surface/surface_contacts.hpp"
#include "geometry/critical/descent.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

/// Cells that sleep do not change anything but the time it takes.
namespace plekton::test::deferred_pairs_test {
namespace {

using Law = LinearFrictional;

constexpr double kSphere = 0.6;           // m
constexpr double kReach = kSphere + 0.1;  // m, with the surface's radius
constexpr double kStep = 0.01;            // m, no node moves further in a step
constexpr int kSteps = 60;
constexpr double kSkin = 2.5 * kSteps * kStep;  // m, the lists hold for all steps
constexpr std::size_t kBalls = 40;

/// Balls and a surface whose nodes all move at random, each keeping its direction for a while.
struct Crowd {
  Complex complex;
  std::vector<geometry::Sphere> spheres;
  std::vector<Vec3> x;
  std::vector<Vec3> velocity;
  Random random;

  Crowd(const Complex& ground, std::uint64_t seed) : complex(ground), x(ground.x), random(seed) {
    for (std::size_t i = 0; i < kBalls; ++i) {
      spheres.push_back({{id_at<NodeId>(x.size())}, kSphere});
      x.push_back({random.uniform(0.0, 4.0), random.uniform(0.0, 4.0), random.uniform(0.2, 1.2)});
    }
    velocity.resize(x.size());
    turn();
  }

  Surface surface() const { return Surface(complex.cylinders, complex.facets, x.size()); }

  void turn() {
    for (Vec3& v : velocity) v = random.uniform(0.0, kStep) * random.direction();
  }
  void move(int step) {
    if (step % 10 == 0) turn();
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += velocity[i];
  }
};

std::vector<Complex> grounds() {
  Random random(5);
  const auto wide = [](const Vec3& x) { return Vec3(4.0 * x); };
  return {sheet(4), roughened(sheet(4), 1.0, 0.3, random), net(4), sheet_with_fin(0.2, random),
          mapped(sheet(1), wide)};
}

double distance_to(const Surface& surface, CellId cell, const Vec3& point, Positions x) {
  const Feature nearest = closest_feature(surface, surface.feature_of(cell), point, x);
  return foot_on(surface, nearest, point, x).distance;
}

TEST(DeferredPairs, FindsEveryCellInRangeWhileAllNodesMove) {
  for (const Complex& ground : grounds()) {
    Crowd crowd(ground, 1);
    const Surface surface = crowd.surface();
    ThreadPool pool;
    Neighbours neighbours(crowd.spheres, surface, kSkin);
    neighbours.update(crowd.x, pool);
    DeferredPairs deferred_pairs(surface);
    deferred_pairs.rebuild(neighbours.cells());
    std::vector<DeferredPairs::NextCheck> next_check(neighbours.near_cells().size());
    std::vector<CellId> found;
    std::size_t looked_at = 0;
    for (int step = 0; step < kSteps; ++step) {
      crowd.move(step);
      deferred_pairs.begin_step({crowd.x, crowd.velocity, crowd.velocity, kStep});
      for (std::size_t i = 0; i < next_check.size(); ++i) {
        const auto& pair = neighbours.sphere_structures()[i];
        const auto& near = neighbours.near_cells()[i];
        const Vec3& centre =
            crowd.x[index_of(crowd.spheres[static_cast<std::size_t>(pair.a)].nodes[0])];
        found.clear();
        if (!deferred_pairs.is_deferred(next_check[i]))
          deferred_pairs.find(near, centre, kReach, crowd.x, next_check[i], found);
        looked_at += found.size();

        ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (const CellId cell : neighbours.cells().subspan(near.first, near.count)) {
          if (std::find(found.begin(), found.end(), cell) != found.end()) continue;
          ASSERT_GE(distance_to(surface, cell, centre, crowd.x), kReach) << "step " << step;
        }
      }
    }
    EXPECT_LT(looked_at, static_cast<std::size_t>(kSteps) * neighbours.cells().size() / 2);
    EXPECT_GT(looked_at, static_cast<std::size_t>(kSteps));
  }
}

TEST(DeferredPairs, LooksAtEveryCellWhereTheWayIsNotKnown) {
  Crowd crowd(sheet(4), 2);
  const Surface surface = crowd.surface();
  const std::vector<CellId> cells = all_cells(surface);
  DeferredPairs deferred_pairs(surface);
  deferred_pairs.rebuild(cells);
  const NearCells all{0, static_cast<std::uint32_t>(cells.size())};
  std::vector<CellId> found;
  deferred_pairs.begin_step({crowd.x, {}, {}, kStep});
  DeferredPairs::NextCheck next_check;
  deferred_pairs.find(all, Vec3(2.2, 2.3, 5.0), kReach, crowd.x, next_check, found);
  ASSERT_TRUE(found.empty());
  deferred_pairs.begin_step({crowd.x, {}, {}, kStep});
  ASSERT_TRUE(deferred_pairs.is_deferred(next_check));

  deferred_pairs.begin_step({crowd.x, {}, {}});

  EXPECT_FALSE(deferred_pairs.is_deferred(next_check));
  deferred_pairs.find(all, Vec3(2.2, 2.3, 0.3), kReach, crowd.x, next_check, found);
  EXPECT_FALSE(found.empty());
}

/// Forces on all nodes in each step, with the way of the nodes known or not.
std::vector<NodeForces> forces_over(const Complex& ground, double way) {
  Crowd crowd(ground, 3);
  const Surface surface = crowd.surface();
  ThreadPool pool;
  Neighbours neighbours(crowd.spheres, surface, kSkin);
  neighbours.update(crowd.x, pool);
  SurfaceContacts contacts(surface);
  std::vector<SphereBody> balls;
  for (const auto& sphere : crowd.spheres)
    balls.push_back({sphere.nodes[0], kSphere, MaterialId{0}});
  contacts.rebuild(neighbours.sphere_structures(), neighbours.near_cells(), neighbours.cells(),
                   balls, std::vector<MaterialId>(surface.structure_count(), MaterialId{0}),
                   MaterialPairs({{1e6, 0.5, 0.4}}));
  std::vector<NodeForces> forces;
  for (int step = 0; step < kSteps; ++step) {
    crowd.move(step);
    contacts.advance({crowd.x, crowd.velocity, crowd.velocity, way}, 1e-3, pool);
    forces.emplace_back(crowd.x.size());
    contacts.add_forces(forces.back(), pool);
  }
  return forces;
}

TEST(SurfaceContacts, PushTheSameToTheLastBitWhetherCellsAreDeferredOrNot) {
  for (const Complex& ground : grounds()) {
    const auto looked_at = forces_over(ground, std::numeric_limits<double>::infinity());
    const auto deferred = forces_over(ground, kStep);

    double largest = 0.0;
    for (std::size_t step = 0; step < looked_at.size(); ++step) {
      for (std::size_t i = 0; i < looked_at[step].force.size(); ++i) {
        ASSERT_EQ(looked_at[step].force[i], deferred[step].force[i])
            << "step " << step << " node " << i;
        ASSERT_EQ(looked_at[step].torque[i], deferred[step].torque[i]);
        largest = std::max(largest, looked_at[step].force[i].norm());
      }
    }
    EXPECT_GT(largest, 0.0);
  }
}

}  // namespace
}  // namespace plekton::test::deferred_pairs_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_neighbours.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::contact::plane_neighbours_test {
namespace {

using test::Random;

std::vector<geometry::IndexPair> touching(std::span<const SphereBody> balls,
                                          std::span<const Plane> planes, Positions x) {
  std::vector<geometry::IndexPair> pairs;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t p = 0; p < planes.size(); ++p) {
      if (planes[p].height(x[index_of(balls[i].node)]) < balls[i].radius) {
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(p)});
      }
    }
  }
  return pairs;
}

TEST(PlaneNeighbours, ListEveryPairThatTouchesWhileBallsAndPlanesMove) {
  Random random(1);
  const double skin = 0.1;
  std::vector<SphereBody> balls;
  std::vector<Vec3> x;
  for (std::int32_t i = 0; i < 50; ++i) {
    balls.push_back({NodeId{i}, random.uniform(0.05, 0.3), MaterialId{0}});
    x.push_back(random.in_cube(1.0));
  }
  std::vector<Plane> planes;
  for (int p = 0; p < 4; ++p)
    planes.push_back({random.in_cube(0.5), random.direction(), Vec3::Zero(), MaterialId{0}});
  for (const Plane::Form form : {Plane::Form::cylinder, Plane::Form::sphere})
    planes.push_back({.point = random.in_cube(0.2),
                      .normal = Vec3::Zero(),
                      .form = form,
                      .radius = 1.0,
                      .axis = random.direction()});
  PlaneNeighbours neighbours(skin);
  auto built_at = x;
  int rebuilds = 0;
  for (int step = 0; step < 500; ++step) {
    // The balls' owner lets the list expire before one of them has moved by half the skin.
    for (Vec3& position : x) position += random.in_cube(0.01);
    for (Plane& plane : planes) plane.point += random.in_cube(0.01);
    if (step % 50 == 49) planes[1].normal = random.direction();
    double farthest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      farthest = std::max(farthest, (x[i] - built_at[i]).norm());
    if (farthest > 0.5 * skin) neighbours.expire(skin);

    if (neighbours.update(balls, planes, x)) {
      built_at = x;
      ++rebuilds;
    }

    const auto listed = neighbours.pairs();
    ASSERT_TRUE(std::is_sorted(listed.begin(), listed.end()));
    for (const auto& pair : touching(balls, planes, x)) {
      ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), pair))
          << "ball " << pair.a << ", plane " << pair.b;
    }
  }
  EXPECT_LT(rebuilds, 300);
}

TEST(PlaneNeighbours, StayWhileNothingMovesAcrossAPlane) {
  const std::vector<SphereBody> balls{{NodeId{0}, 0.1, MaterialId{0}}};
  const std::vector<Vec3> x{Vec3(0, 0, 0.1)};
  std::vector<Plane> planes{{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}}};
  PlaneNeighbours neighbours(0.1);
  EXPECT_TRUE(neighbours.update(balls, planes, x));

  planes[0].point += Vec3(5, 5, 0.04);

  EXPECT_FALSE(neighbours.update(balls, planes, x));
  planes.push_back({Vec3::Zero(), -Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}});
  EXPECT_TRUE(neighbours.update(balls, planes, x));
  EXPECT_EQ(neighbours.pairs().size(), 2u);
}

}  // namespace
}  // namespace plekton::contact::plane_neighbours_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/deep.hpp"

#include "geometry/closest/segment_triangle.hpp"
#include "geometry/closest/triangle_triangle.hpp"
#include "tests/support/simplex_families.hpp"

#include <ccd/ccd.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace plekton::geometry::deep_test {
namespace {

using Corners = std::span<const Vec3>;

/// How far b has to go along a unit vector until it is beyond a (m).
double depth_along(const Vec3& n, Corners a, Corners b) {
  double front = -std::numeric_limits<double>::infinity();
  double back = std::numeric_limits<double>::infinity();
  for (const Vec3& x : a) front = std::max(front, n.dot(x - a[0]));
  for (const Vec3& x : b) back = std::min(back, n.dot(x - a[0]));
  return front - back;
}

double size_of(Corners a, Corners b) {
  double size = 0.0;
  for (const Vec3& x : a) size = std::max(size, (x - a[0]).norm());
  for (const Vec3& x : b) size = std::max(size, (x - a[0]).norm());
  return size;
}

/// The least depth that a walk over the directions finds: random ones, then smaller and smaller
/// changes of the best.
double sampled_depth(Corners a, Corners b, test::Random& random) {
  Vec3 best = random.direction();
  double least = depth_along(best, a, b);
  for (int trial = 0; trial < 600; ++trial) {
    const double spread = trial < 200 ? 10.0 : std::pow(10.0, -4.0 * (trial - 200) / 400.0);
    const Vec3 n = (best + spread * random.in_cube(1.0)).normalized();
    const double depth = depth_along(n, a, b);
    if (depth < least) {
      least = depth;
      best = n;
    }
  }
  return least;
}

/// The direction takes the cores apart, and no other one does sooner.
void expect_shortest_way_out(Corners a, Corners b, test::Random& random) {
  const double ulps = 1e-15 * size_of(a, b);

  const DeepSeparation found = deep_separation(a, b);

  EXPECT_NEAR(found.direction.norm(), 1.0, 1e-15);
  EXPECT_GE(found.depth, 0.0);
  EXPECT_LE(depth_along(found.direction, a, b), found.depth + ulps);
  EXPECT_LE(found.depth, sampled_depth(a, b, random) + ulps);
}

template <std::size_t kCountA, std::size_t kCountB, class Kernel>
void expect_shortest_ways_out(Kernel kernel) {
  test::SimplexFamilies<kCountA, kCountB> families(1);
  test::Random random(2);
  for (std::size_t f = 0; f < test::kPairFamilies.size(); ++f) {
    SCOPED_TRACE(test::kPairFamilyNames[f]);
    for (int trial = 0; trial < 2000 && !::testing::Test::HasNonfatalFailure(); ++trial) {
      const auto [a, b] = families.draw(test::kPairFamilies[f]);
      if (kernel(a, b).relation == Relation::apart) continue;
      expect_shortest_way_out(a, b, random);
    }
  }
}

TEST(DeepSeparation, IsTheShortestWayOutForTrianglesThatMeet) {
  expect_shortest_ways_out<3, 3>(triangle_triangle);
}

TEST(DeepSeparation, IsTheShortestWayOutForASegmentInATriangle) {
  expect_shortest_ways_out<2, 3>(segment_triangle);
}

TEST(DeepSeparation, KeepsTheSideThatIsAskedFor) {
  const std::array<Vec3, 3> sheet{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const std::array<Vec3, 3> coplanar{Vec3(1, 1, 0), Vec3(5, 1, 0), Vec3(1, 5, 0)};
  const std::array<Vec3, 2> on_line{Vec3(1, 0, 0), Vec3(2, 0, 0)};

  EXPECT_EQ(deep_separation(sheet, coplanar, Vec3(0, 0, 1)).direction, Vec3(0, 0, 1));
  EXPECT_EQ(deep_separation(sheet, coplanar, Vec3(0, 0, -1)).direction, Vec3(0, 0, -1));
  EXPECT_EQ(deep_separation(sheet, coplanar).depth, 0.0);
  EXPECT_EQ(deep_separation(on_line, std::array{Vec3(0, 0, 0), Vec3(9, 0, 0)}).direction.x(), 0.0);
  EXPECT_EQ(deep_separation(std::array{Vec3(1, 1, 1)}, std::array{Vec3(1, 1, 1)}).depth, 0.0);
}

TEST(DeepSeparation, OfASegmentThroughASheetPushesTheNearerEndOut) {
  const std::array<Vec3, 3> sheet{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)};
  const std::array<Vec3, 2> needle{Vec3(0, 0, -1), Vec3(0.1, 0, 3)};

  const DeepSeparation found = deep_separation(sheet, needle);

  EXPECT_EQ(found.direction, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(found.depth, 1.0);
}

void triangle_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const auto& x = *static_cast<const std::array<Vec3, 3>*>(object);
  const Vec3 n(direction->v[0], direction->v[1], direction->v[2]);
  const Vec3& best = *std::max_element(
      x.begin(), x.end(), [&](const Vec3& p, const Vec3& q) { return n.dot(p) < n.dot(q); });
  ccdVec3Set(farthest, best[0], best[1], best[2]);
}

// libccd as a witness that shares no code: the direction that its EPA finds is never a shorter way
// out, and its depth mostly agrees. (The depth alone is no bound: some are 0.2 % too small.)
TEST(DeepSeparation, IsNotBeatenByLibccd) {
  test::SimplexFamilies<3, 3> families(3);
  ccd_t settings;
  CCD_INIT(&settings);
  settings.support1 = settings.support2 = triangle_support;
  settings.max_iterations = 100;
  settings.epa_tolerance = 1e-6;
  int found = 0;
  int agree = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const auto [a, b] = families.draw(test::PairFamily::generic);
    if (triangle_triangle(a, b).relation == Relation::apart) continue;
    ccd_real_t depth = 0.0;
    ccd_vec3_t direction;
    ccd_vec3_t position;
    if (ccdGJKPenetration(&a, &b, &settings, &depth, &direction, &position) != 0) continue;
    ++found;
    const Vec3 n = Vec3(direction.v[0], direction.v[1], direction.v[2]).normalized();

    const double ours = deep_separation(a, b).depth;

    EXPECT_LE(ours, std::min(depth_along(n, a, b), depth_along(-n, a, b)) + 1e-15);
    agree += std::abs(depth - ours) < 0.01 * ours;
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(agree, 9 * found / 10);
}

}  // namespace
}  // namespace plekton::geometry::deep_test

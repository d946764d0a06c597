// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/space_order.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace plekton::geometry::space_order_test {
namespace {

struct Cloud {
  explicit Cloud(std::int32_t count) : order(static_cast<std::size_t>(count)) {
    test::Random random(11);
    for (std::int32_t i = 0; i < count; ++i) {
      x.push_back(random.in_cube(1.0));
      nodes.push_back(NodeId{i});
    }
    std::iota(order.begin(), order.end(), 0);
  }
  std::vector<Vec3> x;
  std::vector<NodeId> nodes;
  std::vector<std::int32_t> order;
};

TEST(SpaceOrder, PutsNeighboursInSpaceNextToEachOther) {
  Cloud cloud(4096);

  order_along_curve(cloud.x, cloud.nodes, cloud.order);

  double way = 0.0;
  for (std::size_t i = 1; i < cloud.order.size(); ++i)
    way += (cloud.x[static_cast<std::size_t>(cloud.order[i])] -
            cloud.x[static_cast<std::size_t>(cloud.order[i - 1])])
               .norm();
  // 16 points along each edge of a cube with edges of length 2: neighbours are some 1/8 apart, two
  // points at random 1.3.
  EXPECT_LT(way / 4095.0, 0.2);
  std::sort(cloud.order.begin(), cloud.order.end());
  for (std::int32_t i = 0; i < 4096; ++i) EXPECT_EQ(cloud.order[static_cast<std::size_t>(i)], i);
}

TEST(SpaceOrder, OfPointsIsThatOfNodesThere) {
  Cloud cloud(500);

  order_along_curve(cloud.x, cloud.nodes, cloud.order);

  EXPECT_EQ(order_along_curve(cloud.x), cloud.order);
}

TEST(SpaceOrder, DoesNotDependOnTheOrderBefore) {
  Cloud cloud(1000);
  std::vector<std::int32_t> backwards(cloud.order.rbegin(), cloud.order.rend());

  order_along_curve(cloud.x, cloud.nodes, cloud.order);
  order_along_curve(cloud.x, cloud.nodes, backwards);

  EXPECT_EQ(backwards, cloud.order);
}

TEST(SpaceOrder, TakesPointsThatCoincideAndNoNumbers) {
  Cloud cloud(1000);
  for (std::size_t i = 0; i < 500; ++i) cloud.x[i] = Vec3::Zero();
  for (std::size_t i = 500; i < 600; ++i)
    cloud.x[i] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

  order_along_curve(cloud.x, cloud.nodes, cloud.order);

  std::sort(cloud.order.begin(), cloud.order.end());
  for (std::int32_t i = 0; i < 1000; ++i) EXPECT_EQ(cloud.order[static_cast<std::size_t>(i)], i);
}

TEST(SpaceOrder, OfNothingIsNothing) {
  Cloud cloud(0);

  order_along_curve(cloud.x, cloud.nodes, cloud.order);

  EXPECT_TRUE(cloud.order.empty());
}

}  // namespace
}  // namespace plekton::geometry::space_order_test

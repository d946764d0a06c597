// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/node_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plekton::apps::yade::node_boxes_test {
namespace {

using geometry::Box;
using geometry::Vec3;

bool holds(const Box& box, const Vec3& point) {
  return (point.array() >= box.lower.array()).all() && (point.array() <= box.upper.array()).all();
}

/// Every chosen point is in exactly one box, and no other point is in any.
void expect_exact(const std::vector<Vec3>& points, const std::vector<bool>& chosen) {
  const std::vector<Box> boxes = boxes_around(points, chosen).boxes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto count = std::count_if(boxes.begin(), boxes.end(),
                                     [&](const Box& b) { return holds(b, points[i]); });
    EXPECT_EQ(count, chosen[i] ? 1 : 0) << i;
  }
}

std::vector<Vec3> grid(int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) points.emplace_back(0.1 * i, 0.1 * j, 0.0);
  return points;
}

TEST(BoxesAround, TakeARowAsOne) {
  const std::vector<Vec3> points = grid(5);
  std::vector<bool> chosen(25, false);
  for (std::size_t i = 0; i < 5; ++i) chosen[i] = true;

  EXPECT_EQ(boxes_around(points, chosen).boxes.size(), 1u);
  EXPECT_TRUE(boxes_around(points, chosen).hold_all);
  expect_exact(points, chosen);
}

TEST(BoxesAround, HoldARimAndNothingWithinIt) {
  const std::vector<Vec3> points = grid(6);
  std::vector<bool> chosen;
  for (const Vec3& x : points)
    chosen.push_back(std::min({x[0], x[1], 0.5 - x[0], 0.5 - x[1]}) < 0.05);

  expect_exact(points, chosen);
  EXPECT_LE(boxes_around(points, chosen).boxes.size(), 12u);
}

TEST(BoxesAround, AreExactForPointsAnywhere) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<Vec3> points;
  std::vector<bool> chosen;
  for (int i = 0; i < 300; ++i) {
    points.emplace_back(place(random), place(random), place(random));
    chosen.push_back(place(random) > 0.3);
  }

  expect_exact(points, chosen);
}

TEST(BoxesAround, DoNotShareAPointWhereRoundingTearsARowApart) {
  std::vector<Vec3> points = grid(4);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] += Vec3(1e-17, -1e-17, 0.0);
  std::vector<bool> chosen(points.size(), true);
  chosen[5] = chosen[10] = false;

  expect_exact(points, chosen);
}

TEST(BoxesAround, LeaveOutWhatIsAtThePlaceOfOneThatIsNotChosen) {
  const NodeBoxes around =
      boxes_around({Vec3::Zero(), Vec3::Zero(), Vec3::Ones()}, {true, false, false});
  EXPECT_TRUE(around.boxes.empty());
  EXPECT_FALSE(around.hold_all);
  EXPECT_TRUE(boxes_around({Vec3::Zero()}, {false}).boxes.empty());
}

}  // namespace
}  // namespace plekton::apps::yade::node_boxes_test

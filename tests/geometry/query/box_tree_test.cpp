// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/box_tree.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::geometry::box_tree_test {
namespace {

std::vector<ThickBox> random_boxes(test::Random& random, std::size_t count) {
  std::vector<ThickBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at = random.in_cube(5.0);
    boxes.push_back({{at, at + Vec3(random.unit(), random.unit(), random.unit())},
                     random.coin() ? 0.0 : random.unit()});
  }
  return boxes;
}

double distance(const Box& a, const Box& b) {
  return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(Vec3::Zero()).norm();
}

void expect_all_near(const BoxTree& tree, const std::vector<ThickBox>& boxes,
                     test::Random& random) {
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 at = random.in_cube(6.0);
    const Box around{at, at + Vec3(random.unit(), 0.0, random.unit())};
    std::vector<std::int32_t> found;
    tree.for_each_near(around, [&](std::int32_t item) { found.push_back(item); });
    std::sort(found.begin(), found.end());

    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const bool is_near = distance(boxes[i].box, around) <= boxes[i].radius;
      const bool is_found =
          std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(i));
      ASSERT_EQ(is_found, is_near) << "box " << i << " of " << boxes.size();
    }
  }
}

TEST(BoxTree, FindsEveryBoxThatIsNearForAnyNumberOfBoxes) {
  test::Random random(1);
  for (const std::size_t count :
       std::initializer_list<std::size_t>{0, 1, 2, 3, 4, 5, 6, 15, 16, 17, 63, 64, 65, 257, 1000}) {
    const auto boxes = random_boxes(random, count);
    BoxTree tree;
    tree.rebuild(boxes);
    EXPECT_EQ(tree.is_empty(), count == 0);
    expect_all_near(tree, boxes, random);
  }
}

TEST(BoxTree, FindsTheNearestItemAndLooksAtFewOthers) {
  test::Random random(3);
  for (const std::size_t count : std::initializer_list<std::size_t>{1, 2, 5, 17, 3000}) {
    const auto boxes = random_boxes(random, count);
    BoxTree tree;
    tree.rebuild(boxes);
    std::size_t looks = 0;
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 at = random.in_cube(6.0);
      const Box from{at, at};
      double least = std::numeric_limits<double>::infinity();
      tree.for_each_nearer(from, least, [&](std::int32_t item) {
        ++looks;
        least = std::min(least, distance(boxes[static_cast<std::size_t>(item)].box, from));
      });
      double nearest = std::numeric_limits<double>::infinity();
      for (const ThickBox& box : boxes) nearest = std::min(nearest, distance(box.box, from));
      ASSERT_EQ(least, nearest);
    }
    EXPECT_LT(looks, 50 * 50);
  }
}

TEST(BoxTree, FindsThemAfterTheyHaveMoved) {
  test::Random random(2);
  BoxTree tree;
  tree.rebuild(random_boxes(random, 300));
  for (int move = 0; move < 5; ++move) {
    const auto boxes = random_boxes(random, 300);
    tree.refit(boxes);
    expect_all_near(tree, boxes, random);
  }
}

TEST(BoxTree, HoldsBoxesInOnePlaceAndOfExtremeCoordinates) {
  for (const double far : {0.0, 1e-300, 1e74}) {
    std::vector<ThickBox> boxes(50, {{Vec3::Constant(-far), Vec3::Constant(far)}, 0.0});
    boxes.resize(70, {{Vec3::Zero(), Vec3::Zero()}, 0.0});
    BoxTree tree;
    tree.rebuild(boxes);
    int found = 0;
    tree.for_each_near({Vec3::Zero(), Vec3::Zero()}, [&](std::int32_t) { ++found; });
    EXPECT_EQ(found, 70);
  }
}

}  // namespace
}  // namespace plekton::geometry::box_tree_test

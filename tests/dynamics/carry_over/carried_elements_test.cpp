// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_elements.hpp"

#include <gtest/gtest.h>

namespace plekton::dynamics::carried_elements_test {
namespace {

/// Four nodes in a row with cylinders between neighbours.
Scene row_of_cylinders() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  for (int i = 0; i < 4; ++i) scene.add_node(Vec3(i, 0, 0));
  for (int i = 0; i < 3; ++i)
    scene.add_cylinder(NodeId{i}, NodeId{i + 1}, 0.1, contact::MaterialId{0});
  return scene;
}

TEST(CarriedElements, LeaveOutWhatBrokeBefore) {
  Scene before = row_of_cylinders();
  before.elements.cylinders.erase(before.elements.cylinders.begin() + 1);
  before.cylinder_materials.pop_back();
  Scene now = row_of_cylinders();

  EXPECT_TRUE(take_elements(before, now));

  ASSERT_EQ(now.elements.cylinders.size(), 2U);
  EXPECT_EQ(now.cylinder_materials.size(), 2U);
  EXPECT_EQ(now.elements.cylinders[1].nodes[0], NodeId{2});
}

TEST(CarriedElements, AreAsTheyAreMadeWhereNothingBroke) {
  const Scene before = row_of_cylinders();
  Scene now = row_of_cylinders();
  EXPECT_FALSE(take_elements(before, now));
  EXPECT_EQ(now.elements.cylinders.size(), 3U);
}

TEST(CarriedElements, OfStructuresThatComeAreAllThere) {
  Scene before = row_of_cylinders();
  before.is_absent.assign(4, true);
  before.elements.cylinders.clear();
  before.cylinder_materials.clear();
  Scene now = row_of_cylinders();
  EXPECT_FALSE(take_elements(before, now));
  EXPECT_EQ(now.elements.cylinders.size(), 3U);
  EXPECT_FALSE(are_same_there(before, now));
  EXPECT_TRUE(are_same_there(now, now));
}

}  // namespace
}  // namespace plekton::dynamics::carried_elements_test

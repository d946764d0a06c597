// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/places_check.hpp"

#include "geometry/base/state_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace plekton::dynamics::places_check_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Scene nodes(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) scene.add_node(Vec3(i, 0, 0));
  return scene;
}

TEST(PlacesCheck, ListsAllPlacesThatAreNone) {
  const SceneChange change{.places = {.nodes = {0, 0, 7}, .spheres = {1}, .planes = {}},
                           .moved_planes = {true}};
  EXPECT_THAT([&] { require_places(nodes(3), nodes(2), change); },
              testing::ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("places.nodes[1] is 0, as of one before"),
                        HasSubstr("places.nodes[2] is 7; there are 2 nodes now"),
                        HasSubstr("places.spheres has 1 entries; expected 0"),
                        HasSubstr("moved_planes has 1 entries; expected 0"))));
}

TEST(PlacesCheck, LetsNodesGoButThoseOfStructures) {
  SceneChange change;
  change.places.nodes = {-1, 0};
  EXPECT_NO_THROW(require_places(nodes(2), nodes(1), change));
  Scene scene = nodes(2);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.1, contact::MaterialId{0});
  const geometry::Surface surface(scene.elements.cylinders, scene.elements.facets, 2);
  EXPECT_NO_THROW(require_same_structures(surface, {0, 1}));
  EXPECT_THROW(require_same_structures(surface, {1, 0}), geometry::StateMismatch);
}

}  // namespace
}  // namespace plekton::dynamics::places_check_test

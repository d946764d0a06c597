// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/contact_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace plekton::dynamics::contact_scene_test {
namespace {

using contact::MaterialId;
using testing::ElementsAre;

/// A sheet of one facet beside a bar and a grain, each of a material of its own.
Scene three_kinds() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}, {2e6, 0.3, 0.5}, {3e6, 0.3, 0.5}};
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 5), Vec3(1, 0, 5)})
    scene.add_node(x);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.1, MaterialId{2});
  scene.add_cylinder(NodeId{3}, NodeId{4}, 0.1, MaterialId{1});
  scene.add_sphere(Vec3(0, 0, 9), 0.2, 2600.0, MaterialId{0});
  return scene;
}

geometry::Surface surface_of(const Scene& scene) {
  return geometry::Surface(scene.elements.cylinders, scene.elements.facets, scene.state.size());
}

TEST(ContactScene, HasTheMaterialOfEachStructureAndGrain) {
  const Scene scene = three_kinds();
  const geometry::Surface surface = surface_of(scene);
  const contact::ContactScene contacts = contact_scene(scene, surface, 0.01, false);
  ASSERT_EQ(surface.structure_count(), 2U);
  EXPECT_EQ(contacts.of_structures[index_of(surface.structure_of(NodeId{0}))], MaterialId{2});
  EXPECT_EQ(contacts.of_structures[index_of(surface.structure_of(NodeId{3}))], MaterialId{1});
  EXPECT_THAT(contacts.of_spheres, ElementsAre(MaterialId{0}));
  EXPECT_EQ(contacts.skin, 0.01);
}

TEST(ContactScene, ChoosesAFifthOfTheSmallestRadiusAsSkinIfNoneIsAskedFor) {
  const Scene scene = three_kinds();
  const geometry::Surface surface = surface_of(scene);
  EXPECT_DOUBLE_EQ(contact_scene(scene, surface, 0.0, false).skin, 0.2 * 0.2);
}

TEST(ContactScene, HasPlacesAtRestOnlyWhereStructuresMayTouchThemselves) {
  const Scene scene = three_kinds();
  const geometry::Surface surface = surface_of(scene);
  EXPECT_TRUE(contact_scene(scene, surface, 0.0, false).rest.empty());
  EXPECT_EQ(contact_scene(scene, surface, 0.0, true).rest.size(), scene.state.size());
}

TEST(ContactScene, IsOfNoContactsWhereOneStructureIsAloneAndDoesNotTouchItself) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  for (int i = 0; i < 3; ++i) scene.add_node(Vec3(i, 0, 0));
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.1, MaterialId{0});
  scene.add_cylinder(NodeId{1}, NodeId{2}, 0.1, MaterialId{0});
  const geometry::Surface surface = surface_of(scene);
  EXPECT_FALSE(may_touch(scene, surface, false));
  EXPECT_TRUE(may_touch(scene, surface, true));
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  EXPECT_TRUE(may_touch(scene, surface, false));
  const Scene several = three_kinds();
  EXPECT_TRUE(may_touch(several, surface_of(several), false));
}

}  // namespace
}  // namespace plekton::dynamics::contact_scene_test

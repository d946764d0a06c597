// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene_check.hpp"

#include "dynamics/model/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace plekton::dynamics::scene_check_test {
namespace {

using contact::MaterialId;
using testing::HasSubstr;

/// A sphere above a facet with beams at its sides, over a floor: nothing is wrong with it.
Scene sound_scene() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}, {2e6, 0.3, 0.5}};
  scene.add_sphere(Vec3(0.3, 0.3, 0.5), 0.1, 2600.0, MaterialId{0});
  const NodeId a = scene.add_node(Vec3(0.0, 0.0, 0.0), Held::everything);
  const NodeId b = scene.add_node(Vec3(1.0, 0.0, 0.0));
  const NodeId c = scene.add_node(Vec3(0.0, 1.0, 0.0));
  scene.add_facet(a, b, c, 0.01, MaterialId{1});
  scene.add_cylinder(a, b, 0.01, MaterialId{1});
  const BeamSection section = circular_section(0.01, 1e6, 0.3);
  scene.add_beam(a, b, section, 1000.0);
  scene.add_beam(b, c, section, 1000.0);
  scene.add_beam(c, a, section, 1000.0);
  scene.planes.push_back({Vec3(0.0, 0.0, -1.0), Vec3::UnitZ()});
  return scene;
}

std::string problems_of(const Scene& scene) {
  try {
    check(scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SceneCheck, FindsNothingWrongWithASoundScene) {
  EXPECT_EQ(problems_of(sound_scene()), "");
}

TEST(SceneCheck, FindsNothingWrongWithAnEmptyScene) {
  EXPECT_EQ(problems_of(Scene{}), "");
}

TEST(SceneCheck, ListsEveryProblemAtOnce) {
  Scene scene = sound_scene();
  scene.state.position[0].x() = std::numeric_limits<double>::quiet_NaN();
  scene.state.orientation[1].coeffs() *= 2.0;
  scene.properties.held[1] = Held::nothing;
  scene.properties.mass[1] = 0.0;
  scene.elements.spheres[0].radius = -1.0;
  scene.sphere_materials[0] = MaterialId{5};
  scene.bonds[1].length = 0.0;
  scene.materials[1].friction = -0.1;
  scene.planes[0].normal = Vec3(0.0, 0.0, 2.0);
  scene.facet_materials[0] = MaterialId{0};

  const std::string problems = problems_of(scene);

  for (const char* expected :
       {"node 0: its position (nan", "node 1: its orientation is not a unit quaternion",
        "node 1: its mass is 0; attach something that has mass to it, or hold it",
        "sphere 0: its radius is -1", "sphere 0: there is no material 5, only 2 materials",
        "bond 1 (nodes 2, 3): length at rest is 0 m",
        "material 1: its friction coefficient is -0.1",
        "plane 0: its normal (0 0 2) is not a unit vector",
        "cylinder 0: it has material 1, but it is connected to elements of material 0"}) {
    EXPECT_THAT(problems, HasSubstr(expected));
  }
}

/// It would have to move where it touches.
TEST(SceneCheck, RefusesAFlatPlaneThatTurnsAboutAnotherAxisThanItsNormal) {
  Scene scene = sound_scene();
  scene.planes[0].normal = Vec3::UnitZ();
  scene.planes[0].angular_velocity = 2.0;
  scene.planes[0].axis = -Vec3::UnitZ();
  EXPECT_EQ(problems_of(scene), "");

  scene.planes[0].axis = Vec3::UnitX();

  EXPECT_THAT(problems_of(scene), HasSubstr("plane 0: it is flat and turns about (1 0 0), which is "
                                            "not along its normal (0 0 1)"));
}

TEST(SceneCheck, RefusesAFacetWithoutAreaByExactSigns) {
  Scene scene = sound_scene();
  scene.state.position[3] = Vec3(0.3, 0.0, 0.0);

  EXPECT_THAT(problems_of(scene),
              HasSubstr("facet 0 (nodes 1, 2, 3): it has no area: its corners (0 0 0), (1 0 0), "
                        "(0.3   0   0) are on one line; move one of them or delete the facet"));

  // The smallest number there is beside the line is enough.
  scene.state.position[3].y() = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(problems_of(scene), "");

  // Off the axes, where one bit is a question of exact signs.
  const Vec3 direction(0.3, 0.1, 0.7);
  scene.state.position[2] = direction;
  scene.state.position[3] = 0.5 * direction;
  EXPECT_THAT(problems_of(scene), HasSubstr("facet 0 (nodes 1, 2, 3): it has no area"));
  scene.state.position[3].x() = std::nextafter(scene.state.position[3].x(), 1.0);
  EXPECT_EQ(problems_of(scene), "");
}

TEST(SceneCheck, RefusesACylinderWithoutLength) {
  Scene scene = sound_scene();
  const NodeId c = scene.add_node(Vec3(2.0, 0.5, 0.0), Held::everything);
  const NodeId d = scene.add_node(Vec3(2.0, 0.5, 0.0), Held::everything);
  scene.add_cylinder(c, d, 0.01, MaterialId{1});

  EXPECT_THAT(
      problems_of(scene),
      HasSubstr("cylinder 1 (nodes 4, 5): it has no length: both ends are at (  2 0.5   0); "
                "merge the nodes and delete the cylinder, or move one of them"));
}

TEST(SceneCheck, RefusesTwoSpheresOnOneNode) {
  Scene scene = sound_scene();
  scene.add_sphere(Vec3(5.0, 5.0, 5.0), 0.1, 2600.0, MaterialId{0});
  scene.elements.spheres[1].nodes = scene.elements.spheres[0].nodes;

  EXPECT_THAT(problems_of(scene),
              HasSubstr("sphere 1: its node 0 belongs to sphere 0 as well, and the two would push "
                        "on each other for ever; give the sphere a node of its own"));
}

TEST(SceneCheck, RefusesASphereOnANodeOfAStructure) {
  Scene on_facet = sound_scene();
  on_facet.elements.spheres[0].nodes[0] = NodeId{3};
  Scene on_cylinder = sound_scene();
  const NodeId free_end = on_cylinder.add_node(Vec3(2.0, 0.0, 0.0), Held::everything);
  on_cylinder.add_cylinder(NodeId{2}, free_end, 0.01, MaterialId{1});
  on_cylinder.elements.spheres[0].nodes[0] = free_end;

  EXPECT_THAT(problems_of(on_facet), HasSubstr("sphere 0: its node 3 belongs to facet 0 as well"));
  EXPECT_THAT(problems_of(on_cylinder),
              HasSubstr("sphere 0: its node 4 belongs to cylinder 1 as well"));
}

TEST(SceneCheck, ReportsElementsOfNodesThatDoNotExist) {
  Scene scene = sound_scene();
  scene.elements.spheres[0].nodes[0] = NodeId{-1};
  scene.elements.cylinders[0].nodes[1] = NodeId{40};

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("sphere 0: there is no node -1"));
  EXPECT_THAT(problems, HasSubstr("cylinder 0 names node 40"));
}

TEST(SceneCheck, ReportsArraysOfDifferentLengths) {
  Scene scene = sound_scene();
  scene.state.velocity.pop_back();
  scene.facet_materials.push_back(MaterialId{0});

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("state.velocity has 3 entries instead of 4"));
  EXPECT_THAT(problems, HasSubstr("facet_materials has 2 entries instead of 1"));
}

TEST(SceneCheck, AllowsANodeWithoutMassThatIsHeld) {
  Scene scene = sound_scene();
  scene.add_node(Vec3::Zero(), Held::everything);

  EXPECT_EQ(problems_of(scene), "");

  scene.add_node(Vec3::Zero(), Held::translation);
  EXPECT_THAT(problems_of(scene), HasSubstr("node 5: its moment of inertia is 0"));
}

TEST(SceneCheck, RefusesSurfacesWithoutThicknessThatQueriesTake) {
  Scene scene = sound_scene();
  scene.elements.facets[0].radius = 0.0;
  scene.elements.cylinders[0].radius = 0.0;

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("facet 0: its radius is 0"));
  EXPECT_THAT(problems, HasSubstr("cylinder 0: its radius is 0"));
}

TEST(SceneCheck, RefusesNumbersOfMaterialsAndContainersThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double ratio : {-1.0, 0.51, 3.0, kNan}) {
    Scene scene = sound_scene();
    scene.materials[1].poisson_ratio = ratio;
    EXPECT_THAT(problems_of(scene), HasSubstr("material 1: its Poisson's ratio is")) << ratio;
  }
  for (const double ratio : {-0.99, 0.0, 0.5}) {
    Scene scene = sound_scene();
    scene.materials[1].poisson_ratio = ratio;
    EXPECT_EQ(problems_of(scene), "") << ratio;
  }
  for (const double widening : {kNan, kInfinity}) {
    Scene scene = sound_scene();
    scene.planes[0].widening = widening;
    EXPECT_THAT(problems_of(scene), HasSubstr("plane 0: its widening is")) << widening;
  }
  Scene scene = sound_scene();
  scene.planes[0].widening = 0.1;
  EXPECT_THAT(problems_of(scene), HasSubstr("plane 0: it is flat and gets wider by 0.1 m/s"));
}

TEST(SceneCheck, WantsAFlagOfAbsenceForEachNodeOrNone) {
  Scene scene = sound_scene();
  scene.is_absent.assign(3, false);
  EXPECT_EQ(problems_of(scene), "is_absent has 3 entries instead of 4");

  scene.is_absent.assign(4, false);
  EXPECT_EQ(problems_of(scene), "");
}

TEST(SceneCheck, RefusesStartsOfLoadsThatAreNoPlaces) {
  const Vec3 nowhere(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  Scene scene = sound_scene();
  PrescribedMotion motion;
  motion.nodes = {NodeId{1}};
  motion.start = {nowhere};
  scene.loads.motions.push_back(motion);
  PlaneMotion plane;
  plane.start = nowhere;
  scene.loads.plane_motions.push_back(plane);
  SurfacePressure pressure;
  pressure.facets = {geometry::FaceId{0}};
  pressure.start_volume = 0.0;
  scene.loads.pressures.push_back(pressure);

  EXPECT_THAT(problems_of(scene),
              testing::AllOf(HasSubstr("prescribed motion 0: its place at the start (  0 nan   0)"),
                             HasSubstr("motion of a plane 0: its point at the start (  0 nan   0)"),
                             HasSubstr("its volume at the start is 0 m3; it must be positive")));
}

}  // namespace
}  // namespace plekton::dynamics::scene_check_test

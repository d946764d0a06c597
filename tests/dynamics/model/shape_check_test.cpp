// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/shape_check.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

namespace plekton::dynamics::shape_check_test {
namespace {

using contact::MaterialId;
using test::Random;
using testing::IsEmpty;
using testing::StartsWith;

std::string problems_of(const Scene& scene) {
  std::ostringstream text;
  list_shape_problems(scene, text);
  return text.str();
}

Scene facet_between(const std::array<Vec3, 3>& corners) {
  Scene scene;
  for (const Vec3& corner : corners) scene.add_node(corner);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, MaterialId{0});
  return scene;
}

/// On a lattice of whole numbers the area vector is exact, and so is its product with 2^60 or
/// 2^-60.
TEST(ShapeCheck, RefusesAFacetWhereItsAreaVectorIsExactlyZero) {
  Random random(51);
  int without_area = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) corner = random.on_lattice(-1, 1);
    const bool has_area = !(corners[1] - corners[0]).cross(corners[2] - corners[0]).isZero(0.0);
    without_area += !has_area;
    const double size = random.coin() ? 0x1p60 : 0x1p-60;
    for (Vec3& corner : corners) corner *= size;

    const std::string problems = problems_of(facet_between(corners));

    if (has_area)
      EXPECT_THAT(problems, IsEmpty());
    else
      EXPECT_THAT(problems, StartsWith("facet 0 (nodes 0, 1, 2): it has no area: its corners ("));
  }
  EXPECT_GT(without_area, 300);
}

TEST(ShapeCheck, PassesOverElementsThatAreOtherProblems) {
  const Vec3 point(1, 2, 3);
  Scene scene = facet_between({point, point, point});
  EXPECT_THAT(problems_of(scene), testing::Not(IsEmpty()));

  for (const double far :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e76}) {
    scene.state.position[2].y() = far;
    EXPECT_THAT(problems_of(scene), IsEmpty()) << far;
  }
  scene.state.position[2] = point;
  auto& nodes = scene.elements.facets[0].nodes;
  for (const NodeId other : {NodeId{0}, NodeId{3}, NodeId{-1}}) {
    nodes[2] = other;
    EXPECT_THAT(problems_of(scene), IsEmpty()) << static_cast<std::int32_t>(other);
  }

  scene.elements.facets.clear();
  scene.facet_materials.clear();
  scene.add_cylinder(NodeId{0}, NodeId{0}, 0.01, MaterialId{0});
  scene.add_cylinder(NodeId{1}, NodeId{3}, 0.01, MaterialId{0});
  scene.elements.spheres.push_back({{NodeId{3}}, 0.01});
  EXPECT_THAT(problems_of(scene), IsEmpty());
  scene.add_cylinder(NodeId{2}, NodeId{1}, 0.01, MaterialId{0});
  EXPECT_EQ(problems_of(scene),
            "cylinder 2 (nodes 2, 1): it has no length: both ends are at (1 2 3); merge the nodes "
            "and delete the cylinder, or move one of them\n");
}

TEST(ShapeCheck, NamesWhoHoldsTheNodeOfASphereFirst) {
  Scene scene = facet_between({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()});
  scene.add_node(Vec3::UnitZ());
  scene.add_cylinder(NodeId{0}, NodeId{3}, 0.01, MaterialId{0});
  scene.add_sphere(2.0 * Vec3::UnitZ(), 0.1, 1000.0, MaterialId{0});  // on node 4
  EXPECT_THAT(problems_of(scene), IsEmpty());
  for (const int node : {4, 0, 3, 4}) scene.elements.spheres.push_back({{NodeId{node}}, 0.1});

  const std::string why =
      " as well, and the two would push on each other for ever; give the sphere a node of its "
      "own\n";
  EXPECT_EQ(problems_of(scene), "sphere 1: its node 4 belongs to sphere 0" + why +
                                    "sphere 2: its node 0 belongs to facet 0" + why +
                                    "sphere 3: its node 3 belongs to cylinder 0" + why +
                                    "sphere 4: its node 4 belongs to sphere 0" + why);
}

}  // namespace
}  // namespace plekton::dynamics::shape_check_test

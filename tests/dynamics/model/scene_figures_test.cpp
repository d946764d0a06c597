// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene_figures.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace plekton::dynamics::scene_figures_test {
namespace {

using contact::MaterialId;
using test::Random;
using testing::ElementsAre;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Spheres of 0.2 and 0.1 m on nodes 0 and 1, a bar of 0.05 m between nodes 2 and 3, a facet of
/// 0.3 m on nodes 4 to 6, and node 7 alone.
Scene of_all_kinds() {
  Scene scene;
  scene.add_sphere(Vec3(0, 0, 0), 0.2, 1000.0, MaterialId{0});
  scene.add_sphere(Vec3(1, 0, 0), 0.1, 1000.0, MaterialId{0});
  for (int i = 2; i < 8; ++i) scene.add_node(Vec3(i, i * i, 0));
  scene.add_cylinder(NodeId{2}, NodeId{3}, 0.05, MaterialId{0});
  scene.add_facet(NodeId{4}, NodeId{5}, NodeId{6}, 0.3, MaterialId{0});
  return scene;
}

TEST(SceneFigures, MeasureMotionByTheSmallestAndTheLargestRadius) {
  Scene scene = of_all_kinds();
  EXPECT_THAT(furthest_in_a_step(scene, largest_radius(scene.elements)),
              ElementsAre(0.2, 0.1, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3));
  EXPECT_EQ(pace_radius(scene.elements), 0.1);  // of the spheres, whatever is thinner
  EXPECT_EQ(thinnest_structure(scene.elements), 0.05);
  EXPECT_EQ(chosen_skin(scene, 0.0), 0.2 * 0.1);
  EXPECT_EQ(chosen_skin(scene, 0.7), 0.7);

  scene.elements.spheres.clear();
  EXPECT_EQ(pace_radius(scene.elements), 0.05);
  scene.elements.cylinders.clear();
  EXPECT_EQ(pace_radius(scene.elements), 0.3);
  scene.elements.facets.clear();
  EXPECT_EQ(pace_radius(scene.elements), kInfinity);
  EXPECT_EQ(thinnest_structure(scene.elements), kInfinity);
  EXPECT_TRUE(std::isfinite(chosen_skin(scene, 0.0)));
  EXPECT_THAT(furthest_in_a_step(scene, largest_radius(scene.elements)), testing::Each(kInfinity));
}

TEST(SceneFigures, HaveABallAroundEachNodeThatBelongsToAnElement) {
  const Scene scene = of_all_kinds();
  const geometry::Surface surface(scene.elements.cylinders, scene.elements.facets,
                                  scene.state.size());

  EXPECT_THAT(node_radii(scene, surface), ElementsAre(0.2, 0.1, 0.05, 0.05, 0.3, 0.3, 0.3, 0.0));
}

/// Nodes 2 and 3 follow a body of 5 kg, node 8.
Scene with_body(Held held) {
  Scene scene = of_all_kinds();
  scene.add_rigid_body(std::vector{NodeId{2}, NodeId{3}},
                       {5.0, Vec3(2.5, 6.5, 0), Mat3::Identity()}, held);
  for (const std::size_t node : {4U, 5U, 6U, 7U}) scene.properties.mass[node] = 2.0;
  scene.properties.held[4] = Held::translation;
  scene.properties.held[5] = Held::along_x | Held::along_z | Held::rotation;
  return scene;
}

TEST(SceneFigures, SeeWhatFollowsABodyAsTheWholeOfIt) {
  const Scene free = with_body(Held::rotation);
  const std::vector<double>& mass = free.properties.mass;
  EXPECT_THAT(contact_masses(free),
              ElementsAre(mass[0], mass[1], 5.0, 5.0, kInfinity, 2.0, 2.0, 2.0, 5.0));
  EXPECT_THAT(free_nodes(free), ElementsAre(true, true, true, true, false, true, true, true, true));
  const geometry::ExclusionGroups groups = rigid_groups(free);
  EXPECT_EQ(groups.group_of(NodeId{2}), groups.group_of(NodeId{3}));
  EXPECT_GE(groups.group_of(NodeId{2}), 0);
  EXPECT_EQ(groups.group_of(NodeId{7}), -1);
  EXPECT_TRUE(rigid_groups(of_all_kinds()).empty());

  Scene fixed = with_body(Held::translation);
  EXPECT_THAT(contact_masses(fixed), ElementsAre(mass[0], mass[1], kInfinity, kInfinity, kInfinity,
                                                 2.0, 2.0, 2.0, kInfinity));
  EXPECT_FALSE(free_nodes(fixed)[2]);
  // A servo presses it on walls, though all of its translation is held or driven.
  fixed.loads.body_servos.push_back({.body = 0, .axis = 2, .force = 1.0});
  EXPECT_TRUE(free_nodes(fixed)[2]);
  EXPECT_TRUE(free_nodes(fixed)[8]);
}

TEST(SceneFigures, HoldWhatMotionsPrescribeAndServosDrive) {
  Scene scene = with_body(Held::about_x);
  scene.loads.motions = {{.nodes = {NodeId{4}, NodeId{8}}, .held = Held::along_y | Held::about_z}};
  scene.loads.body_servos = {{.body = 0, .axis = 0, .force = 1.0},
                             {.body = 0, .axis = 1, .torque = 1.0}};

  const Scene held = held_as_prescribed(scene);

  const std::vector<Held>& now = held.properties.held;
  EXPECT_EQ(now[8], Held::by_body | Held::about_x | Held::along_y | Held::about_z | Held::along_x |
                        Held::about_y);
  EXPECT_EQ(now[4], Held::translation | Held::about_z);
  EXPECT_EQ(now[5], scene.properties.held[5]);
  EXPECT_EQ(held_with_loads(scene), now);
  EXPECT_EQ(scene.properties.held[8], Held::by_body | Held::about_x);
}

/// Both against sums over the components that are free.
TEST(SceneFigures, SumKineticEnergyAndMomentsOverWhatIsFree) {
  Random random(41);
  constexpr double kBefore = 0.3;  // s
  Scene scene;
  double energy = 0.0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < 100; ++i) {
    const auto held = static_cast<Held>(random.integer(0, 127));
    scene.add_node(random.in_cube(1.0), held);
    scene.state.velocity[i] = random.in_cube(1.0);
    scene.state.angular_velocity[i] = random.in_cube(1.0);
    scene.properties.mass[i] = random.uniform(1.0, 2.0);
    scene.properties.inertia[i] = random.uniform(1.0, 2.0);
    for (int k = 0; k < 3; ++k) {
      const double speed = scene.state.velocity[i][k], spin = scene.state.angular_velocity[i][k];
      const auto bits = static_cast<unsigned>(held);
      if ((bits >> k & 1U) == 0) {
        energy += 0.5 * scene.properties.mass[i] * speed * speed;
        moment[k] += scene.properties.mass[i] * (scene.state.position[i][k] - kBefore * speed);
      }
      // The turning of a rigid body is not that of its reference node.
      if ((bits >> (3 + k) & 1U) == 0 && bits < 64)
        energy += 0.5 * scene.properties.inertia[i] * spin * spin;
    }
  }

  EXPECT_NEAR(kinetic_energy(scene.state, scene.properties), energy, 300.0 * kEpsilon * energy);
  // Sums of a hundred numbers of up to 2.6 kg m.
  EXPECT_LT((free_moment(scene.state, scene.properties, kBefore) - moment).norm(),
            300.0 * kEpsilon * 260.0);
}

}  // namespace
}  // namespace plekton::dynamics::scene_figures_test

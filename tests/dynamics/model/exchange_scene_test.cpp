// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/exchange_scene.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace plekton::dynamics::exchange_scene_test {
namespace {

using contact::MaterialId;
using geometry::StateArchive;
using geometry::StateMismatch;
using geometry::StateTree;
using test::Random;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Five nodes, a facet on the first three and two bars.
Scene of_structures() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}, {2e6, 0.3, 0.5}};
  for (int i = 0; i < 5; ++i) scene.add_node(Vec3(i, i * i, 0));
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, MaterialId{0});
  scene.add_cylinder(NodeId{2}, NodeId{3}, 0.02, MaterialId{0});
  scene.add_cylinder(NodeId{3}, NodeId{4}, 0.03, MaterialId{1});
  return scene;
}

struct Moving {
  NodeState state;
  NodeForces forces{0};
};

Moving random_motion(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  Moving moving;
  moving.forces = NodeForces(count);
  for (std::size_t i = 0; i < count; ++i) {
    moving.state.position.push_back(random.in_cube(1.0));
    moving.state.velocity.push_back(random.in_cube(1.0));
    moving.state.angular_velocity.push_back(random.in_cube(1.0));
    moving.state.orientation.push_back(Quat(random.rotation()));
    moving.forces.force[i] = random.in_cube(1.0);
    moving.forces.torque[i] = random.in_cube(1.0);
  }
  return moving;
}

TEST(ExchangedNodes, AreTheSameToTheBit) {
  Moving before = random_motion(71, 20), now = random_motion(72, 20);
  StateTree tree;

  exchange_nodes(StateArchive::writer(tree), before.state, before.forces);
  exchange_nodes(StateArchive::reader(tree), now.state, now.forces);

  EXPECT_EQ(now.state.position, before.state.position);
  EXPECT_EQ(now.state.velocity, before.state.velocity);
  EXPECT_EQ(now.state.angular_velocity, before.state.angular_velocity);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(now.state.orientation[i].coeffs(), before.state.orientation[i].coeffs());
  EXPECT_EQ(now.forces.force, before.forces.force);
  EXPECT_EQ(now.forces.torque, before.forces.torque);

  Moving more = random_motion(73, 21);
  EXPECT_THAT([&] { exchange_nodes(StateArchive::reader(tree), more.state, more.forces); },
              ThrowsMessage<StateMismatch>("the state has 20 nodes, here are 21"));
}

TEST(ExchangedPlanes, TakeThePlacesAndVelocitiesAlone) {
  const contact::Plane floor{.point = Vec3(1, 2, 3),
                             .normal = Vec3::UnitZ(),
                             .velocity = Vec3(4, 5, 6),
                             .material = MaterialId{1}};
  const contact::Plane drum{.point = Vec3(7, 8, 9),
                            .form = contact::Plane::Form::cylinder,
                            .radius = 2.0,
                            .axis = Vec3::UnitY(),
                            .angular_velocity = 3.0,
                            .widening = 0.5};
  std::vector before{floor, drum};
  std::vector<contact::Plane> now{{.point = Vec3::Zero(), .normal = Vec3::UnitX()},
                                  {.point = Vec3::Zero(), .axis = Vec3::UnitX()}};
  StateTree tree;

  exchange_planes(StateArchive::writer(tree), before);
  exchange_planes(StateArchive::reader(tree), now);

  EXPECT_EQ(now[0].point, floor.point);
  EXPECT_EQ(now[0].velocity, floor.velocity);
  EXPECT_EQ(now[1].point, drum.point);
  EXPECT_EQ(now[1].radius, drum.radius);
  EXPECT_EQ(now[1].widening, drum.widening);
  EXPECT_EQ(now[0].normal, Vec3::UnitX());
  EXPECT_EQ(now[0].material, MaterialId{0});
  EXPECT_EQ(now[1].axis, Vec3::UnitX());
  EXPECT_EQ(now[1].angular_velocity, 0.0);

  now.pop_back();
  EXPECT_THAT([&] { exchange_planes(StateArchive::reader(tree), now); },
              ThrowsMessage<StateMismatch>("the state has 2 planes, here are 1"));
}

TEST(ExchangedElements, AreThoseThatAreLeftWithTheirMaterials) {
  Scene before = of_structures();
  before.elements.cylinders.erase(before.elements.cylinders.begin());
  before.cylinder_materials.erase(before.cylinder_materials.begin());
  StateTree tree;
  EXPECT_FALSE(exchange_elements(StateArchive::writer(tree), before));

  Scene now = of_structures();
  EXPECT_TRUE(exchange_elements(StateArchive::reader(tree), now));

  ASSERT_EQ(now.elements.cylinders.size(), 1U);
  EXPECT_EQ(now.elements.cylinders[0].nodes, (std::array{NodeId{3}, NodeId{4}}));
  EXPECT_EQ(now.elements.cylinders[0].radius, 0.03);
  EXPECT_EQ(now.cylinder_materials, std::vector{MaterialId{1}});
  EXPECT_EQ(now.elements.facets.size(), 1U);
  EXPECT_FALSE(exchange_elements(StateArchive::reader(tree), now));  // not once more

  // The facets alone may be others.
  Scene without = now;
  without.elements.facets.clear();
  without.facet_materials.clear();
  EXPECT_TRUE(exchange_elements(StateArchive::reader(tree), without));
}

TEST(ExchangedElements, RefuseNodesAndMaterialsThatAreNone) {
  Scene scene = of_structures();
  StateTree tree;
  exchange_elements(StateArchive::writer(tree), scene);
  const auto refusal_with = [&](const std::string& name, std::size_t place, std::int32_t number) {
    StateTree damaged = tree;
    std::get<std::vector<std::int32_t>>(damaged.arrays.at(name).numbers)[place] = number;
    try {
      exchange_elements(StateArchive::reader(damaged), scene);
    } catch (const StateMismatch& error) {
      return std::string(error.what());
    }
    return std::string();
  };

  EXPECT_THAT(refusal_with("cylinders/nodes", 3, 5), HasSubstr("\"cylinders/nodes\""));
  EXPECT_THAT(refusal_with("facets/nodes", 0, -1), HasSubstr("\"facets/nodes\""));
  EXPECT_THAT(refusal_with("cylinders/material", 1, 2), HasSubstr("\"cylinders/material\""));
  EXPECT_THAT(refusal_with("facets/material", 0, -1), HasSubstr("\"facets/material\""));
  EXPECT_EQ(refusal_with("cylinders/nodes", 3, 0), "");
}

TEST(Nodes, AreThoseFromTheFirstToBeforeTheirCount) {
  constexpr NodeId kLast{std::numeric_limits<std::int32_t>::max()};
  EXPECT_TRUE(are_nodes({}, 0));
  EXPECT_TRUE(are_nodes(std::array{NodeId{0}, NodeId{4}}, 5));
  EXPECT_FALSE(are_nodes(std::array{NodeId{0}, NodeId{5}}, 5));
  EXPECT_FALSE(are_nodes(std::array{NodeId{-1}, NodeId{0}}, 5));
  EXPECT_FALSE(are_nodes(std::array{kLast}, 5));
}

}  // namespace
}  // namespace plekton::dynamics::exchange_scene_test

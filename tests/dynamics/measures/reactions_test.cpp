// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/unbalanced_force.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace plekton::test::reactions_test {
namespace {

using dynamics::ForceAndMoment;

constexpr double kGravity = 9.81;  // m/s²

/// A sphere at rest on a floor, at (1, 0).
Scene resting_sphere() {
  constexpr double kRadius = 0.1;
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}}};
  const double stiffness = 1e6 * kRadius;
  const double mass = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius * 1000.0;
  scene.add_sphere(Vec3(1, 0, kRadius - mass * kGravity / stiffness), kRadius, 1000.0,
                   contact::MaterialId{0});
  return scene;
}

TEST(PlaneReaction, IsTheWeightOfWhatRestsOnThePlaneWithItsMoment) {
  LoadedSimulation simulation = simulation_of(resting_sphere(), 1e-4, Vec3(0, 0, -kGravity));
  simulation.step();
  const double weight = simulation.properties().mass[0] * kGravity;

  const ForceAndMoment reaction = simulation.plane_reaction(0);

  EXPECT_NEAR(reaction.force[2], -weight, 1e-9 * weight);
  EXPECT_NEAR(reaction.moment[1], weight, 1e-9 * weight);  // arm 1 m along x
}

/// A sheet with beams along its sides, all of it in any motion: what acts on a part of its nodes
/// comes from across the section, as what is within cancels (Newton's third law).
TEST(SectionForce, IsAllThatActsOnWhatItCutsOff) {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  const geometry::Mesh mesh = geometry::plane_sheet({0.4, 0.3, 4, 3});
  add_membrane(scene, mesh);
  for (const auto& nodes : mesh.facets)
    scene.add_sheet_facet(nodes, {2e5, 0.3, 0.1, 0.002}, 1000.0);
  Random random(7);
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.velocity[i] = random.in_cube(2.0);
    scene.state.angular_velocity[i] = random.in_cube(20.0);
  }
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-6);
  for (int i = 0; i < 200; ++i) simulation.step();
  const std::vector<Vec3> x = simulation.force_positions();
  const Vec3 about(0.1, -0.2, 0.3);
  std::vector<NodeId> cut_off;
  ForceAndMoment expected;
  double size = 0.0;  // N
  for (std::size_t i = 0; i < x.size(); ++i) {
    size += simulation.forces().force[i].norm();
    if (mesh.points[i].x() > 0.05) continue;
    cut_off.push_back(geometry::id_at<NodeId>(i));
    expected.add(x[i] - about, simulation.forces().force[i], simulation.forces().torque[i]);
  }
  ASSERT_GT(cut_off.size(), 4U);
  ASSERT_LT(cut_off.size(), x.size() - 4);

  const ForceAndMoment section = simulation.section_force(cut_off, about);

  // Orientations of before are those of now turned back: to rounding, which stiff beams feel.
  EXPECT_GT(expected.force.norm(), 1e-3 * size);
  EXPECT_LT((section.force - expected.force).norm(), 1e-9 * size);
  EXPECT_LT((section.moment - expected.moment).norm(), 1e-9 * size);
}

TEST(SupportReaction, IsWhatAHeldLumpHangsOnAndItsWeight) {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  const NodeId support = add_lump(scene, Vec3(0, 0, 0));
  const NodeId end = add_lump(scene, Vec3(2, 0, 0));
  scene.properties.held[0] = dynamics::Held::everything;
  scene.add_beam(support, end, dynamics::circular_section(0.05, 1e9, 0.3), 1000.0);
  dynamics::NodalForce load;
  load.nodes = {end};
  load.force = Vec3(0, 0, -5.0);
  scene.loads.forces = {load};
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-6, Vec3(0, 0, -kGravity));
  // Clamped and loaded at the start, the bond does not act yet: the support bears its node alone.
  simulation.step();
  const std::vector<NodeId> nodes{support, end};
  const double weight = simulation.properties().mass[0] * kGravity;

  const ForceAndMoment reaction = simulation.support_reaction(nodes, Vec3(1, 0, 0));

  // The free end is not supported, however it is loaded.
  EXPECT_NEAR(reaction.force[2], -weight, 1e-12 * weight);
  EXPECT_NEAR(reaction.moment[1], -weight, 1e-12 * weight);  // arm -1 m along x
}

TEST(SupportReaction, LeavesOutTheAxesThatAreFree) {
  Scene scene;
  scene.materials = {contact::Material{1e6, 0.5, 0.3}};
  const NodeId node = add_lump(scene, Vec3::Zero());
  scene.properties.held[0] = dynamics::Held::along_z;
  dynamics::NodalForce load;
  load.nodes = {node};
  load.force = Vec3(3.0, 0, 4.0);
  load.torque = Vec3(1.0, 0, 0);
  scene.loads.forces = {load};
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-4);
  simulation.step();

  const ForceAndMoment reaction =
      simulation.support_reaction(std::vector<NodeId>{node}, Vec3::Zero());

  EXPECT_EQ(reaction.force, Vec3(0, 0, 4.0));
  EXPECT_EQ(reaction.moment, Vec3::Zero());
}

TEST(UnbalancedForceRatio, IsSmallAtRestOneInFreeLoadAndZeroWhereNothingActs) {
  LoadedSimulation at_rest = simulation_of(resting_sphere(), 1e-4, Vec3(0, 0, -kGravity));
  LoadedSimulation weightless = simulation_of(resting_sphere(), 1e-4);
  Scene apart = resting_sphere();
  apart.state.position[0][2] = 1.0;
  LoadedSimulation falling = simulation_of(apart, 1e-4, Vec3(0, 0, -kGravity));
  LoadedSimulation floating = simulation_of(apart, 1e-4);
  for (LoadedSimulation* simulation : {&at_rest, &weightless, &falling, &floating})
    simulation->step();

  EXPECT_LT(at_rest.unbalanced_force_ratio(), 1e-9);
  EXPECT_NEAR(weightless.unbalanced_force_ratio(), 1.0, 1e-12);  // the contact alone
  EXPECT_EQ(falling.unbalanced_force_ratio(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(floating.unbalanced_force_ratio(), 0.0);
}

// It was 9e11 at the start of a net that only its weight acts on.
TEST(UnbalancedForceRatio, IsInfiniteWhereWhatIsCarriedMayBeRounding) {
  Scene scene;
  add_lump(scene, Vec3::Zero());
  dynamics::NodeForces forces(1);
  forces.force[0] = Vec3(0, 0, -2.0);
  const dynamics::LoadedNodesView view{scene.state.position, forces, scene.properties,
                                       Vec3::Zero()};

  EXPECT_EQ(dynamics::unbalanced_force_ratio(view, 2e-12), std::numeric_limits<double>::infinity());
  EXPECT_EQ(dynamics::unbalanced_force_ratio(view, 2e-6), 1e6);
}

/// A node moved from the middle of two equal bars: one pulls it and the other pushes it with F, so
/// that 2 F are left on it, and each bar carries F, both when the forces of the step were found.
TEST(UnbalancedForceRatio, CountsWhatBondsCarry) {
  Scene scene;
  for (const double x : {-0.2, 0.0, 0.2}) scene.add_node(Vec3(x, 0, 0), dynamics::Held::everything);
  scene.properties.held[1] =
      dynamics::Held::rotation | dynamics::Held::along_y | dynamics::Held::along_z;
  for (const int a : {0, 1})
    scene.add_beam(NodeId{a}, NodeId{a + 1}, dynamics::bar_section(0.01, 1e8), 1000.0);
  scene.state.position[1].x() = 1e-4;
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-6);
  simulation.step();

  EXPECT_NEAR(simulation.unbalanced_force_ratio(), 2.0, 1e-9);
}

/// A cube of 0.1 m as a rigid body that stands 0.1 mm deep in a floor, and a sphere that it carries
/// as deep.
struct CarriedSphere {
  explicit CarriedSphere(dynamics::Held held) {
    constexpr double kSide = 0.1, kThickness = 0.002, kDepth = 1e-4, kRadius = 0.02;  // m
    const contact::MaterialId stone{0};
    scene.materials = {contact::Material{1e7, 0.5, 0.3}};
    scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), stone}};
    const geometry::Mesh cube = geometry::box_shell({kSide, kSide, kSide});
    double lowest = 0.0, highest = 0.0;
    for (const Vec3& point : cube.points) {
      lowest = std::min(lowest, point.z());
      highest = std::max(highest, point.z());
    }
    const double up = kThickness - kDepth - lowest;
    for (const Vec3& point : cube.points) nodes.push_back(scene.add_node(point + Vec3(0, 0, up)));
    for (const auto& [a, b, c] : cube.facets)
      scene.add_facet(nodes[index_of(a)], nodes[index_of(b)], nodes[index_of(c)], kThickness,
                      stone);
    Vec3 centre = Vec3::Zero();
    for (const NodeId node : nodes)
      centre += scene.state.position[index_of(node)] / static_cast<double>(nodes.size());
    sphere = scene.state.size();
    scene.add_sphere(Vec3(centre.x(), centre.y(), up + highest + kThickness + kRadius - kDepth),
                     kRadius, 2650.0, stone);
    scene.add_rigid_body(nodes, {kMass, centre, 1e-2 * geometry::Mat3::Identity()}, held);
    nodes.push_back(scene.rigid_bodies[0].node);
  }

  static constexpr double kMass = 2.0;  // kg
  Scene scene;
  std::vector<NodeId> nodes;  // of the body
  std::size_t sphere = 0;     // its node
};

TEST(SupportReaction, IsOfARigidBodyThatOfItsReferenceNode) {
  const CarriedSphere free(dynamics::Held::nothing), held(dynamics::Held::everything);
  const Vec3 gravity(0, 0, -kGravity);
  LoadedSimulation of_free = simulation_of(free.scene, 1e-5, gravity);
  LoadedSimulation of_held = simulation_of(held.scene, 1e-5, gravity);
  for (LoadedSimulation* const simulation : {&of_free, &of_held}) simulation->step();
  const double carried = of_held.forces().force[held.sphere].z();
  ASSERT_GT(carried, 0.0);
  ASSERT_GT(of_free.pressing_on(0), 0.0);

  // What is free stands on the floor: no support bears anything.
  const ForceAndMoment reaction = of_free.support_reaction(free.nodes, Vec3::Zero());
  EXPECT_EQ(reaction.force, Vec3(Vec3::Zero()));
  EXPECT_EQ(reaction.moment, Vec3(Vec3::Zero()));
  // What is held bears the sphere and its own weight, each once.
  EXPECT_NEAR(of_held.support_reaction(held.nodes, Vec3::Zero()).force.z(),
              -carried - CarriedSphere::kMass * kGravity, 1e-12 * carried);
}

}  // namespace
}  // namespace plekton::test::reactions_test

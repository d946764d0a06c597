// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_cause.hpp"

#include "dynamics/simulation.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::test::step_cause_test {
namespace {

using dynamics::StepCause;
using dynamics::StepPart;
using Kind = StepPart::Kind;

StepCause cause_of(Scene scene) {
  return simulation_of(std::move(scene), 0.0).critical_cause();
}

TEST(StepCause, OfAChainWithOneShortBondIsThatBond) {
  const auto section = dynamics::circular_section(0.002, 1e8, 0.3);
  Scene scene;
  for (const double x : {0.0, 0.1, 0.2, 0.203, 0.3, 0.4}) scene.add_node(Vec3(x, 0.0, 0.0));
  for (std::int32_t i = 0; i < 5; ++i) scene.add_beam(NodeId{i}, NodeId{i + 1}, section, 1000.0);

  const StepCause cause = cause_of(scene);

  EXPECT_EQ(cause.part.kind, Kind::bond);
  EXPECT_EQ(cause.part.id, 2U);
  EXPECT_TRUE(cause.step.node == NodeId{2} || cause.step.node == NodeId{3});
  EXPECT_GT(cause.share, 0.9);
  EXPECT_LE(cause.share, 1.0);
}

TEST(StepCause, HasTheStepThatIsEstimated) {
  Scene scene = chain(4, 0.4, dynamics::circular_section(0.002, 1e8, 0.3));
  scene.loads.mass_damping = {{{NodeId{0}}, 1e5}};
  const LoadedSimulation simulation = simulation_of(std::move(scene), 0.0);

  const StepCause cause = simulation.critical_cause();

  EXPECT_EQ(cause.step.dt, simulation.critical_step().dt);
  EXPECT_GT(cause.without_gas_and_damping, 1.5 * cause.step.dt);
}

TEST(StepCause, OfAStiffSphereOverALightChainIsTheContactThatMayCome) {
  Scene scene = chain(4, 0.4, dynamics::circular_section(0.002, 1e6, 0.3));
  scene.materials = {{1e9, 0.3, 0.5}};
  for (std::int32_t i = 0; i < 4; ++i) scene.add_cylinder(NodeId{i}, NodeId{i + 1}, 0.002, {});
  scene.add_sphere(Vec3(0.2, 0.0, 0.1), 0.02, 2500.0, {});

  const StepCause cause = cause_of(scene);

  EXPECT_EQ(cause.part.kind, Kind::coming_contacts);
  EXPECT_GT(cause.share, 0.9);
  EXPECT_EQ(cause.part.partner.kind, dynamics::ComingPartner::Kind::balls);
  EXPECT_EQ(cause.part.partner.radius, 0.02);
}

TEST(StepCause, OfALightSphereNamesThePlaneThatIsStiffest) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}, {1e7, 0.3, 0.5}, {1e8, 0.3, 0.5}};
  scene.add_sphere(Vec3(0.1, 0.0, 0.1), 0.02, 2500.0, contact::MaterialId{0});
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{1}},
                  {Vec3::Zero(), Vec3::UnitX(), Vec3::Zero(), contact::MaterialId{2}}};

  const StepCause cause = cause_of(scene);

  EXPECT_EQ(cause.part.kind, Kind::coming_contacts);
  EXPECT_EQ(cause.part.partner.kind, dynamics::ComingPartner::Kind::plane);
  EXPECT_EQ(cause.part.partner.id, 1U);
}

TEST(StepCause, OfAStiffSpringToGroundIsTheSpring) {
  Scene scene = chain(4, 0.4, dynamics::circular_section(0.002, 1e6, 0.3));
  scene.loads.ground_springs = {{{NodeId{3}}, Vec3(0.0, 1e9, 0.0)}};

  const StepCause cause = cause_of(scene);

  EXPECT_EQ(cause.part.kind, Kind::ground_springs);
  EXPECT_EQ(cause.step.node, NodeId{3});
  EXPECT_FALSE(cause.step.rotation);
}

TEST(StepCause, OfASheetIsAFacet) {
  Scene scene;
  const geometry::Mesh mesh = geometry::plane_sheet({0.3, 0.2, 3, 2});
  for (const Vec3& point : mesh.points) scene.add_node(point);
  scene.state.position[5] += Vec3(0.04, 0.03, 0.0);
  for (const auto& facet : mesh.facets)
    scene.add_sheet_facet(facet, dynamics::solid_sheet(0.004, 1e7, 0.3), 1000.0);

  const StepCause cause = cause_of(scene);

  ASSERT_EQ(cause.part.kind, Kind::sheet_facet);
  const auto& nodes = scene.sheet_facets[cause.part.id].nodes;
  EXPECT_NE(std::find(nodes.begin(), nodes.end(), cause.step.node), nodes.end());
  EXPECT_GT(cause.share, 0.25);
}

TEST(StepCause, IsNothingWhereNothingIsStiffAndFree) {
  Scene scene;
  add_lump(scene, Vec3::Zero());

  EXPECT_EQ(cause_of(scene).part.kind, Kind::nothing);
  EXPECT_TRUE(std::isinf(cause_of(scene).step.dt));
}

}  // namespace
}  // namespace plekton::test::step_cause_test

// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of contacts when bonds break.
#include "tests/support/breaking_net.hpp"
#include "tests/support/same_incidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::dynamics::break_contacts_test {
namespace {

using test::BreakingSimulation;
using test::kMesh;
using test::kWire;
using test::kWireRadius;
using test::net_node;
using test::NetOptions;

/// A straight chain along x of held nodes, 0.1 m apart, and a sphere on it.
Scene chain_and_sphere(int bonds, const Vec3& centre, double radius) {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  for (int i = 0; i <= bonds; ++i) {
    scene.add_node(Vec3(kMesh * i, 0.0, 0.0), Held::everything);
    if (i == 0) continue;
    scene.add_beam(NodeId{i - 1}, NodeId{i}, circular_section(kWireRadius, 1e8, 0.3), 1000.0);
    scene.add_cylinder(NodeId{i - 1}, NodeId{i}, kWireRadius, kWire);
  }
  scene.add_sphere(centre, radius, 2000.0, kWire);
  return scene;
}

SimulationOptions with_gravity(double time_step, int threads = 1) {
  SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  options.threads = threads;
  return options;
}

void expect_same_bits(const BreakingSimulation& a, const BreakingSimulation& b, std::size_t node) {
  EXPECT_EQ(a.state().position[node], b.state().position[node]);
  EXPECT_EQ(a.state().velocity[node], b.state().velocity[node]);
  EXPECT_EQ(a.state().angular_velocity[node], b.state().angular_velocity[node]);
  EXPECT_EQ(a.forces().force[node], b.forces().force[node]);
}

TEST(BreakContacts, ASphereThatRollsAlongAChainDoesNotFeelABreakOutOfItsRange) {
  // Rolls with friction over two joints, the broken cylinder next to the one it lies on at first.
  Scene scene = chain_and_sphere(6, Vec3(0.25, 0.0, 0.0598), 0.05);
  scene.state.velocity.back() = Vec3(0.5, 0.0, 0.0);
  BreakingSimulation whole(scene, with_gravity(1e-5));
  BreakingSimulation broken(scene, with_gravity(1e-5));
  const std::size_t sphere = scene.state.size() - 1;
  for (int i = 0; i < 100; ++i) {
    whole.step();
    broken.step();
  }
  ASSERT_GT(std::abs(broken.forces().force[sphere].x()), 0.0);

  broken.break_bond(1);  // 0.1 to 0.2
  broken.break_bond(5);
  for (int i = 0; i < 20000; ++i) {
    whole.step();
    broken.step();
    expect_same_bits(whole, broken, sphere);
    if (HasFailure()) FAIL() << "in step " << i;
  }

  EXPECT_EQ(broken.surface().edge_count(), 4u);
  EXPECT_GT(broken.state().position[sphere].x(), 0.3);  // it has gone over a joint
}

TEST(BreakContacts, ASphereOnAJointKeepsItsForceWhenOneOfTwoCylindersIsLeft) {
  // At the end of what is left: the cap goes on where the joint was.
  const Scene scene = chain_and_sphere(2, Vec3(kMesh, 0.0, 0.0598), 0.05);
  BreakingSimulation simulation(scene, with_gravity(1e-6));
  simulation.step();
  const double before = simulation.forces().force.back().z();

  simulation.break_bond(1);
  simulation.step();

  // 1 us later at most 1e-11 m lower, of 2e-4 m of overlap.
  EXPECT_NEAR(simulation.forces().force.back().z(), before, 1e-6 * before);
  EXPECT_EQ(simulation.contacts().counts().sphere_surface, 1u);
}

/// A facet of held nodes with bonds along its sides, to be torn by the break of bond 1. Its side 0
/// along x stays.
Scene one_facet() {
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.6}};
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.4, 0, 0), Vec3(0.2, 0.3, 0)})
    scene.add_node(x, Held::everything);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    scene.add_beam(NodeId{a}, NodeId{b}, circular_section(kWireRadius, 1e8, 0.3), 1000.0);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, kWireRadius, kWire);
  return scene;
}

/// Slides along x, tears the facet, and slides on: the force on node 3 goes on as it grew before.
void expect_spring_goes_on(const Scene& scene) {
  constexpr double kStep = 1e-6;
  BreakingSimulation simulation(scene, {.time_step = kStep, .motion = {.gravity = Vec3::Zero()}});
  for (int i = 0; i < 1000; ++i) simulation.step();
  const Vec3 before = simulation.forces().force[3];
  simulation.step();
  const Vec3 growth = simulation.forces().force[3] - before;
  ASSERT_LT(before.x(), 0.0);
  ASSERT_NE(growth.x(), 0.0);

  simulation.break_bond(1);
  simulation.step();

  EXPECT_TRUE(simulation.elements().facets.empty());
  EXPECT_LE((simulation.forces().force[3] - before - 2.0 * growth).norm(), 1e-9 * before.norm());
}

TEST(BreakContacts, TheFrictionOfASphereOnARimGoesOnWhenItsFacetIsTorn) {
  Scene scene = one_facet();
  scene.add_sphere(Vec3(0.2, -0.059, 0.0), 0.05, 1000.0, kWire);
  scene.properties.held.back() = Held::everything;
  scene.state.velocity.back() = Vec3(0.01, 0.0, 0.0);

  expect_spring_goes_on(scene);
}

TEST(BreakContacts, TheFrictionOfAWireOnARimGoesOnWhenItsFacetIsTorn) {
  Scene scene = one_facet();
  for (const double z : {-0.1, 0.1}) {
    scene.add_node(Vec3(0.2, -0.019, z), Held::everything);
    scene.state.velocity.back() = Vec3(0.01, 0.0, 0.0);
  }
  scene.add_cylinder(NodeId{3}, NodeId{4}, kWireRadius, kWire);

  expect_spring_goes_on(scene);
}

TEST(BreakContacts, AWireThatSlidesAlongAChainDoesNotFeelABreakOutOfItsRange) {
  Scene scene = chain_and_sphere(6, Vec3(0.0, 0.0, 9.0), 0.05);
  for (const double y : {-0.1, 0.1}) {
    scene.add_node(Vec3(0.27, y, 0.0199), Held::everything);
    scene.state.velocity.back() = Vec3(0.5, 0.0, 0.0);
  }
  const auto wire = static_cast<int>(scene.state.size()) - 2;
  scene.add_cylinder(NodeId{wire}, NodeId{wire + 1}, kWireRadius, kWire);
  BreakingSimulation whole(scene, with_gravity(1e-5));
  BreakingSimulation broken(scene, with_gravity(1e-5));
  for (int i = 0; i < 20000; ++i) {
    if (i == 100) broken.break_bond(1);
    if (i == 10000) broken.break_bond(5);
    whole.step();
    broken.step();
    ASSERT_EQ(whole.forces().force, broken.forces().force) << "in step " << i;
  }

  EXPECT_EQ(broken.surface().cell_count(), 5u);
  EXPECT_GT(broken.state().position.back().x(), 0.35);  // it has gone over a joint
}

TEST(BreakContacts, ASphereFallsThroughTheHoleWhenTheWireBelowItBreaks) {
  // Across a square of 0.2 m, a wire in the middle of it, a ball of 0.08 m on the wire.
  Scene scene;
  scene.materials = {{1e7, 0.5, 0.6}};
  const auto section = circular_section(kWireRadius, 1e8, 0.3);
  const std::array<Vec3, 6> places{Vec3(-0.1, -0.1, 0), Vec3(0, -0.1, 0), Vec3(0.1, -0.1, 0),
                                   Vec3(-0.1, 0.1, 0),  Vec3(0, 0.1, 0),  Vec3(0.1, 0.1, 0)};
  for (const Vec3& place : places) scene.add_node(place, Held::everything);
  const auto wire = [&](int a, int b) {
    scene.add_cylinder(NodeId{a}, NodeId{b}, kWireRadius, kWire);
    return scene.add_beam(NodeId{a}, NodeId{b}, section, 1000.0);
  };
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {2, 5}}) wire(a, b);
  const std::size_t middle = wire(1, 4);
  scene.add_sphere(Vec3(0.0, 0.0, 0.0899), 0.08, 2000.0, kWire);
  BreakingSimulation simulation(scene, with_gravity(1e-5));
  while (simulation.time() < 0.2) simulation.step();
  ASSERT_NEAR(simulation.state().position.back().z(), 0.09, 1e-3);

  simulation.break_bond(middle);
  const double from = simulation.state().position.back().z();
  const double speed = simulation.state().velocity.back().z();
  const double start = simulation.time();
  while (simulation.time() < start + 0.25) simulation.step();

  // Free fall, to first order in the step.
  const double time = simulation.time() - start;
  EXPECT_NEAR(simulation.state().position.back().z(),
              from + speed * time - 0.5 * 9.81 * time * time, 2.0 * 9.81 * time * 1e-5);
  EXPECT_EQ(simulation.contacts().counts().sphere_surface, 0u);
}

/// Spheres deep in a rough membrane or net of held nodes, and a second net across it.
Scene crowded(bool has_facets, bool has_cylinders, std::uint64_t seed) {
  test::Random random(seed);
  Scene scene;
  scene.materials = {{1e6, 0.5, 0.0}};
  test::add_net(scene,
                {.squares = 4,
                 .has_facets = has_facets,
                 .has_cylinders = has_cylinders,
                 .inside = Held::everything,
                 .roughness = 0.01},
                seed);
  for (int k = 0; k < 12; ++k) {
    scene.add_sphere(Vec3(0.04, 0.04, 0.02).cwiseProduct(random.in_cube(5.0)),
                     random.uniform(0.03, 0.09), 2000.0, kWire);
    scene.properties.held.back() = Held::everything;
  }
  const NodeId low = scene.add_node(Vec3(-0.15, -0.13, 0.004), Held::everything);
  const NodeId high = scene.add_node(Vec3(0.14, 0.16, 0.006), Held::everything);
  scene.add_cylinder(low, high, kWireRadius, kWire);
  return scene;
}

double largest(const std::vector<Vec3>& vectors) {
  double largest = 0.0;
  for (const Vec3& vector : vectors) largest = std::max(largest, vector.norm());
  return largest;
}

TEST(BreakContacts, ForcesAreThoseOfASceneOfWhatIsLeft) {
  // Friction is 0: a fresh scene has no history. Both add up the same terms in another order.
  for (const auto& [has_facets, has_cylinders] :
       {std::pair{false, true}, {true, true}, {true, false}}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      test::Random random(100 + seed);
      const Scene scene = crowded(has_facets, has_cylinders, seed);
      BreakingSimulation simulation(scene,
                                    {.time_step = 1e-6, .motion = {.gravity = Vec3::Zero()}});
      simulation.step();
      for (int breaks = 0; breaks < 12; ++breaks) {
        simulation.break_bond(random.index(scene.bonds.size()));
        simulation.step();

        BreakingSimulation fresh(test::scene_left(simulation, scene),
                                 {.time_step = 1e-6, .motion = {.gravity = Vec3::Zero()}});
        fresh.step();

        test::expect_same_incidence(simulation.surface(), fresh.surface());
        const double scale = largest(fresh.forces().force);
        ASSERT_GT(scale, 0.0);
        for (std::size_t i = 0; i < scene.state.size(); ++i) {
          EXPECT_LE((simulation.forces().force[i] - fresh.forces().force[i]).norm(), 1e-12 * scale);
          EXPECT_LE((simulation.forces().torque[i] - fresh.forces().torque[i]).norm(),
                    1e-12 * scale * kMesh);
        }
        EXPECT_NEAR(simulation.contacts().elastic_energy(), fresh.contacts().elastic_energy(),
                    1e-12 * fresh.contacts().elastic_energy());
        if (HasFailure()) FAIL() << "seed " << seed << ", break " << breaks;
      }
    }
  }
}

TEST(BreakContacts, BreakingAllBondsInAnyOrderLeavesTheIncidenceOfASurfaceBuiltAnew) {
  for (const bool has_facets : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      test::Random random(seed);
      Scene scene;
      scene.materials = {{1e6, 0.5, 0.5}};
      test::add_net(scene, {.squares = 3, .has_facets = has_facets, .has_cylinders = !has_facets},
                    seed);
      for (int k = 0; k < 5; ++k)
        scene.add_sphere(Vec3(0.1, 0.1, 0.0).cwiseProduct(random.in_cube(1.0)) +
                             Vec3(0.0, 0.0, 0.055 + 0.11 * k),
                         0.05, 1000.0, kWire);
      SimulationOptions options;
      options.motion.gravity = Vec3(0.0, 0.0, -9.81);
      BreakingSimulation simulation(scene, options);
      std::vector<std::size_t> order(scene.bonds.size());
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[random.index(i)]);

      for (const std::size_t bond : order) {
        simulation.break_bond(bond);
        for (int k = 0; k < 50; ++k) simulation.step();
        const auto& elements = simulation.elements();
        test::expect_same_incidence(
            simulation.surface(),
            geometry::Surface(elements.cylinders, elements.facets, scene.state.size()));
        ASSERT_FALSE(HasFailure()) << "seed " << seed << ", bond " << bond;
      }

      EXPECT_EQ(simulation.surface().cell_count(), 0u);
      EXPECT_EQ(simulation.contacts().counts().sphere_surface, 0u);
    }
  }
}

}  // namespace
}  // namespace plekton::dynamics::break_contacts_test

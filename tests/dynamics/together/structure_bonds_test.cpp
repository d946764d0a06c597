// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/free_collision.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

/// Structures that are glued to each other at the start and torn apart: no gravity, nothing held.
namespace plekton::dynamics::structure_bonds_test {
namespace {

using namespace test::free_bodies;
using contact::AnyLaw;
using contact::CohesiveFrictional;
using test::NamedLaw;

constexpr double kModulus = 1e7;     // Pa
constexpr double kStrength = 2.5e5;  // Pa: 100 N for a bond, which stretches by 0.5 mm

const std::vector<NamedLaw> kGlues{
    {"Fragile", test::with<CohesiveFrictional>({kStrength, kStrength, 0.0})},
    {"Ductile", test::with<CohesiveFrictional>({kStrength, kStrength, 5e-4})},
    {"Rolling", test::with<CohesiveFrictional>({kStrength, kStrength, 0.0}, {0.3, 0.3, 0.1, 0.1})}};

struct NamedBody {
  const char* name;
  Body (*make)();
};
const std::vector<NamedBody> kBodies{
    {"Chain", chain}, {"Sheet", sheet}, {"Tetrahedron", tetrahedron}, {"Shell", shell}};

/// How the upper body leaves.
struct Leaving {
  const char* name;
  Vec3 velocity;   ///< m/s
  double turning;  ///< rad/s, about the y axis
};
const std::vector<Leaving> kLeavings{{"Up", Vec3(0.0, 0.0, 3.0), 0.0},
                                     {"Sideways", Vec3(4.0, 2.0, 1.0), 0.0},
                                     {"Peeling", Vec3(0.0, 0.0, 0.5), -40.0}};

struct Case {
  NamedLaw law;
  NamedBody lower;
  NamedBody upper;
  Leaving leaving;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const NamedLaw& law : kGlues) {
    for (std::size_t i = 0; i < kBodies.size(); ++i) {
      for (std::size_t j = i; j < kBodies.size(); ++j) {
        for (const Leaving& leaving : kLeavings)
          cases.push_back({law, kBodies[i], kBodies[j], leaving});
      }
    }
  }
  return cases;
}

/// Mean of the nodes that are furthest along z, up (1) or down (-1).
Vec3 extreme_point(const Body& body, double side) {
  double most = side * body.x[0].z();
  for (const Vec3& x : body.x) most = std::max(most, side * x.z());
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const Vec3& x : body.x) {
    if (side * x.z() < most) continue;
    sum += x;
    count += 1.0;
  }
  return sum / count;
}

/// The upper body lies on the lower one, a hundredth of the radius deep.
Scene scene_of(const Case& item) {
  const Body lower = item.lower.make(), upper = item.upper.make();
  const Vec3 turns(0.0, 0.0, 1.1);
  const Vec3 above(1.3e-3, 0.9e-3, 1.99 * kRadius);
  Scene scene;
  scene.materials = {{kModulus, 0.3, 0.6}};
  add(scene, lower, Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  const std::size_t first = scene.state.size();
  add(scene, upper, turns,
      extreme_point(lower, 1.0) + above -
          Eigen::AngleAxisd(turns.z(), Vec3::UnitZ()) * extreme_point(upper, -1.0),
      item.leaving.velocity);
  const Vec3 spin = item.leaving.turning * Vec3::UnitY();
  for (std::size_t i = first; i < scene.state.size(); ++i) {
    const Vec3 arm = scene.state.position[i] - scene.state.position[first];
    scene.state.velocity[i] += spin.cross(arm);
    scene.state.angular_velocity[i] = spin;
  }
  return scene;
}

contact::PairProperties<AnyLaw> properties_of(const Case& item) {
  return {{{kMaterial, kMaterial}, item.law.properties}};
}

Simulation simulation_of(const Case& item, double time_step, int threads = 1) {
  return Simulation(
      scene_of(item),
      {.time_step = time_step, .motion = {.gravity = Vec3::Zero()}, .threads = threads},
      contact::any_law(properties_of(item)));
}

std::size_t bonds_in(const Simulation& simulation) {
  return simulation.contacts().structure_bond_count();
}

class StructureBonds : public testing::TestWithParam<Case> {};

TEST_P(StructureBonds, KeepMomentaAndTheBalanceOfEnergyAsTheyBreak) {
  const Case& item = GetParam();
  Simulation simulation = simulation_of(item, 0.1 * simulation_of(item, 0.0).time_step());
  const auto before = test::momenta_of(simulation);
  simulation.step();
  const double initial = simulation.energy().initial;
  const std::size_t formed = bonds_in(simulation);
  double worst_linear = 0.0, worst_angular = 0.0, worst_closure = 0.0, most = 0.0;
  while (simulation.time() < 0.02) {
    simulation.step();
    const auto now = test::momenta_of(simulation);
    worst_linear = std::max(worst_linear, (now.linear - before.linear).norm());
    worst_angular = std::max(worst_angular, (now.angular - before.angular).norm());
    const Energy e = simulation.energy();
    worst_closure = std::max(worst_closure, e.closure());
    most = std::max(most, e.kinetic + e.contact_elastic + e.bond_elastic);
  }

  EXPECT_GT(formed, 0u);
  EXPECT_LT(bonds_in(simulation), formed);
  EXPECT_LE(worst_linear, 1e-10 * before.linear.norm());
  EXPECT_LE(worst_angular, 1e-10 * before.angular.norm());
  EXPECT_LE(worst_closure, 5e-3);
  EXPECT_LE(most, (1.0 + 1e-3) * initial);
}

TEST_P(StructureBonds, GoOnOnWhatIsLeftOfStructuresThatBreak) {
  Simulation simulation =
      simulation_of(GetParam(), 0.1 * simulation_of(GetParam(), 0.0).time_step());
  const auto before = test::momenta_of(simulation);
  for (int step = 0; step < 30; ++step) simulation.step();
  simulation.break_bond(1);
  simulation.break_bond(simulation.scene().bonds.size() - 2);
  double worst_closure = 0.0;
  while (simulation.time() < 0.005) {
    simulation.step();
    worst_closure = std::max(worst_closure, simulation.energy().closure());
  }

  const auto after = test::momenta_of(simulation);
  EXPECT_LE((after.linear - before.linear).norm(), 1e-10 * before.linear.norm());
  EXPECT_LE((after.angular - before.angular).norm(), 1e-10 * before.angular.norm());
  EXPECT_LE(worst_closure, 5e-3);
}

TEST_P(StructureBonds, AreTheSameToTheLastBitForAnyNumberOfThreads) {
  const Case& item = GetParam();
  const double time_step = 0.3 * simulation_of(item, 0.0).time_step();
  Simulation one = simulation_of(item, time_step);
  Simulation two = simulation_of(item, time_step, 2);
  Simulation four = simulation_of(item, time_step, 4);
  for (int step = 0; step < 200; ++step) {
    one.step();
    two.step();
    four.step();
  }

  EXPECT_EQ(one.state().position, two.state().position);
  EXPECT_EQ(one.state().position, four.state().position);
  EXPECT_EQ(one.state().angular_velocity, four.state().angular_velocity);
  EXPECT_EQ(one.energy().friction, four.energy().friction);
}

std::string name_of(const testing::TestParamInfo<Case>& item) {
  return std::string(item.param.law.name) + item.param.upper.name + "Leaves" +
         item.param.lower.name + item.param.leaving.name;
}

INSTANTIATE_TEST_SUITE_P(Of, StructureBonds, testing::ValuesIn(all_cases()), name_of);

}  // namespace
}  // namespace plekton::dynamics::structure_bonds_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/yielding_bonds.hpp"

#include "dynamics/scene_check.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/beam_stiffness.hpp"
#include "tests/support/yielding_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace plekton::test::yielding_bonds_test {
namespace {

using dynamics::BondStrength;
using dynamics::Simulation;
using dynamics::WireCurve;

std::size_t broken_bonds(const Simulation& simulation) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < simulation.bonds().size(); ++i)
    count += simulation.bonds().is_broken(i);
  return count;
}

Simulation simulation_of(Scene scene, int threads = 1, double time_step = 0.0) {
  dynamics::SimulationOptions options;
  options.threads = threads;
  options.time_step = time_step;
  return Simulation(std::move(scene), options);
}

struct Momenta {
  Vec3 linear = Vec3::Zero();   // kg m/s
  Vec3 angular = Vec3::Zero();  // kg m²/s
};

Momenta momenta(const Simulation& simulation) {
  Momenta sum;
  const dynamics::NodeState& state = simulation.state();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 momentum = simulation.properties().mass[i] * state.velocity[i];
    sum.linear += momentum;
    sum.angular += state.position[i].cross(momentum) +
                   simulation.properties().inertia[i] * state.angular_velocity[i];
  }
  return sum;
}

void expect_balances(Scene scene) {
  const double size = 4.0 * kLatticeSpacing;
  double scale = 0.0;
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scale += scene.properties.mass[i] * scene.state.velocity[i].norm();
  Simulation simulation = simulation_of(std::move(scene), 1, 2e-5);
  const Momenta before = momenta(simulation);

  double lost = 0.0;
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    EXPECT_GE(simulation.energy().bond_dissipated, lost);
    lost = simulation.energy().bond_dissipated;
  }

  const Momenta after = momenta(simulation);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-10 * scale);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * scale * size);
  EXPECT_GT(broken_bonds(simulation), 5U);
  EXPECT_LT(broken_bonds(simulation), simulation.bonds().size());
  EXPECT_GT(lost, 0.1 * simulation.energy().initial);
  EXPECT_LT(simulation.energy().closure(), 5e-4);  // of second order in the step
}

TEST(YieldingBonds, KeepBothMomentaAndAccountForTheEnergyAsBeamsBreak) {
  expect_balances(yielding_beams());
}

TEST(YieldingBonds, KeepBothMomentaAndAccountForTheEnergyAsWiresBreak) {
  expect_balances(yielding_wires());
}

double closure_after(Scene scene, double time_step, int steps) {
  Simulation simulation = simulation_of(std::move(scene), 1, time_step);
  for (int i = 0; i < steps; ++i) simulation.step();
  return simulation.energy().closure();
}

TEST(YieldingBonds, AccountForTheEnergyToTheSecondOrderOfTheStepWhileTheyYield) {
  Scene scene = yielding_beams();
  std::get<BondStrength>(scene.bond_laws[0].law).rupture_strain = BondStrength::kNever;
  constexpr double kStep = 4e-5;  // s

  const double coarse = closure_after(scene, kStep, 400);
  const double fine = closure_after(scene, kStep / 4.0, 1600);

  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 8.0);
}

/// The leapfrog works with the mean of the forces at both ends of a step: so does what is lost.
TEST(YieldingBonds, AccountForTheEnergyOfAWireThatYieldsAndBreaksToRounding) {
  const dynamics::WireCurve curve{{{0.004, 120.0}, {0.02, 160.0}, {0.05, 90.0}}};
  Scene scene = chain(1, kLatticeSpacing, dynamics::wire_section(0.01, curve));
  scene.properties.held = {dynamics::Held::everything, dynamics::Held::rotation};
  scene.bond_laws = {{curve, {0}}};
  scene.state.velocity[1] = Vec3(12.0, 0.0, 0.0);
  Simulation simulation = simulation_of(std::move(scene), 1, 1e-4);

  while (broken_bonds(simulation) == 0) {
    simulation.step();
    EXPECT_LT(std::abs(simulation.energy().closure_error()), 1e-14 * simulation.energy().initial);
  }

  EXPECT_GT(simulation.energy().bond_dissipated, 0.1 * simulation.energy().initial);
}

TEST(YieldingBonds, GiveTheSameBitsForAnyNumberOfThreads) {
  for (const bool as_wires : {false, true}) {
    Simulation one = simulation_of(as_wires ? yielding_wires() : yielding_beams());
    for (int i = 0; i < 1500; ++i) one.step();
    for (const int threads : {2, 4}) {
      Simulation other = simulation_of(as_wires ? yielding_wires() : yielding_beams(), threads);
      for (int i = 0; i < 1500; ++i) other.step();

      for (std::size_t i = 0; i < other.state().size(); ++i) {
        EXPECT_EQ(one.state().position[i], other.state().position[i]);
        EXPECT_EQ(one.state().angular_velocity[i], other.state().angular_velocity[i]);
      }
      EXPECT_EQ(one.energy().bond_dissipated, other.energy().bond_dissipated);
      EXPECT_GT(broken_bonds(other), 0U);
    }
  }
}

/// What has yielded and what it has taken is in the state, of beams and of wires.
TEST(YieldingBonds, GoOnFromAStateToTheLastBit) {
  for (const Scene& scene : {yielding_beams(), yielding_wires()}) {
    Simulation whole = simulation_of(scene), resumed = simulation_of(scene);
    for (int i = 0; i < 500; ++i) whole.step();
    EXPECT_GT(whole.energy().bond_dissipated, 0.0);  // some have yielded
    resumed.restore(whole.snapshot());
    EXPECT_EQ(resumed.energy().bond_dissipated, whole.energy().bond_dissipated);

    for (Simulation* const simulation : {&whole, &resumed})
      for (int i = 0; i < 1000; ++i) simulation->step();

    EXPECT_EQ(dynamics::state_hash(resumed), dynamics::state_hash(whole));
    EXPECT_GT(broken_bonds(whole), 0U);
    for (std::size_t i = 0; i < whole.bonds().size(); ++i)
      EXPECT_EQ(resumed.yielding_bonds().plastic_strain(i),
                whole.yielding_bonds().plastic_strain(i))
          << i;
  }
}

TEST(YieldingBonds, TellWhichBrokeInTheStep) {
  Simulation simulation = simulation_of(yielding_beams());
  std::vector<std::size_t> told;
  for (int i = 0; i < 1500; ++i) {
    simulation.step();
    const auto broken = simulation.yielding_bonds().broken();
    EXPECT_TRUE(std::is_sorted(broken.begin(), broken.end()));
    told.insert(told.end(), broken.begin(), broken.end());
  }

  std::sort(told.begin(), told.end());
  EXPECT_EQ(std::adjacent_find(told.begin(), told.end()), told.end());
  EXPECT_EQ(told.size(), broken_bonds(simulation));
}

TEST(YieldingBonds, TellWhatTheyCarryWhereTheNodesAreNow) {
  for (const bool as_wires : {false, true}) {
    Simulation simulation = simulation_of(as_wires ? yielding_wires() : yielding_beams());
    for (int i = 0; i < 800; ++i) {
      std::vector<double> told;
      for (std::size_t k = 0; k < simulation.bonds().size(); ++k)
        told.push_back(simulation.bond_forces(k).tension);

      simulation.step();

      for (std::size_t k = 0; k < told.size(); ++k)
        ASSERT_EQ(told[k], simulation.bonds().axial_force(k));
    }
    EXPECT_GT(broken_bonds(simulation), 0U);
  }
}

TEST(YieldingBonds, LimitTheStepFromWhereTheyAreAtRestNow) {
  // Beams that were pressed together for good carry more tension at the same length.
  Scene scene = yielding_beams();
  std::get<BondStrength>(scene.bond_laws[0].law).rupture_strain = BondStrength::kNever;
  Simulation simulation = simulation_of(scene);
  for (int i = 0; i < 600; ++i) simulation.step();

  dynamics::NodalStiffness by_rest(simulation.state().size());
  dynamics::NodalStiffness first(simulation.state().size());
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    add_beam(by_rest, scene.bonds[i], simulation.state(), simulation.bonds().spring(i).length);
    add_beam(first, scene.bonds[i], simulation.state());
  }
  EXPECT_DOUBLE_EQ(simulation.critical_step().dt,
                   by_rest.critical_step(simulation.properties()).dt);
  EXPECT_NE(by_rest.total().translation, first.total().translation);
  EXPECT_LE(simulation.time_step(), dynamics::kSafety * simulation.critical_step().dt * (1 + 1e-2));
}

TEST(YieldingBonds, LeaveElasticBondsAsTheyAre) {
  Scene elastic = yielding_beams();
  elastic.bond_laws.clear();
  Scene strong = yielding_beams();
  strong.bond_laws[0].law = BondStrength{};
  Simulation one = simulation_of(elastic);
  Simulation other = simulation_of(strong);
  for (int i = 0; i < 300; ++i) {
    one.step();
    other.step();
  }

  for (std::size_t i = 0; i < one.state().size(); ++i)
    EXPECT_EQ(one.state().position[i], other.state().position[i]);
}

TEST(YieldingBonds, TakeTheirCylindersWithThemWhereTheyBreakAtTheStart) {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  const NodeId a = scene.add_node(Vec3::Zero());
  const NodeId b = scene.add_node(Vec3::UnitX());
  const NodeId c = scene.add_node(2.0 * Vec3::UnitX());
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c)}) {
    scene.add_beam(from, to, dynamics::circular_section(0.01, 1e8, 0.3), 1000.0);
    scene.add_cylinder(from, to, 0.01, contact::MaterialId{0});
  }
  scene.bonds[1].length = 0.9;  // it is pulled by a strain of 1/9
  BondStrength strength;
  strength.strength = 1e6;
  scene.bond_laws = {{strength, {0, 1}}};
  Simulation simulation = simulation_of(scene);

  simulation.step();

  EXPECT_TRUE(simulation.bonds().is_broken(1));
  ASSERT_EQ(simulation.elements().cylinders.size(), 1U);
  EXPECT_EQ(simulation.elements().cylinders[0].nodes[0], a);
  EXPECT_EQ(simulation.energy().turnover(), 0.0);
}

TEST(Scene, ListsBondLawsThatDoNotFit) {
  Scene scene = yielding_beams();
  scene.bond_laws.push_back({WireCurve{}, {0}});
  try {
    dynamics::check(scene);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("bond law 1: has no points"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("bond 0 has a law already"), std::string::npos);
  }
}

}  // namespace
}  // namespace plekton::test::yielding_bonds_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/require_index.hpp"

#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::require_index_test {
namespace {

using geometry::NodeId;

/// A beam, a cylinder and a facet on three nodes, two planes, a force, a pressure and a
/// servo of the first plane.
Scene scene_of_three_nodes() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  const contact::MaterialId material{0};
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) scene.add_node(x);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, material);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.01, material);
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)})
    scene.add_beam(NodeId{a}, NodeId{b}, circular_section(0.01, 1e7, 0.3), 1000.0);
  for (const double z : {-1.0, -2.0})
    scene.planes.push_back({Vec3(0, 0, z), Vec3::UnitZ(), Vec3::Zero(), material});
  scene.loads.forces.emplace_back().nodes = {NodeId{2}};
  scene.loads.pressures.emplace_back().facets = {geometry::FaceId{0}};
  scene.loads.servos.emplace_back().force = 1.0;
  scene.loads.servos[0].largest_speed = 1.0;
  return scene;
}

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::out_of_range& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("of another kind: ") + error.what();
  }
  return "accepted";
}

/// A call with an index, and how it calls what it takes.
struct Call {
  std::string name;
  std::string what;
  std::int64_t count;
  std::function<void(Simulation&, std::int64_t)> with;
};

NodeId node(std::int64_t i) {
  return static_cast<NodeId>(i);
}
std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// All of the simulation that take a node, or what there is one of in the scene by its place.
const std::vector<Call>& calls() {
  static const std::vector<Call> all = {
      {"set_velocity", "node", 3, [](auto& s, auto i) { s.set_velocity(node(i), Vec3::Zero()); }},
      {"support_reaction", "node", 3,
       [](auto& s, auto i) {
         s.support_reaction(std::array{node(0), node(i)}, Vec3::Zero());
       }},
      {"section_force", "node", 3,
       [](auto& s, auto i) {
         s.section_force(std::array{node(0), node(i)}, Vec3::Zero());
       }},
      {"break_cylinder", "node", 3, [](auto& s, auto i) { s.break_cylinder(node(0), node(i)); }},
      {"break_cylinder", "node", 3, [](auto& s, auto i) { s.break_cylinder(node(i), node(0)); }},
      {"break_facet", "node", 3,
       [](auto& s, auto i) {
         s.break_facet({node(0), node(i), node(2)});
       }},
      {"break_bond", "bond", 3, [](auto& s, auto i) { s.break_bond(index(i)); }},
      {"bond_forces", "bond", 3, [](auto& s, auto i) { s.bond_forces(index(i)); }},
      {"bond_stress", "bond", 3, [](auto& s, auto i) { s.bond_stress(index(i)); }},
      {"force_point", "plane", 2, [](auto& s, auto i) { s.force_point(index(i)); }},
      {"force_radius", "plane", 2, [](auto& s, auto i) { s.force_radius(index(i)); }},
      {"pressing_on", "plane", 2, [](auto& s, auto i) { s.pressing_on(index(i)); }},
      {"plane_reaction", "plane", 2, [](auto& s, auto i) { s.plane_reaction(index(i)); }},
      {"add_force", "node", 3,
       [](auto& s, auto i) {
         s.add_force({node(0), node(i)}, [](double, const NodeState&, auto) {});
       }},
      {"set_force", "force", 1, [](auto& s, auto i) { s.set_force(index(i), Vec3::Zero()); }},
      {"set_pressure", "pressure", 1, [](auto& s, auto i) { s.set_pressure(index(i), 1.0); }},
      {"set_servo", "servo", 1, [](auto& s, auto i) { s.set_servo(index(i), 1.0); }},
      {"set_plane_velocity", "plane", 2,
       [](auto& s, auto i) { s.set_plane_velocity(index(i), Vec3::Zero()); }},
  };
  return all;
}

TEST(IdsOfASimulation, AreCheckedByEveryCallThatTakesOne) {
  for (const Call& call : calls()) {
    Simulation simulation(scene_of_three_nodes(), {});
    for (const std::int64_t i : {call.count, call.count + 74, std::int64_t{1} << 30}) {
      EXPECT_EQ(refusal_of([&] { call.with(simulation, i); }),
                "Simulation::" + call.name + ": there is no " + call.what + " " +
                    std::to_string(i) + "; this scene has " + std::to_string(call.count) + " " +
                    call.what + "s, from 0 to " + std::to_string(call.count - 1));
    }
    EXPECT_THAT(refusal_of([&] { call.with(simulation, -1); }),
                testing::HasSubstr(call.name + ": there is no " + call.what + " "));
    EXPECT_NO_THROW(
        call.with(simulation, call.count - 1 - (call.name.starts_with("break_") ? 1 : 0)));
  }
}

TEST(IdsOfASimulation, AreRefusedWhereThereIsNothingOfTheKind) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}};
  scene.add_sphere(Vec3::Zero(), 0.1, 1000.0, contact::MaterialId{0});
  Simulation simulation(std::move(scene), {});

  EXPECT_EQ(refusal_of([&] { simulation.bond_stress(0); }),
            "Simulation::bond_stress: there is no bond 0; this scene has no bonds");
  EXPECT_EQ(refusal_of([&] { simulation.force_point(0); }),
            "Simulation::force_point: there is no plane 0; this scene has no planes");
  EXPECT_EQ(refusal_of([&] { simulation.gathered_force(0); }),
            "Simulation::gathered_force: there is no rigid body 0; this scene has no rigid bodies");
  EXPECT_EQ(
      refusal_of([&] { simulation.gathered_torque(1); }),
      "Simulation::gathered_torque: there is no rigid body 1; this scene has no rigid bodies");
  EXPECT_EQ(refusal_of([&] { simulation.set_body_servo(0, 1.0); }),
            "Simulation::set_body_servo: there is no body servo 0; this scene has no body servos");
  EXPECT_EQ(refusal_of([&] { simulation.set_velocity(NodeId{77}, Vec3::Zero()); }),
            "Simulation::set_velocity: there is no node 77; this scene has 1 nodes, from 0 to 0");
}

/// What a refused call asked for must not be done in the next step.
TEST(IdsOfASimulation, LeaveTheSimulationAsItWasWhereTheyAreRefused) {
  Simulation simulation(scene_of_three_nodes(), {});
  for (const Call& call : calls()) refusal_of([&] { call.with(simulation, call.count); });

  simulation.step();

  EXPECT_EQ(simulation.elements().facets.size(), 1U);
  EXPECT_EQ(simulation.elements().cylinders.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(simulation.bonds().is_broken(i));
}

TEST(IdsOfASimulation, AreCheckedByItsBondsToo) {
  const Simulation simulation(scene_of_three_nodes(), {});
  const BeamBonds& bonds = simulation.bonds();
  const NodeState& state = simulation.state();
  const std::vector<std::function<void(std::size_t)>> calls = {
      [&](std::size_t i) { bonds.nodes(i); },
      [&](std::size_t i) { bonds.axial_force(i); },
      [&](std::size_t i) { bonds.spring(i); },
      [&](std::size_t i) { bonds.ends(i, state); },
      [&](std::size_t i) { bonds.forces_of(i, state); },
      [&](std::size_t i) { bonds.action_on(i, false, state); },
      [&](std::size_t i) { bonds.lost_by_break(i, bonds.spring(0), state, 1e-6); },
      [&](std::size_t i) { bonds.is_broken(i); },
  };
  for (const auto& call : calls) {
    EXPECT_NO_THROW(call(2));
    EXPECT_EQ(refusal_of([&] { call(3); }), "BeamBonds: there is no bond 3; there are 3");
    EXPECT_NE(refusal_of([&] { call(std::size_t{0} - 1); }), "accepted");
  }
}

}  // namespace
}  // namespace plekton::dynamics::require_index_test

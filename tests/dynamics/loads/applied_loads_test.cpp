// SPDX-License-Identifier: GPL-3.0-or-later
// All loads at once on one scene.
#include "dynamics/loads/applied_loads.hpp"

#include "geometry/base/state_tree.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

namespace plekton::test::applied_loads_test {
namespace {

using dynamics::Held;
using dynamics::TimeTable;

std::vector<NodeId> nodes_from(std::size_t first, std::size_t end) {
  std::vector<NodeId> nodes;
  for (std::size_t i = first; i < end; ++i) nodes.push_back(geometry::id_at<NodeId>(i));
  return nodes;
}

/// A ball under pressure of a gas over a sheet that is pulled, stretched and damped: so many nodes,
/// facets and beams that several threads have work.
Scene scene_under_all_loads() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  dynamics::SurfacePressure pressure;
  pressure.facets = add_membrane(scene, geometry::icosphere(0.1, 3));
  pressure.pressure = 1e3;
  pressure.factor = TimeTable({{0.0, 0.0}, {0.002, 1.0}});
  pressure.gas = dynamics::Gas{};
  const std::size_t ball = scene.state.size();
  add_membrane(scene, geometry::plane_sheet({0.4, 0.4, 20, 20}));
  const std::size_t all = scene.state.size();
  for (std::size_t i = ball; i < all; ++i) scene.state.position[i].z() -= 0.105;
  scene.planes.push_back({Vec3(0, 0, 0.103), -Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}});

  dynamics::Loads& loads = scene.loads;
  loads.pressures = {pressure};
  loads.motions.resize(1);
  loads.motions[0].nodes = nodes_from(ball, ball + 21);
  loads.motions[0].held = Held::along_y | Held::along_z;
  loads.motions[0].velocity = Vec3(0.0, -0.2, 0.1);
  loads.motions[0].factor = TimeTable({{0.0, 0.0}, {0.002, 1.0}});
  loads.forces.push_back({nodes_from(all - 21, all), Vec3(0.0, 0.1, 0.0), Vec3(1e-5, 0, 0), {}});
  loads.ground_springs.push_back({nodes_from(ball, all), Vec3(10.0, 10.0, 50.0)});
  loads.mass_damping.push_back({nodes_from(0, ball), 5.0});
  loads.beam_damping.resize(1);
  loads.beam_damping[0].ratio = 0.05;
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) loads.beam_damping[0].bonds.push_back(i);
  loads.servos.resize(1);
  loads.servos[0].force = 2.0;
  loads.servos[0].largest_speed = 0.5;
  loads.gravity_factor = TimeTable({{0.0, 0.0}, {0.004, 1.0}});
  return scene;
}

constexpr double kDuration = 0.01;  // s
const Vec3 kGravity(0.0, 0.0, -9.81);

TEST(AppliedLoads, KeepTheBooksTogether) {
  dynamics::SimulationOptions options;
  options.motion.gravity = kGravity;
  LoadedSimulation simulation(scene_under_all_loads(), options);

  EXPECT_LT(closure_until(simulation, kDuration), 5e-3);
  EXPECT_GT(simulation.energy().damping, 0.0);
  EXPECT_GT(simulation.contacts().counts().with_planes, 0u);
}

TEST(AppliedLoads, GiveTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = scene_under_all_loads();
  const double dt = 0.5 * LoadedSimulation(scene, {}).critical_step().dt;
  auto one = simulation_of(scene, dt, kGravity);
  while (one.time() < 0.2 * kDuration) one.step();

  for (const int threads : {2, 4}) {
    auto many = simulation_of(scene, dt, kGravity, threads);
    while (many.time() < 0.2 * kDuration) many.step();
    EXPECT_EQ(one.state().position, many.state().position) << threads;
    EXPECT_EQ(one.state().velocity, many.state().velocity) << threads;
    EXPECT_EQ(one.planes()[0].point, many.planes()[0].point) << threads;
    EXPECT_EQ(one.energy().external_work, many.energy().external_work) << threads;
    EXPECT_EQ(one.energy().damping, many.energy().damping) << threads;
  }
}

TEST(AppliedLoads, SayWhichOfThemThatWereSetAreNotHere) {
  const auto with_forces = [](std::size_t count) {
    Scene scene;
    const NodeId node = add_lump(scene, Vec3::Zero());
    dynamics::NodalForce force;
    force.nodes = {node};
    force.force = Vec3(0, 0, 1);
    scene.loads.forces.assign(count, force);
    return simulation_of(std::move(scene), 1e-3);
  };
  LoadedSimulation before = with_forces(2);
  before.step();
  before.set_force(1, Vec3(0, 0, 7));
  LoadedSimulation same = with_forces(2);
  LoadedSimulation other = with_forces(1);

  EXPECT_NO_THROW(same.restore(before.snapshot()));
  EXPECT_THAT([&] { other.restore(before.snapshot()); },
              testing::ThrowsMessage<geometry::StateMismatch>(testing::HasSubstr(
                  "in the state force 1 was set, by its place from 0 in the loads; here are 1")));
}

}  // namespace
}  // namespace plekton::test::applied_loads_test

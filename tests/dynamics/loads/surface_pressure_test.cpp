// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/surface_pressure.hpp"

#include "dynamics/loads/applied_loads.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace plekton::test::surface_pressure_test {
namespace {

using dynamics::Gas;
using dynamics::NodeForces;
using dynamics::PressedSurface;
using dynamics::SurfacePressure;
using dynamics::TimeTable;
using testing::HasSubstr;

/// A sphere of 0.1 m around a place, its nodes shaken by 5 mm: closed, of no symmetry.
Scene rough_ball(std::vector<geometry::FaceId>& facets, const Vec3& place) {
  geometry::Mesh mesh = geometry::icosphere(0.1, 2);
  Random random(3);
  for (Vec3& point : mesh.points) point += place + random.in_cube(0.005);
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  facets = add_membrane(scene, mesh);
  return scene;
}

NodeForces forces_of(const SurfacePressure& load, const Scene& scene) {
  PressedSurface surface(load, scene.elements.facets, scene.state);
  geometry::ThreadPool pool;
  NodeForces forces(scene.state.size());
  surface.act({0.0, 0.0, 1.0}, scene.state, pool).add_to(forces, pool);
  return forces;
}

double volume_of(const Scene& scene) {
  std::vector<std::array<NodeId, 3>> corners;
  for (const auto& facet : scene.elements.facets) corners.push_back(facet.nodes);
  return dynamics::volume_under(corners, scene.state.position);
}

TEST(SurfacePressure, KeepsBothMomentaOnAClosedSurface) {
  SurfacePressure load;
  const Scene scene = rough_ball(load.facets, Vec3(3.0, -2.0, 1.0));
  load.pressure = 2e4;

  const NodeForces forces = forces_of(load, scene);

  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    force += forces.force[i];
    moment += scene.state.position[i].cross(forces.force[i]);
    sum += forces.force[i].norm();
  }
  EXPECT_NEAR(sum, load.pressure * 4.0 * std::numbers::pi * 0.01, 0.1 * sum);
  EXPECT_LT(force.norm(), 1e-12 * sum);
  EXPECT_LT(moment.norm(), 1e-12 * sum * 4.0);  // at 4 m from the origin
}

TEST(SurfacePressure, IsTheGradientOfPressureTimesVolume) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3(0.2, 0.0, 0.0));
  load.pressure = 1e3;
  const NodeForces forces = forces_of(load, scene);

  constexpr double kStep = 1e-3;  // m; the volume is linear in each coordinate
  for (const std::size_t node : {0u, 17u, 80u}) {
    for (int axis = 0; axis < 3; ++axis) {
      double& x = scene.state.position[node][axis];
      const double before = x;
      x = before + kStep;
      const double more = volume_of(scene);
      x = before - kStep;
      const double less = volume_of(scene);
      x = before;
      const double expected = load.pressure * (more - less) / (2.0 * kStep);
      // Volumes are rounded by some eps of 4e-3 m³.
      EXPECT_NEAR(forces.force[node][axis], expected, 1e3 * 100.0 * 2.2e-16 * 4e-3 / kStep);
    }
  }
}

TEST(SurfacePressure, SharesPressureTimesAreaOnAnOpenSurface) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::plane_sheet({0.3, 0.2, 3, 2}));
  load.pressure = 500.0;

  const NodeForces forces = forces_of(load, scene);

  Vec3 sum = Vec3::Zero();
  for (const Vec3& force : forces.force) sum += force;
  EXPECT_NEAR(sum.z(), 500.0 * 0.06, 1e-12);
  EXPECT_EQ(sum.head<2>(), Vec3::Zero().head<2>());
}

TEST(SurfacePressure, TurnsWithTheSurface) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::plane_sheet({0.3, 0.2, 1, 1}));
  load.pressure = 500.0;
  for (Vec3& x : scene.state.position) x = Vec3(x.z(), x.x(), x.y());

  const NodeForces forces = forces_of(load, scene);

  for (const Vec3& force : forces.force) {
    EXPECT_GT(force.x(), 0.0);
    EXPECT_EQ(force.tail<2>(), Vec3::Zero().tail<2>());
  }
}

/// Work of the pressure while a ball is blown up by a table, and the integral of p dV over the same
/// steps by the trapezoidal rule. The coarse steps are half of the critical one.
struct Blown {
  double work = 0.0;
  double integral = 0.0;
  double closure = 0.0;
};

Blown blown_up(std::optional<Gas> gas, double part_of_step, bool by_volume = false) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  load.pressure = 5e3;
  load.gas = gas;
  if (by_volume) {
    const double start = volume_of(scene);
    load.pressure = 0.0;
    load.by_volume = {{{{0.5 * start, 9e3}, {1.01 * start, 5e3}, {1.5 * start, 0.0}}}};
  }
  load.factor = TimeTable({{0.0, 0.0}, {0.004, 1.0}, {0.008, 0.4}});
  scene.loads.pressures.push_back(load);
  const double half = 0.5 / dynamics::kSafety * LoadedSimulation(scene, {}).time_step();
  auto simulation = simulation_of(scene, part_of_step * half);
  const auto& surface = simulation.loads().pressed_surfaces().front();
  const auto volume = [&] {
    std::vector<std::array<NodeId, 3>> corners;
    for (const auto& facet : simulation.elements().facets) corners.push_back(facet.nodes);
    return dynamics::volume_under(corners, simulation.state().position);
  };
  Blown blown;
  double pressure_before = 0.0;
  double volume_before = volume();
  double error = 0.0;
  while (simulation.time() < 0.01) {
    const double volume_now = volume();
    simulation.step();
    blown.integral += 0.5 * (pressure_before + surface.pressure()) * (volume_now - volume_before);
    pressure_before = surface.pressure();
    volume_before = volume_now;
    error = std::max(error, std::abs(simulation.energy().closure_error()));
  }
  blown.work = simulation.energy().external_work;
  blown.closure = error / simulation.energy().turnover();
  return blown;
}

TEST(SurfacePressure, DoesTheWorkOfTheIntegralOfPressureOverVolume) {
  for (const bool has_gas : {false, true}) {
    const std::optional<Gas> gas = has_gas ? std::optional(Gas{2e4, 1.4}) : std::nullopt;
    const Blown coarse = blown_up(gas, 1.0);
    const Blown fine = blown_up(gas, 0.25);

    EXPECT_GT(coarse.integral, 0.01);
    EXPECT_NEAR(coarse.work, coarse.integral, 1e-4 * coarse.integral);
    // Both are of second order in the step; the margin is for higher ones.
    EXPECT_NEAR(fine.work, fine.integral,
                1.5 / 16.0 * std::abs(coarse.work - coarse.integral) + 1e-12);
    EXPECT_LT(coarse.closure, 1e-3);
    EXPECT_LT(fine.closure, 1.5 / 16.0 * coarse.closure);
  }
}

TEST(SurfacePressure, ByVolumeDoesTheWorkOfItsIntegralOverTheVolume) {
  const Blown coarse = blown_up({}, 1.0, true);
  const Blown fine = blown_up({}, 0.25, true);

  EXPECT_GT(coarse.integral, 0.01);
  EXPECT_NEAR(coarse.work, coarse.integral, 1e-4 * coarse.integral);
  EXPECT_NEAR(fine.work, fine.integral,
              1.5 / 16.0 * std::abs(coarse.work - coarse.integral) + 1e-12);
  EXPECT_LT(coarse.closure, 1e-3);
  EXPECT_LT(fine.closure, 1.5 / 16.0 * coarse.closure);
}

TEST(SurfacePressure, ByVolumeIsNotSetWhileItRuns) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  load.by_volume = {{{{1e-3, 9e3}, {1e-2, 0.0}}}};
  scene.loads.pressures.push_back(load);
  LoadedSimulation simulation = simulation_of(std::move(scene), 1e-7);
  const auto is_refused = testing::ThrowsMessage<std::invalid_argument>(
      HasSubstr("pressure 0 follows the volume by a table"));

  EXPECT_THAT([&] { simulation.set_pressure(0, 5e3); }, is_refused);
  simulation.break_facet(simulation.elements().facets[0].nodes);
  simulation.step();
  EXPECT_THAT([&] { simulation.set_pressure(0, 5e3); }, is_refused) << "torn";
}

TEST(SurfacePressure, ByVolumeFollowsStraightLinesBetweenRowsWithoutForceOrMomentInAll) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3(0.2, 0.0, 0.0));
  const double volume = volume_of(scene);
  load.by_volume = {{{{volume, 4e3}, {1.331 * volume, 1e3}}}};
  load.factor = TimeTable(0.5);
  PressedSurface surface(load, scene.elements.facets, scene.state);
  geometry::ThreadPool pool;
  const auto pressure_at = [&](double size) {
    dynamics::NodeState state = scene.state;
    for (Vec3& x : state.position) x *= size;
    surface.act({0.0, 0.0, 1.0}, state, pool);
    return surface.pressure();
  };

  EXPECT_NEAR(pressure_at(1.0), 2e3, 1e-9);
  EXPECT_NEAR(pressure_at(std::cbrt(1.1655)), 0.5 * 2.5e3, 1e-9);
  EXPECT_NEAR(pressure_at(0.9), 2e3, 1e-9);
  EXPECT_NEAR(pressure_at(1.2), 0.5e3, 1e-9);
  NodeForces forces(scene.state.size());
  surface.act({0.0, 0.0, 1.0}, scene.state, pool).add_to(forces, pool);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    force += forces.force[i];
    moment += scene.state.position[i].cross(forces.force[i]);
  }
  // 2 kPa on 0.13 m².
  EXPECT_LT(force.norm(), 1e-12 * 250.0);
  EXPECT_LT(moment.norm(), 1e-12 * 250.0);
}

TEST(SurfacePressure, ByVolumeShortensTheCriticalStepWhereItIsSteep) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  const double volume = volume_of(scene);
  const double without = LoadedSimulation(scene, {}).critical_step().dt;
  load.by_volume = {{{{volume, 1e6}, {1.1 * volume, 0.0}}}};
  scene.loads.pressures.push_back(load);
  const LoadedSimulation simulation(scene, {});

  EXPECT_LT(simulation.critical_step().dt, 0.9 * without);
  EXPECT_LE(simulation.critical_step().dt, simulation.exact_critical_step().dt);
}

TEST(SurfacePressure, ByVolumeIsRefusedOnAnOpenSurfaceAndWithRowsThatGoBack) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::plane_sheet({0.3, 0.2, 3, 2}));
  load.pressure = 1.0;
  load.by_volume = {{{{2.0, 1.0}, {1.0, 0.0}}}};
  scene.loads.pressures.push_back(load);

  const std::string problems = problems_of(scene);

  EXPECT_THAT(problems, HasSubstr("a pressure by volume needs a closed surface"));
  EXPECT_THAT(problems, HasSubstr("row 1 of its pressure by volume is at 1 m3, not above 2 m3"));
  EXPECT_THAT(problems, HasSubstr("has a pressure by volume and another pressure or a gas"));
}

TEST(SurfacePressure, OfAGasFallsAsItsVolumeGrows) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  load.pressure = 1e3;
  load.gas = Gas{1e5, 1.4};
  PressedSurface surface(load, scene.elements.facets, scene.state);
  const double before = volume_of(scene);
  for (Vec3& x : scene.state.position) x *= 1.1;

  geometry::ThreadPool pool;
  surface.act({0.0, 0.0, 1.0}, scene.state, pool);

  EXPECT_NEAR(surface.volume(), 1.331 * before, 1e-14 * before);
  EXPECT_NEAR(surface.pressure(), 1.01e5 * std::pow(1.331, -1.4) - 1e5, 1e-8);
}

TEST(SurfacePressure, OfAGasShortensTheCriticalStep) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  const double without = LoadedSimulation(scene, {}).critical_step().dt;
  load.pressure = 1e7;
  load.gas = Gas{};
  scene.loads.pressures.push_back(load);

  EXPECT_LT(LoadedSimulation(scene, {}).critical_step().dt, 0.9 * without);
}

TEST(SurfacePressure, GivesTheSameBitsForAnyNumberOfThreads) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  load.pressure = 5e3;
  load.gas = Gas{2e4, 1.4};
  scene.loads.pressures.push_back(load);
  const double dt = LoadedSimulation(scene, {}).time_step();
  auto one = simulation_of(scene, dt);
  for (int i = 0; i < 200; ++i) one.step();

  for (const int threads : {2, 4}) {
    auto many = simulation_of(scene, dt, Vec3::Zero(), threads);
    for (int i = 0; i < 200; ++i) many.step();
    EXPECT_EQ(one.state().position, many.state().position);
    EXPECT_EQ(one.energy().external_work, many.energy().external_work);
  }
}

// The first step was chosen without the pressure, and nodes went through what was near in it.
TEST(SurfacePressure, ThatActsFromTheStartShortensTheFirstStep) {
  SurfacePressure load;
  Scene scene = rough_ball(load.facets, Vec3::Zero());
  const double radius = scene.elements.facets[0].radius;
  const double unpressed = simulation_of(scene, 0.0, Vec3::Zero()).time_step();
  const double lightest = *std::ranges::min_element(scene.properties.mass);
  const double share = 4.0 * std::numbers::pi * 0.01 / static_cast<double>(scene.state.size());
  // By which a node would go some radius in that step.
  load.pressure = 2.0 * radius * lightest / (share * unpressed * unpressed);
  scene.loads.pressures = {load};
  auto simulation = simulation_of(scene, 0.0, Vec3::Zero());
  const std::vector<Vec3> before = simulation.state().position;

  simulation.step();

  double furthest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    furthest = std::max(furthest, (simulation.state().position[i] - before[i]).norm());
  EXPECT_LE(furthest, 0.101 * radius);  // a tenth, and what the motion itself brings
  EXPECT_LT(simulation.time_step(), unpressed);
}

TEST(SurfacePressure, OfAGasIsRefusedOnAnOpenSurface) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::plane_sheet({0.3, 0.2, 3, 2}));
  load.pressure = 500.0;
  scene.loads.pressures.push_back(load);
  EXPECT_EQ(problems_of(scene), "");

  scene.loads.pressures[0].gas = Gas{};

  EXPECT_THAT(problems_of(scene), HasSubstr("surface pressure 0: a gas needs a closed surface"));
}

TEST(SurfacePressure, OfAGasIsRefusedBelowNone) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::icosphere(0.1, 1));
  load.gas = Gas{1e5, 1.0};
  load.pressure = 6e4;
  load.factor = TimeTable({{0.0, 1.0}, {1.0, -2.0}, {2.0, 0.0}});
  scene.loads.pressures.push_back(load);
  EXPECT_THAT(problems_of(scene), HasSubstr("surface pressure 0: leaves its gas -20000 Pa"));

  scene.loads.pressures[0].pressure = 5e4;  // a vacuum
  EXPECT_EQ(problems_of(scene), "");
}

TEST(SurfacePressure, IsRefusedOnFacetsThatDoNotGoTogether) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  SurfacePressure load;
  load.facets = add_membrane(scene, geometry::icosphere(0.1, 1));
  load.gas = Gas{-1.0, 0.0};
  scene.loads.pressures.push_back(load);
  EXPECT_THAT(problems_of(scene), HasSubstr("outside pressure -1 Pa must be"));
  EXPECT_THAT(problems_of(scene), HasSubstr("exponent 0 of the gas must be above 0"));

  Scene inside_out = scene;
  inside_out.loads.pressures[0].gas = Gas{};
  for (auto& facet : inside_out.elements.facets) std::swap(facet.nodes[1], facet.nodes[2]);
  EXPECT_THAT(problems_of(inside_out), HasSubstr("let its facets face outward"));

  std::swap(scene.elements.facets[4].nodes[1], scene.elements.facets[4].nodes[2]);
  scene.loads.pressures[0].gas.reset();
  EXPECT_THAT(problems_of(scene), HasSubstr("are neighbours but face opposite ways"));

  scene.loads.pressures[0].facets = {geometry::FaceId{2}, geometry::FaceId{2},
                                     geometry::FaceId{500}};
  EXPECT_THAT(problems_of(scene), HasSubstr("names facet 2 twice"));
  EXPECT_THAT(problems_of(scene), HasSubstr("there is no facet 500, only 80 facets"));
}

}  // namespace
}  // namespace plekton::test::surface_pressure_test

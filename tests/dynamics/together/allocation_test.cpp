// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/yielding_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

namespace plekton::test::allocation_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;

constexpr contact::MaterialId kStructure{0};
constexpr contact::MaterialId kGrains{1};

/// Waits until the thread beside the caller has begun, if there is one: under a sanitizer a thread
/// that begins allocates.
void await_threads(geometry::ThreadPool& pool) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> has_begun = pool.thread_count() == 1;
  while (!has_begun) {
    pool.for_each_range(2, [&](std::size_t, std::size_t, int) {
      if (std::this_thread::get_id() != caller) has_begun = true;
    });
  }
}

TEST(Allocation, IsCounted) {
  EXPECT_EQ(test::allocations_of([] { ::operator delete(::operator new(1)); }), 1u);
}

TEST(Allocation, IsNoneInTheForcesOfBeams) {
  Scene scene = chain(50, 1.0, dynamics::circular_section(0.01, 1e6, 0.3));
  BeamBonds bonds(scene.bonds, scene.state.size());
  contact::NodeForces forces(scene.state.size());
  for (const int threads : {1, 2}) {
    geometry::ThreadPool pool(threads);
    await_threads(pool);

    const std::size_t count = allocations_of([&] {
      bonds.advance(scene.state, pool);
      bonds.add_forces(forces, pool);
    });

    EXPECT_EQ(count, 0U);
  }
}

TEST(Allocation, IsNoneWhileBondsYieldAndBreak) {
  for (const bool are_wires : {false, true}) {
    dynamics::SimulationOptions options;
    options.threads = are_wires ? 2 : 1;
    Simulation simulation(are_wires ? yielding_wires() : yielding_beams(), options);
    simulation.step();

    std::size_t broken = 0;
    const std::size_t count = allocations_of([&] {
      for (int i = 0; i < 1500; ++i) {
        simulation.step();
        broken += simulation.yielding_bonds().broken().size();
      }
    });

    EXPECT_EQ(count, 0U);
    EXPECT_GT(broken, 0U);
  }
}

TEST(Allocation, IsNoneInTheForcesOfSheets) {
  Scene scene;
  const Complex grid = sheet(5);
  for (const Vec3& x : grid.x) scene.add_node(x);
  for (const auto& facet : grid.facets)
    scene.add_sheet_facet(facet.nodes, dynamics::solid_sheet(0.1, 1e6, 0.3), 1000.0);
  dynamics::SheetFacets sheets(scene.sheet_facets, scene.state.size());
  dynamics::NodalStiffness stiffness(scene.state.size());
  contact::NodeForces forces(scene.state.size());
  for (const int threads : {1, 2}) {
    geometry::ThreadPool pool(threads);
    await_threads(pool);

    const std::size_t count = allocations_of([&] {
      sheets.advance(scene.state, 0.0, pool);
      sheets.add_forces(forces, pool);
      sheets.add_to(stiffness, scene.state);
    });

    EXPECT_EQ(count, 0U);
  }
}

/// A square grid of n cells a side, of this spacing (m), around the origin in z = 0.
void add_grid(Scene& scene, const Complex& grid, int n, double spacing, Held inside) {
  for (const Vec3& x : grid.x) {
    const bool on_rim = x.head<2>().minCoeff() <= 0.0 || x.head<2>().maxCoeff() >= n;
    scene.add_node(spacing * (x - Vec3(0.5 * n, 0.5 * n, 0.0)), on_rim ? Held::everything : inside);
  }
}

/// A sheet of beams and facets, held at its rim.
Scene sheet_scene() {
  constexpr int kCells = 6;
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}, {1e6, 0.3, 0.6}};
  const Complex grid = sheet(kCells);
  add_grid(scene, grid, kCells, 0.02, Held::nothing);
  for (const auto& facet : grid.facets) {
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], 0.0015, kStructure);
  }
  const geometry::Surface surface(scene.elements.cylinders, scene.elements.facets,
                                  scene.state.size());
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    const auto& [a, b] = surface.nodes_of(geometry::id_at<geometry::EdgeId>(e));
    scene.add_beam(a, b, dynamics::circular_section(0.0015, 2e7, 0.3), 600.0);
  }
  return scene;
}

/// A rigid net, so fine that a grain lies on many rings of wire at once.
Scene net_scene() {
  constexpr int kCells = 40;
  Scene scene;
  scene.materials = {{1e5, 0.3, 0.4}, {1e5, 0.3, 0.6}};
  const Complex grid = net(kCells);
  add_grid(scene, grid, kCells, 0.0006, Held::everything);
  for (const auto& wire : grid.cylinders) {
    scene.add_cylinder(wire.nodes[0], wire.nodes[1], 0.00015, kStructure);
  }
  return scene;
}

/// Grains on their way down, and four walls around them.
void add_grains(Scene& scene, double radius, int columns, double half_width) {
  Random random(7);
  for (int i = 0; i < columns * columns; ++i) {
    const double x = 2.2 * radius * (i % columns - 0.5 * (columns - 1));
    const double y = 2.2 * radius * (i / columns - 0.5 * (columns - 1));
    scene.add_sphere(Vec3(x, y, 1.4 * radius), radius, 2650.0, kGrains);
    scene.state.velocity.back() = 0.3 * random.direction();
    scene.state.velocity.back().z() = 0.0;
  }
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    scene.planes.push_back({-half_width * normal, normal, Vec3::Zero(), kGrains});
  }
}

/// A given step is the one that is chosen at the start. The skin stays as it is: one that is chosen
/// grows now and then, and lists that have never been as long with it.
Simulation simulation_of(Scene scene, int threads, bool chooses_step) {
  dynamics::SimulationOptions options;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  options.threads = threads;
  options.skin = 0.2 * scene.elements.spheres.front().radius;
  if (!chooses_step) options.time_step = Simulation(scene, options).time_step();
  return Simulation(std::move(scene), options);
}

/// Warms up, then counts; the lists are made anew at least three times and a chosen step is looked
/// at again twice while it counts.
/// @param most_touching  grows to the most contacts of grains with surfaces after a counted step
std::size_t allocations_of_steps(Simulation& simulation, int warm_up, std::size_t& most_touching) {
  for (int i = 0; i < warm_up; ++i) simulation.step();
  const std::int64_t lists = simulation.contacts().neighbours().rebuild_count();
  const std::size_t count = allocations_of([&] {
    while (simulation.contacts().neighbours().rebuild_count() < lists + 3 ||
           simulation.steps() < warm_up + 2 * dynamics::kStepsBetweenLooks) {
      simulation.step();
      most_touching = std::max(most_touching, simulation.contacts().counts().sphere_surface);
    }
  });
  return count;
}

TEST(Allocation, IsNoneInTheStepsOfGrainsOnASheet) {
  for (const int threads : {1, 2}) {
    Scene scene = sheet_scene();
    add_grains(scene, 0.006, 6, 0.05);
    Simulation simulation = simulation_of(std::move(scene), threads, threads == 2);

    // They bounce: now and then none touches it.
    std::size_t most_touching = 0;
    EXPECT_EQ(allocations_of_steps(simulation, 4000, most_touching), 0u) << threads << " threads";
    EXPECT_GT(most_touching, 0u);
  }
}

/// A sheet of beams and facets that falls across a held one, bounces and slides.
Scene sheets_scene() {
  Scene scene = sheet_scene();
  constexpr int kCells = 4;
  constexpr double kSpacing = 0.017;
  const Complex grid = sheet(kCells);
  const std::size_t first = scene.state.size();
  const Eigen::AngleAxisd turn(0.3, Vec3::UnitZ());
  for (const Vec3& x : grid.x) {
    const Vec3 flat = kSpacing * (x - Vec3(0.5 * kCells, 0.5 * kCells, 0.0));
    scene.add_node(turn * flat + Vec3(0.0, 0.0, 0.0052 + 0.05 * flat.x()));
    scene.state.velocity.back() = Vec3(0.05, 0.0, -0.1);
  }
  const auto node = [&](NodeId id) { return geometry::id_at<NodeId>(first + index_of(id)); };
  for (const auto& facet : grid.facets) {
    scene.add_facet(node(facet.nodes[0]), node(facet.nodes[1]), node(facet.nodes[2]), 0.0015,
                    kGrains);
  }
  const geometry::Surface surface({}, grid.facets, grid.x.size());
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    const auto& [a, b] = surface.nodes_of(geometry::id_at<geometry::EdgeId>(e));
    scene.add_beam(node(a), node(b), dynamics::circular_section(0.0015, 2e7, 0.3), 600.0);
  }
  return scene;
}

// While it bounces more hangs together now and then than ever before: it comes to rest first. All
// moves along, so that lists are made.
TEST(Allocation, IsNoneInTheStepsOfASheetThatLiesOnAnother) {
  for (const int threads : {1, 2}) {
    dynamics::SimulationOptions options;
    options.motion.gravity = Vec3(0.0, 0.0, -100.0);
    options.motion.damping = 0.3;
    options.threads = threads;
    options.skin = 0.0005;
    Scene scene = sheets_scene();
    for (Vec3& velocity : scene.state.velocity) velocity += Vec3(2.0, 0.0, 0.0);
    Simulation simulation(std::move(scene), options);

    std::size_t most_touching = 0;
    EXPECT_EQ(allocations_of_steps(simulation, 3000, most_touching), 0U) << threads << " threads";
    EXPECT_GT(simulation.contacts().counts().between_structures, 0U);
  }
}

/// Loads of each kind on a sheet, and on the first of the walls around it.
void add_loads(Scene& scene) {
  dynamics::SurfacePressure pressure{{geometry::FaceId{20}, geometry::FaceId{21}}, 10.0, {}, {}};
  dynamics::PlaneServo servo;
  servo.force = 0.01;
  servo.largest_speed = 0.01;
  dynamics::PrescribedMotion motion;
  const NodeId inside{24};
  motion.nodes = {inside};
  motion.held = Held::along_x;
  motion.velocity = Vec3(0.01, 0.0, 0.0);
  scene.loads.pressures = {pressure};
  scene.loads.servos = {servo};
  scene.loads.motions = {motion};
  scene.loads.forces.push_back({{inside}, Vec3(0.0, 0.0, 0.01), Vec3::Zero(), {}});
  scene.loads.ground_springs.push_back({{inside}, Vec3::Ones()});
  scene.loads.beam_damping.push_back({{0, 5, 7}, 0.1});
  scene.loads.mass_damping.push_back({{inside}, 1.0});
  scene.loads.gravity_factor = dynamics::TimeTable({{0.0, 0.5}, {100.0, 1.0}});
}

TEST(Allocation, IsNoneInTheStepsUnderLoads) {
  for (const int threads : {1, 2}) {
    Scene scene = sheet_scene();
    add_grains(scene, 0.006, 6, 0.05);
    add_loads(scene);
    Simulation simulation = simulation_of(std::move(scene), threads, threads == 1);

    std::size_t most_touching = 0;
    EXPECT_EQ(allocations_of_steps(simulation, 4000, most_touching), 0u) << threads << " threads";
  }
}

TEST(Allocation, IsNoneInTheStepsOfGrainsOnANet) {
  for (const int threads : {1, 2}) {
    Scene scene = net_scene();
    add_grains(scene, 0.003, 3, 0.011);
    Simulation simulation = simulation_of(std::move(scene), threads, threads == 1);

    std::size_t most_touching = 0;
    EXPECT_EQ(allocations_of_steps(simulation, 4000, most_touching), 0u) << threads << " threads";

    std::size_t terms = 0;
    simulation.contacts().for_each_surface_term(
        [&](NodeId, const geometry::CorePoint&, const auto&, double, const auto&) { ++terms; });
    // Four wires and four crossings close the first ring around a hole.
    EXPECT_GE(terms, 8 * simulation.contacts().counts().sphere_surface);
    EXPECT_GT(terms, 0u);
  }
}

}  // namespace
}  // namespace plekton::test::allocation_test

// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation whose spheres are moved by several ranks has the bits of one process.
#include "dynamics/integrators/nodes_of_ranks.hpp"

#include "contact/among_ranks.hpp"
#include "contact/sphere_sphere/shared_motion.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/state_hash.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>
#include <vector>

namespace plekton::dynamics::nodes_of_ranks_test {
namespace {

constexpr double kRadius = 5e-3;  // m

/// A cube of spheres that shake, on a floor, beside a held sheet; one of them is dragged, one
/// pushed, and a plane comes. Nodes are in no order in space.
Scene shaking_cube() {
  constexpr int kSide = 13;
  constexpr double kSpacing = 2.0 * kRadius;
  test::Random random(11);
  std::vector<Vec3> places;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      for (int k = 0; k < kSide; ++k)
        places.push_back(kSpacing * Vec3(i + 0.1, j, k + 0.49) + random.in_cube(0.02 * kRadius));
  for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random.index(i)]);

  Scene scene;
  scene.materials = {contact::Material{2e6, 0.3, 0.4}};
  const double side = kSide * kSpacing;
  std::array<NodeId, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = scene.add_node(Vec3(-0.66 * kSpacing, i == 1 ? side : 0.0, i == 2 ? side : 0.0),
                                Held::everything);
  scene.add_facet(corners[0], corners[1], corners[2], 0.5 * kRadius, contact::MaterialId{0});
  for (const Vec3& place : places) {
    scene.add_sphere(place, kRadius, 2500.0, contact::MaterialId{0});
    scene.state.velocity.back() = random.in_cube(0.3);
    scene.state.angular_velocity.back() = random.in_cube(3.0);
  }
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), contact::MaterialId{0}});
  // Far away, and so fast that what is near planes is listed anew between the lists of spheres.
  scene.planes.push_back({Vec3(0, 0, 10), -Vec3::UnitZ(), Vec3(0, 0, -20), contact::MaterialId{0}});
  scene.loads.mass_damping.push_back({{NodeId{500}}, 10.0});
  scene.loads.forces.push_back({{NodeId{900}}, Vec3(0.1, 0, 0), Vec3::Zero(), {}});
  return scene;
}

SimulationOptions options(int threads, double time_step) {
  SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3(0, 0, -9.81);
  options.motion.damping = 0.1;
  options.threads = threads;
  return options;
}

constexpr int kSteps = 220;

/// All that is seen of a run: hashes of the state, and now and then energies and forces.
std::vector<double> seen_of(Simulation& simulation) {
  std::vector<double> seen;
  for (int step = 1; step <= kSteps; ++step) {
    simulation.step();
    if (step % 37 == 0) {
      const Energy energy = simulation.energy();
      seen.insert(seen.end(), {energy.kinetic, energy.damping, energy.gravity, energy.friction,
                               energy.external_work, energy.contact_elastic});
    }
    if (step % 50 == 0) {
      const auto hash = static_cast<std::uint32_t>(state_hash(simulation));
      seen.push_back(static_cast<double>(hash));
      for (const Vec3& force : simulation.forces().force)
        seen.insert(seen.end(), force.data(), force.data() + 3);
    }
  }
  seen.push_back(simulation.momentum_drift().linear);
  seen.push_back(simulation.time());
  seen.push_back(static_cast<double>(simulation.contacts().list_count()));
  return seen;
}

void leave_alone(Simulation& /*simulation*/) {}

/// A force of one's own on a sphere, towards the middle of all.
void pull_to_middle(Simulation& simulation) {
  simulation.add_force({NodeId{700}}, [](double, const NodeState& state, auto forces) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& place : state.position) sum += place;
    const auto count = static_cast<double>(state.size());
    forces[0].force = 10.0 * (sum / count - state.position[700]);
  });
}

void expect_same_bits(int count, bool by_chance, int threads = 1, double time_step = 0.0,
                      void (*prepare)(Simulation&) = leave_alone) {
  Simulation alone(shaking_cube(), options(1, time_step));
  prepare(alone);
  const std::vector<double> expected = seen_of(alone);
  ASSERT_GT(alone.contacts().list_count(), 3);
  ASSERT_GT(alone.contacts().counts().with_planes, 0U);
  ASSERT_GT(alone.contacts().counts().sphere_surface, 0U);
  std::mutex mutex;
  test::ThreadRanks(count, by_chance).run([&](geometry::Ranks& ranks) {
    Simulation together(shaking_cube(), options(threads, time_step),
                        contact::among_ranks(contact::linear_frictional(), ranks));
    prepare(together);
    const std::vector<double> seen = seen_of(together);
    const std::lock_guard lock(mutex);
    EXPECT_EQ(seen, expected) << "rank " << ranks.rank() << " of " << count;
  });
}

TEST(NodesOfRanks, HaveTheBitsOfOneProcessOnAnyNumberOfRanks) {
  for (const int count : {1, 2, 3, 5}) expect_same_bits(count, false);
}

TEST(NodesOfRanks, HaveThemWithOwnersByChanceAtEveryList) {
  for (const int count : {2, 5}) expect_same_bits(count, true);
}

TEST(NodesOfRanks, HaveThemWithAGivenStepAndThreadsInRanks) {
  expect_same_bits(2, false, 2, 1e-5);
}

TEST(NodesOfRanks, HaveThemWithAForceThatLooksAtAllNodes) {
  expect_same_bits(3, false, 1, 1e-5, pull_to_middle);
}

TEST(NodesOfRanks, MoveOnlySomeOfTheSpheresEach) {
  std::mutex mutex;
  std::vector<int> moved_by(shaking_cube().state.size(), 0);
  test::ThreadRanks(3).run([&](geometry::Ranks& ranks) {
    contact::SharedMotion* shared = nullptr;
    const auto watched = [&](contact::ContactScene scene) {
      auto contacts = contact::among_ranks(contact::linear_frictional(), ranks)(std::move(scene));
      shared = contacts->shared_motion();
      return contacts;
    };
    Simulation simulation(shaking_cube(), options(1, 1e-5), watched);
    simulation.step();
    const std::lock_guard lock(mutex);
    ASSERT_NE(shared, nullptr);
    for (const NodeId node : shared->own()) ++moved_by[index_of(node)];
    // What is acted on is moved by all of them, and the sheet.
    for (const NodeId node : {NodeId{0}, NodeId{500}, NodeId{900}})
      EXPECT_EQ(std::ranges::count(shared->common(), node), 1);
  });
  EXPECT_EQ(std::ranges::count_if(moved_by, [](int count) { return count > 1; }), 0);
  EXPECT_GT(std::ranges::count(moved_by, 1), static_cast<std::ptrdiff_t>(moved_by.size() / 2));
}

}  // namespace
}  // namespace plekton::dynamics::nodes_of_ranks_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/geometry/broad_phase_share.hpp"

#include "dynamics/simulation.hpp"
#include "geometry/neighbor/neighbours.hpp"
#include "tests/support/seeded_random.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace plekton::benchmarks {
namespace {

using contact::MaterialId;
using geometry::Vec3;

constexpr double kRadius = 1e-3;    // m
constexpr double kTimeStep = 4e-6;  // s, of the other benchmark scenes
constexpr int kWarmUp = 50;
constexpr int kSteps = 600;

/// A face-centred lattice of spheres of 0.85 to 1.15 radii that just touch on average, each moving.
dynamics::Scene moving_packing(int count, double speed) {
  dynamics::Scene scene;
  scene.materials = {{2e6, 2.0 / 7.0, 0.5}};
  test::Random random(1);
  const double spacing = 2.0 * std::numbers::sqrt2 * kRadius;
  const int side = static_cast<int>(std::ceil(std::cbrt(count / 4.0)));
  int placed = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        for (const Vec3& at :
             {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}) {
          if (placed++ == count) return scene;
          const Vec3 x = spacing * (Vec3(i, j, k) + at);
          const auto sphere =
              scene.add_sphere(x, kRadius * random.uniform(0.85, 1.0), 2500.0, MaterialId{0});
          const std::size_t node = index_of(scene.elements.spheres[index_of(sphere)].nodes[0]);
          scene.state.velocity[node] = random.in_cube(speed);
        }
      }
    }
  }
  return scene;
}

}  // namespace

nlohmann::ordered_json broad_phase_share(int spheres, double speed) {
  dynamics::SimulationOptions options;
  options.time_step = kTimeStep;
  dynamics::Simulation simulation(moving_packing(spheres, speed), options);
  for (int i = 0; i < kWarmUp; ++i) simulation.step();

  std::vector<double> plain, rebuilding;
  double total = 0.0;
  auto rebuilds = simulation.contacts().neighbours().rebuild_count();
  for (int i = 0; i < kSteps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulation.step();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    total += time.count();
    const auto now = simulation.contacts().neighbours().rebuild_count();
    (now == rebuilds ? plain : rebuilding).push_back(time.count());
    rebuilds = now;
  }
  if (plain.empty()) throw std::runtime_error("every step made the lists anew; nothing to compare");
  std::nth_element(plain.begin(), plain.begin() + static_cast<long>(plain.size() / 2), plain.end());
  const double usual = plain[plain.size() / 2];
  double extra = 0.0;
  for (const double time : rebuilding) extra += time - usual;
  return {{"broad_phase", "moving packing"},
          {"spheres", spheres},
          {"radius_per_step", speed * kTimeStep / kRadius},
          {"steps", kSteps},
          {"ms_per_step", 1e3 * total / kSteps},
          {"rebuilds", rebuilding.size()},
          {"share", extra / total}};
}

}  // namespace plekton::benchmarks

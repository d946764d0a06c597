// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/bed_maker.hpp"

#include "tests/benchmarks/scenes/parts.hpp"
#include "tests/benchmarks/scenes/sphere_bed.hpp"
#include "tests/support/seeded_random.hpp"

#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace plekton::benchmarks {
namespace {

constexpr double kSolidFraction = 0.6;     // of a settled bed, about
constexpr double kGridSpacing = 2.3e-3;    // m: the largest spheres do not touch, wherever they are
constexpr double kRestlessSpeed = 0.15;    // m/s
constexpr double kSettlingFriction = 0.1;  // lets a bed become dense
constexpr double kSettlingDamping = 0.1;
constexpr int kStepsBetweenLooks = 500;
constexpr int kLooksBetweenReports = 10;
constexpr double kLongestTime = 5.0;  // s
constexpr int kFlowSteps = 8000;      // 32 ms

double side_of(const BedOrder& order) {
  const auto count = static_cast<double>(order.spheres);
  if (order.kind == BedKind::slab) return 64.0 * kSphereRadius * std::sqrt(count / 5000.0);
  return kSphereRadius * std::cbrt(count * 4.0 / 3.0 * std::numbers::pi / kSolidFraction);
}

/// A grid of spheres, layer by layer, each somewhat off its place.
Bed loose_bed(const BedOrder& order) {
  Bed bed{side_of(order), 1.0, {}};
  const auto row = std::max<std::size_t>(1, static_cast<std::size_t>(bed.side / kGridSpacing));
  const double spacing = bed.side / static_cast<double>(row);
  test::Random random(order.seed);
  for (std::size_t i = 0; i < order.spheres; ++i) {
    const Vec3 cell(static_cast<double>(i % row) + 0.5, static_cast<double>(i / row % row) + 0.5,
                    static_cast<double>(i / row / row) + 0.5);
    const Vec3 place(spacing * cell.x(), spacing * cell.y(), kGridSpacing * cell.z());
    const double radius = kSphereRadius * random.uniform(0.9, 1.1);
    const Vec3 shift = random.in_cube(0.05 * kSphereRadius);
    bed.grains.push_back({place + shift, radius, random.in_cube(kRestlessSpeed), Vec3::Zero()});
  }
  return bed;
}

Bed bed_of(const BenchmarkSimulation& simulation, double side, double extent) {
  Bed bed{side, extent, {}};
  const auto& state = simulation.state();
  for (const auto& sphere : simulation.elements().spheres) {
    const std::size_t node = index_of(sphere.nodes[0]);
    bed.grains.push_back(
        {state.position[node], sphere.radius, state.velocity[node], state.angular_velocity[node]});
  }
  return bed;
}

double restlessness(const BenchmarkSimulation& simulation) {
  double weight_times_radius = 0.0;
  for (const auto& sphere : simulation.elements().spheres) {
    weight_times_radius +=
        simulation.properties().mass[index_of(sphere.nodes[0])] * kGravity.norm() * sphere.radius;
  }
  return simulation.energy().kinetic / weight_times_radius;
}

Bed settled(const Bed& loose, int threads, std::ostream& progress) {
  BenchmarkScene made = sphere_bed(loose);
  made.scene.materials[0].friction = kSettlingFriction;
  made.options.motion.damping = kSettlingDamping;
  made.options.time_step = 0.0;  // chosen, some three times as long as where time is measured
  made.options.threads = threads;
  BenchmarkSimulation simulation(std::move(made.scene), made.options);
  for (int look = 1; simulation.time() < kLongestTime; ++look) {
    for (int i = 0; i < kStepsBetweenLooks; ++i) simulation.step();
    const double now = restlessness(simulation);
    if (now < kRest) return bed_of(simulation, loose.side, loose.extent);
    if (look % kLooksBetweenReports == 0)
      progress << simulation.time() << " s: kinetic energy " << now << " m g r" << std::endl;
  }
  std::ostringstream text;
  text << "the bed did not come to rest within " << kLongestTime << " s; try another seed";
  throw std::runtime_error(text.str());
}

/// The bed some time after its box was made three times as long.
Bed collapsing(Bed bed, int threads) {
  bed.extent = 3.0;
  BenchmarkScene made = sphere_bed(bed);
  made.options.threads = threads;
  BenchmarkSimulation simulation(std::move(made.scene), made.options);
  for (int i = 0; i < kFlowSteps; ++i) simulation.step();
  return bed_of(simulation, bed.side, bed.extent);
}

}  // namespace

Bed make_bed(const BedOrder& order, std::ostream& progress) {
  if (order.spheres == 0) throw std::invalid_argument("a bed needs at least one sphere");
  const Bed bed = settled(loose_bed(order), order.threads, progress);
  return order.kind == BedKind::flow ? collapsing(bed, order.threads) : bed;
}

Bed side_by_side(const Bed& bed, int copies) {
  if (copies < 1) throw std::invalid_argument("copies of a bed: must be at least 1");
  Bed result{copies * bed.side, bed.extent, {}};
  const double length = bed.side * bed.extent;
  for (int j = 0; j < copies; ++j) {
    for (int i = 0; i < copies; ++i) {
      for (Bed::Grain grain : bed.grains) {
        grain.position += Vec3(i * length, j * bed.side, 0.0);
        result.grains.push_back(grain);
      }
    }
  }
  return result;
}

}  // namespace plekton::benchmarks

// SPDX-License-Identifier: GPL-3.0-or-later
// A18: a tube of a lattice of beams between clamped rings buckles as a thin shell of the same
// stiffness does. 1380 nodes and 4020 beams; radius 50 mm, length 0.1 m, beams of radius 1 mm.
//
// A lattice of equilateral triangles of side l, whose sides have the stiffness k = E A / l along
// and s = 12 E I / l³ across, stretches as a sheet of E_2D = 2 sqrt(3) k (1 + s / k) / (3 + s / k),
// and bends with D = sqrt(3) / 4 (3 E I + G J) / l. A cylindrical shell buckles under P = 4 pi
// sqrt(E_2D D) (Timoshenko & Gere, Theory of Elastic Stability (1961), 11.1), whatever its radius;
// a real one earlier, the more imperfect the earlier.
//
// Stout beams, s / k = 3 r² / l² = 0.109 here: E_2D is 1.0704 times that of bars, 2 k / sqrt(3),
// and P is 535.4 N, not the 517.5 N of bars. Beams that are too soft in shear by 2 r / l = 0.38
// (YADE) have 1.027 instead of 1.0704 and stay nearer to the 517.5 N.
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace plekton::test::a18_tube_test {
namespace {

using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using geometry::NodeId;
using geometry::Vec3;
using std::numbers::pi;

constexpr int kAround = 60;
constexpr int kAlong = 22;
constexpr double kTubeRadius = 0.05;   // m
constexpr double kBeamRadius = 0.001;  // m
constexpr double kModulus = 1e8;       // Pa
constexpr double kPoisson = 0.3;
constexpr double kDensity = 1000.0;                         // kg/m³
constexpr double kSide = 2.0 * pi * kTubeRadius / kAround;  // m, of a triangle, along the arc
const double kLength = kAlong * kSide * std::sqrt(0.75);    // m
constexpr double kImperfection = 1e-3 * kBeamRadius;        // m, of the radius, rms
constexpr int kSamples = 150;

/// Stiffness and buckling load of the shell.
struct Shell {
  double stretching;                                                                  // N/m
  double bending;                                                                     // N m
  double buckling() const { return 4.0 * pi * std::sqrt(stretching * bending); }      // N
  double stiffness() const { return stretching * 2.0 * pi * kTubeRadius / kLength; }  // N/m
};

Shell shell_of_lattice() {
  const auto beam = dynamics::circular_section(kBeamRadius, kModulus, kPoisson);
  const double along = kModulus * beam.area / kSide;
  const double across = 12.0 * kModulus * beam.second_moment / std::pow(kSide, 3);
  return {2.0 * std::sqrt(3.0) * along * (1.0 + across / along) / (3.0 + across / along),
          std::sqrt(3.0) / 4.0 *
              (3.0 * kModulus * beam.second_moment + beam.shear_modulus * beam.torsion_constant) /
              kSide};
}

/// The upper ring comes down by this much (m) in this time (s).
Scene tube_between_rings(double shortening, double time) {
  geometry::Mesh mesh = geometry::tube({kTubeRadius, kLength, kAround, kAlong});
  Random random(7);
  Scene scene;
  dynamics::PrescribedMotion upper;
  upper.held = Held::everything;
  upper.velocity = Vec3(0.0, 0.0, -shortening / time);
  for (Vec3 x : mesh.points) {
    const double bulge = kImperfection / kTubeRadius * random.uniform(-1.0, 1.0) * std::sqrt(3.0);
    x.head<2>() *= 1.0 + bulge;
    const bool is_lower = x.z() < 1e-9;
    const NodeId node = scene.add_node(x, is_lower ? Held::everything : Held::nothing);
    if (x.z() > kLength - 1e-9) upper.nodes.push_back(node);
  }
  const auto beam = dynamics::circular_section(kBeamRadius, kModulus, kPoisson);
  for (const auto& [a, b] : geometry::make_membrane(mesh, {.thickness = 2.0 * kBeamRadius}).edges)
    scene.add_beam(a, b, beam, kDensity);
  // Heavier against turning than the beams are: the step is set by their stretching then, and what
  // is slow does not change.
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scene.properties.inertia[i] = scene.properties.mass[i] * kSide * kSide / 60.0;
  scene.loads.motions.push_back(upper);
  return scene;
}

struct Compression {
  double peak = 0.0;       // N
  double stiffness = 0.0;  // N/m, at the start
  double last = 0.0;       // N
};

Compression compress(double shortening, double time) {
  dynamics::SimulationOptions options;
  options.time_step = 0.3 * kSide * std::sqrt(kDensity / kModulus);
  options.motion.damping = 0.2;
  const Scene scene = tube_between_rings(shortening, time);
  const std::vector<NodeId> upper = scene.loads.motions.front().nodes;
  Simulation simulation(scene, options);
  Compression result;
  double uu = 0.0, uf = 0.0;
  for (int sample = 1; sample <= kSamples; ++sample) {
    while (simulation.time() < time * sample / kSamples) simulation.step();
    double force = 0.0;
    for (const NodeId node : upper) force += simulation.forces().force[index_of(node)].z();
    const double u = shortening * simulation.time() / time;
    result.peak = std::max(result.peak, force);
    result.last = force;
    if (sample > 5 && sample <= 20) {
      uu += u * u;
      uf += u * force;
    }
  }
  result.stiffness = uf / uu;
  return result;
}

// The rings come together by 2.2 times the shortening at P in 0.3 s, which is slow: in 0.15 s the
// peak is 3 % higher, in 0.6 s 2 % lower. Poisson's effect is held back at the rings, which makes
// the tube a little stiffer than K = 2 pi R E_2D / H.
TEST(A18Tube, BucklesAsAShellOfItsStiffness) {
  const Shell shell = shell_of_lattice();
  EXPECT_NEAR(shell.buckling(), 517.54 * std::sqrt(1.0704), 0.1);
  const double at_buckling = shell.buckling() / shell.stiffness();

  const Compression tube = compress(2.2 * at_buckling, 0.3);

  std::printf("tube: P_peak / P_cr = %.3f, stiffness %.3f of the shell's, %.2f P_cr at the end\n",
              tube.peak / shell.buckling(), tube.stiffness / shell.stiffness(),
              tube.last / shell.buckling());
  EXPECT_GT(tube.peak, 0.90 * shell.buckling());
  EXPECT_LT(tube.peak, 1.05 * shell.buckling());
  EXPECT_GT(tube.stiffness, 1.00 * shell.stiffness());
  EXPECT_LT(tube.stiffness, 1.06 * shell.stiffness());
  EXPECT_LT(tube.last, 0.7 * shell.buckling());  // it has buckled
}

}  // namespace
}  // namespace plekton::test::a18_tube_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::apps::tube {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;
using std::numbers::pi;

constexpr int kAround = 60;
constexpr int kAlong = 22;
constexpr double kTube = 0.05;   // m, radius
constexpr double kBeam = 0.001;  // m, radius of the beams
constexpr double kModulus = 1e8;
constexpr double kPoisson = 0.3;
constexpr double kDensity = 1000.0;                   // kg/m³
constexpr double kSide = 2.0 * pi * kTube / kAround;  // m, of a triangle, along the arc
const double kLength = kAlong * kSide * std::sqrt(0.75);
constexpr int kSamples = 300;
constexpr double kImperfection = 1e-3 * kBeam;  // m, of the radius, rms

/// A lattice of equilateral triangles as a sheet: springs along its sides and across them.
struct Sheet {
  double stretching;                                                              // N/m
  double bending;                                                                 // N m
  double buckling() const { return 4.0 * pi * std::sqrt(stretching * bending); }  // N
  double stiffness() const { return stretching * 2.0 * pi * kTube / kLength; }    // N/m
};

Sheet sheet_of_lattice() {
  const auto beam = dynamics::circular_section(kBeam, kModulus, kPoisson);
  const double along = kModulus * beam.area / kSide;
  const double across = 12.0 * kModulus * beam.second_moment / (kSide * kSide * kSide);
  return {2.0 * std::sqrt(3.0) * along * (1.0 + across / along) / (3.0 + across / along),
          std::sqrt(3.0) / 4.0 *
              (3.0 * kModulus * beam.second_moment + beam.shear_modulus * beam.torsion_constant) /
              kSide};
}

/// m, what a node is out of the round: evenly spread by multiples of the golden ratio, which repeat
/// nowhere around the tube.
double imperfection_of(std::size_t node) {
  const double multiple = static_cast<double>(node) * std::numbers::phi;
  return kImperfection * std::sqrt(12.0) * (multiple - std::floor(multiple) - 0.5);
}

/// The upper ring comes down with a speed (m/s), the lower one stands; neither turns.
dynamics::Scene tube_between_rings(double speed) {
  const geometry::Mesh mesh = geometry::tube({kTube, kLength, kAround, kAlong});
  dynamics::Scene scene;
  dynamics::PrescribedMotion upper;
  upper.held = Held::everything;
  upper.velocity = Vec3(0.0, 0.0, -speed);
  for (Vec3 x : mesh.points) {
    x.head<2>() *= 1.0 + imperfection_of(scene.state.size()) / kTube;
    const NodeId node =
        scene.add_node(x, x.z() < 0.25 * kLength / kAlong ? Held::everything : Held::nothing);
    if (x.z() > kLength - 0.25 * kLength / kAlong) upper.nodes.push_back(node);
  }
  const auto beam = dynamics::circular_section(kBeam, kModulus, kPoisson);
  for (const auto& [a, b] : geometry::make_membrane(mesh, {.thickness = 2.0 * kBeam}).edges)
    scene.add_beam(a, b, beam, kDensity);
  // Heavier against turning than the beams are: their stretching sets the step then, and what is
  // slow does not change.
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    scene.properties.inertia[i] = scene.properties.mass[i] * kSide * kSide / 60.0;
  scene.loads.motions.push_back(upper);
  return scene;
}

struct Compression {
  std::vector<double> shortening;  // m
  std::vector<double> force;       // N
};

Compression compressed(double shortening, double time) {
  dynamics::SimulationOptions options;
  options.time_step = 0.3 * kSide * std::sqrt(kDensity / kModulus);
  options.motion.damping = 0.2;
  dynamics::Scene scene = tube_between_rings(shortening / time);
  const std::vector<NodeId> upper = scene.loads.motions.front().nodes;
  dynamics::Simulation simulation(std::move(scene), options);
  Compression result;
  for (int sample = 1; sample <= kSamples; ++sample) {
    while (simulation.time() < time * sample / kSamples) simulation.step();
    double force = 0.0;
    for (const NodeId node : upper) force += simulation.forces().force[index_of(node)].z();
    result.shortening.push_back(shortening * simulation.time() / time);
    result.force.push_back(force);
  }
  return result;
}

/// N/m, of the line through the origin nearest to the points in a tenth to two fifths of the load.
double first_stiffness(const Compression& tube, double at_buckling) {
  double uu = 0.0;
  double uf = 0.0;
  for (std::size_t i = 0; i < tube.force.size(); ++i) {
    const double u = tube.shortening[i];
    if (u < 0.1 * at_buckling || u > 0.4 * at_buckling) continue;
    uu += u * u;
    uf += u * tube.force[i];
  }
  return uf / uu;
}

}  // namespace

/// A shell buckles under 4 pi sqrt(C D), whatever its radius: C its stiffness in stretching, D in
/// bending (Timoshenko and Gere, Theory of Elastic Stability (1961), 11.1).
CaseReport validate(bool full) {
  const Sheet sheet = sheet_of_lattice();
  const double load = sheet.buckling();
  const double at_buckling = load / sheet.stiffness();
  // The ring moves on while buckles grow: the slower, the nearer to theory.
  const Compression tube = compressed(2.2 * at_buckling, full ? 0.6 : 0.3);
  CaseReport report;
  report.findings = {
      {"largest force over theory", *std::max_element(tube.force.begin(), tube.force.end()) / load,
       0.975, 0.075, "", "4 pi sqrt(C D), thin shells; 0.90 to 1.05"},
      {"stiffness over theory", first_stiffness(tube, at_buckling) / sheet.stiffness(), 1.03, 0.03,
       "", "2 pi R C / H, more where rings hold Poisson's effect: 1.00 to 1.06"},
      {"force in the end over theory", tube.force.back() / load, 0.35, 0.35, "",
       "it has buckled: below 0.7"}};
  Curve theory{"theory", CurveStyle::dashed, {0.0, at_buckling, tube.shortening.back()}, {}};
  theory.y = {0.0, load, load};
  report.figures.push_back({"A tube of a lattice is shortened",
                            "shortening (m)",
                            "force (N)",
                            {{"Plekton", CurveStyle::line, tube.shortening, tube.force},
                             std::move(theory),
                             recorded_curve("yade_tube")}});
  return report;
}

}  // namespace plekton::apps::tube

// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::apps::bounce {
namespace {

using dynamics::Held;
using geometry::Vec3;

constexpr contact::MaterialId kMaterial{0};
constexpr double kBall = 0.1;  // m, radius of both spheres
constexpr double kDegree = std::numbers::pi / 180.0;
const double kSlope = 16.35 * kDegree;
const Vec3 kNormal(elementary::sin(kSlope), 0.0, elementary::cos(kSlope));  // of the incline

/// A hollow sphere of facets with a beam along each of their sides.
struct Shell {
  int subdivisions;
  double radius;   // m, of facets and beams
  double modulus;  // Pa
  double density;  // kg/m³
};

/// @returns the number of its nodes; they follow those that are there
std::size_t add_shell(dynamics::Scene& scene, const Shell& shell, const Vec3& centre) {
  const auto mesh = geometry::icosphere(kBall, shell.subdivisions);
  const std::size_t first = scene.state.size();
  for (const Vec3& x : mesh.points) scene.add_node(centre + x, Held::nothing);
  const auto membrane =
      geometry::make_membrane(mesh, {.thickness = 2.0 * shell.radius, .first_node = first});
  for (const auto& facet : membrane.facets)
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], shell.radius, kMaterial);
  const auto section = dynamics::circular_section(shell.radius, shell.modulus, 0.3);
  for (const auto& [a, b] : membrane.edges) scene.add_beam(a, b, section, shell.density);
  return mesh.points.size();
}

/// Centre of mass of the last nodes of a simulation, along a direction, and its velocity.
struct Along {
  double place = 0.0;  // m
  double speed = 0.0;  // m/s
};

Along centre_along(const dynamics::Simulation& simulation, std::size_t nodes, const Vec3& way) {
  Along sum;
  double mass = 0.0;
  for (std::size_t i = simulation.state().size() - nodes; i < simulation.state().size(); ++i) {
    const double m = simulation.properties().mass[i];
    mass += m;
    sum.place += m * simulation.state().position[i].dot(way);
    sum.speed += m * simulation.state().velocity[i].dot(way);
  }
  return {sum.place / mass, sum.speed / mass};
}

struct Bounce {
  std::vector<double> times;   // s
  std::vector<double> places;  // m, of the centre
  double restitution = 0.0;
  double energy_error = 0.0;  // largest, over the energy at the start
  double drift = 0.0;         // m, largest, out of the plane of symmetry
};

/// The shell flies against a wall with 1 m/s; no gravity, no friction.
Bounce on_wall(double time_step) {
  constexpr double kTime = 0.1;  // s
  const Shell shell{2, 0.004, 5e6, 1000.0};
  dynamics::Scene scene;
  scene.materials = {{shell.modulus, 0.3, 0.0}};
  const std::size_t nodes = add_shell(scene, shell, Vec3::Zero());
  for (Vec3& velocity : scene.state.velocity) velocity = Vec3(0.0, 0.0, -1.0);
  scene.planes.push_back(
      {Vec3(0.0, 0.0, -kBall - shell.radius - 1e-3), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  dynamics::Simulation simulation(std::move(scene), options);
  Bounce bounce;
  while (simulation.time() < kTime) {
    simulation.step();
    const Along centre = centre_along(simulation, nodes, Vec3::UnitZ());
    bounce.times.push_back(simulation.time());
    bounce.places.push_back(centre.place);
    bounce.restitution = centre.speed;  // it came with 1 m/s
    const dynamics::Energy energy = simulation.energy();
    keep_largest(bounce.energy_error, std::abs(energy.closure_error()) / energy.initial);
  }
  return bounce;
}

void add_incline(dynamics::Scene& scene, double radius) {
  const double fall = elementary::tan(kSlope);
  for (const auto& [x, y] : {std::pair{-0.4, -0.6}, {1.2, -0.6}, {1.2, 0.6}, {-0.4, 0.6}})
    scene.add_node(Vec3(x, y, -x * fall), Held::everything);
  using geometry::NodeId;
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, radius, kMaterial);
  scene.add_facet(NodeId{0}, NodeId{2}, NodeId{3}, radius, kMaterial);
}

/// A stiffer shell falls on an incline of two facets.
Bounce on_incline(double friction, double time_step) {
  constexpr double kTime = 0.45;                            // s
  constexpr double kFirstTouch = 0.15, kSecondFall = 0.21;  // s, between which it bounces
  constexpr double kPlace = 0.1;                            // m, y of the plane of symmetry
  const Shell shell{1, 0.005, 3e8, 2650.0};
  dynamics::Scene scene;
  scene.materials = {{shell.modulus, 0.3, friction}};
  add_incline(scene, shell.radius);
  const std::size_t nodes = add_shell(scene, shell, Vec3(0.02, kPlace, 0.16 + 2.0 * shell.radius));
  dynamics::SimulationOptions options;
  options.time_step = time_step;
  options.motion.gravity = Vec3(0.0, 0.0, -9.81);
  dynamics::Simulation simulation(std::move(scene), options);
  Bounce bounce;
  double fastest_in = 0.0;
  double fastest_out = 0.0;
  while (simulation.time() < kTime) {
    simulation.step();
    const Along centre = centre_along(simulation, nodes, kNormal);
    bounce.times.push_back(simulation.time());
    bounce.places.push_back(centre.place);
    keep_largest(bounce.drift,
                 std::abs(centre_along(simulation, nodes, Vec3::UnitY()).place - kPlace));
    if (simulation.time() < kFirstTouch) fastest_in = std::max(fastest_in, -centre.speed);
    if (simulation.time() < kSecondFall) fastest_out = std::max(fastest_out, centre.speed);
  }
  bounce.restitution = fastest_out / fastest_in;
  return bounce;
}

void add_wall(CaseReport& report, bool full) {
  constexpr double kStep = 8.5e-5;  // s
  const Bounce whole = on_wall(kStep);
  const Bounce half = on_wall(0.5 * kStep);
  // The band is what elastic shells of this kind come to; 1 is the limit of energy.
  report.findings.push_back({"restitution on a wall, 1 m/s", whole.restitution, 0.925, 0.075, "",
                             "elastic: 0.85 to 1, the rest is vibration"});
  report.findings.push_back({"change of that with half the step", half.restitution,
                             whole.restitution, 5e-3 * whole.restitution, "",
                             "that with the whole step, 0.5 %"});
  report.findings.push_back({"largest error of the energy, of all of it", whole.energy_error, 0.0,
                             5e-3, "", "elastic: energy is kept"});
  Figure figure{"A hollow sphere hits a wall", "time (s)", "height of its centre (m)", {}};
  figure.curves = {{"Plekton", CurveStyle::line, whole.times, whole.places},
                   {"half the step", CurveStyle::dashed, half.times, half.places},
                   recorded_curve("yade_bounce")};
  if (full) {
    const Bounce fine = on_wall(0.125 * kStep);
    report.findings.push_back({"change with an eighth of the step", fine.restitution,
                               whole.restitution, 5e-3 * whole.restitution, "",
                               "that with the whole step, 0.5 %"});
  }
  report.figures.push_back(std::move(figure));
}

/// @param recorded  name of YADE's curve
/// @param yade      restitution that YADE comes to
void add_slope(CaseReport& report, double degrees, const char* recorded, double yade) {
  constexpr double kStep = 2.25e-5;  // s
  const double friction = elementary::tan(degrees * kDegree);
  const Bounce whole = on_incline(friction, kStep);
  const Bounce half = on_incline(friction, 0.5 * kStep);
  const std::string which = fmt::format("on an incline, friction {} deg", degrees);
  report.findings.push_back({"restitution " + which, whole.restitution, yade, 0.05 * yade, "",
                             "YADE 2023.02a, y19_bounce_incline.py, to 5 %; elastic: at most 1"});
  report.findings.push_back({"restitution " + which + ", half the step", half.restitution,
                             whole.restitution, 5e-3 * whole.restitution, "",
                             "that with the whole step, 0.5 %"});
  report.findings.push_back(
      {"way out of the plane of symmetry " + which, whole.drift, 0.0, 1e-9, "m", "symmetry"});
  report.figures.push_back({"A hollow sphere bounces " + which,
                            "time (s)",
                            "distance of its centre from the incline's middle (m)",
                            {{"Plekton", CurveStyle::line, whole.times, whole.places},
                             {"half the step", CurveStyle::dashed, half.times, half.places},
                             recorded_curve(recorded)}});
}

}  // namespace

/// What a hollow sphere loses in a bounce it keeps as vibrations: no closed form, but limits.
CaseReport validate(bool full) {
  CaseReport report;
  add_wall(report, full);
  add_slope(report, 20.0, "yade_incline_phi20", 0.9552);
  add_slope(report, 0.0, "yade_incline_phi0", 0.7668);
  return report;
}

}  // namespace plekton::apps::bounce

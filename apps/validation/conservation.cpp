// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"

#include <array>
#include <cmath>

namespace plekton::apps::conservation {
namespace {

using geometry::NodeId;
using geometry::Vec3;

/// Nothing is held, no gravity, no damping: both momenta stay, and energy goes only into friction.
dynamics::Scene collision() {
  constexpr double kSphere = 0.05;     // m
  constexpr double kFacet = 0.02;      // m, half of the thickness
  constexpr double kDensity = 1000.0;  // kg/m³
  constexpr contact::MaterialId kMaterial{0};
  dynamics::Scene scene;
  scene.materials = {{1e7, 0.3, 0.7}};
  const auto section = dynamics::circular_section(kFacet, 1e7, 0.3);
  const std::array<NodeId, 3> nodes = {scene.add_node(Vec3(-0.2, -0.1, 0.0)),
                                       scene.add_node(Vec3(0.2, -0.12, 0.0)),
                                       scene.add_node(Vec3(0.03, 0.25, 0.0))};
  for (std::size_t i = 0; i < 3; ++i)
    scene.add_beam(nodes[i], nodes[(i + 1) % 3], section, kDensity);
  scene.add_facet(nodes[0], nodes[1], nodes[2], kFacet, kMaterial);
  scene.add_sphere(Vec3(0.05, 0.02, kSphere + kFacet + 1e-4), kSphere, kDensity, kMaterial);
  scene.state.velocity.back() = Vec3(0.5, 0.2, -1.0);
  scene.state.angular_velocity.back() = Vec3(3.0, -5.0, 7.0);
  return scene;
}

struct Momenta {
  Vec3 linear = Vec3::Zero();   // kg m/s
  Vec3 angular = Vec3::Zero();  // kg m²/s, about the origin
};

Momenta momenta_of(const dynamics::Simulation& simulation) {
  Momenta momenta;
  const auto& state = simulation.state();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 linear = simulation.properties().mass[i] * state.velocity[i];
    momenta.linear += linear;
    momenta.angular += state.position[i].cross(linear) +
                       simulation.properties().inertia[i] * state.angular_velocity[i];
  }
  return momenta;
}

}  // namespace

CaseReport validate(bool full) {
  dynamics::SimulationOptions options;
  options.time_step = full ? 1e-7 : 1e-6;
  dynamics::Simulation simulation(collision(), options);
  const Momenta before = momenta_of(simulation);
  double linear = 0.0;
  double angular = 0.0;
  double closure = 0.0;
  double collisions = 0.0;
  bool touches = false;
  std::vector<double> times;
  std::vector<double> kinetic;
  std::vector<double> elastic;
  std::vector<double> friction;
  std::vector<double> sum;
  while (simulation.time() < 0.012) {
    simulation.step();
    const Momenta now = momenta_of(simulation);
    const dynamics::Energy energy = simulation.energy();
    keep_largest(linear, (now.linear - before.linear).norm() / before.linear.norm());
    keep_largest(angular, (now.angular - before.angular).norm() / before.angular.norm());
    keep_largest(closure, std::abs(energy.closure_error()) / energy.initial);
    collisions += energy.contact_elastic > 0.0 && !touches ? 1.0 : 0.0;
    touches = energy.contact_elastic > 0.0;
    times.push_back(simulation.time());
    kinetic.push_back(energy.kinetic);
    elastic.push_back(energy.contact_elastic + energy.bond_elastic);
    friction.push_back(energy.friction);
    sum.push_back(kinetic.back() + elastic.back() + friction.back());
  }
  CaseReport report;
  report.findings = {
      {"change of the momentum, of itself", linear, 0.0, 1e-10, "", "Newton's third law"},
      {"change of the moment of momentum, of itself", angular, 0.0, 1e-10, "",
       "Newton's third law; YADE 2023.02a: 0.096 (recorded run)"},
      {"energy from nowhere, of all", closure, 0.0, 1e-3, "", "conservation of energy"},
      {"collisions of the sphere with the facet", collisions, 1.0, 0.0, "",
       "it flies at its middle"}};
  Figure figure{"A free collision with friction", "time (s)", "energy (J)", {}};
  figure.curves = {{"kinetic", CurveStyle::line, times, kinetic},
                   {"elastic", CurveStyle::line, times, elastic},
                   {"taken by friction", CurveStyle::line, times, friction},
                   {"sum", CurveStyle::dashed, times, sum}};
  report.figures.push_back(std::move(figure));
  return report;
}

}  // namespace plekton::apps::conservation

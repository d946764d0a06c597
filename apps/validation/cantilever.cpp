// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plekton::apps::cantilever {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kLength = 1.0;       // m
constexpr double kRadius = 0.05;      // m
constexpr double kDeflection = 1e-4;  // m, of the end; what is not linear is below its square
constexpr double kDensity = 1000.0;   // kg/m³

/// Deflection (m) at a place: w = P x² (3 L - x) / (6 E I), Euler and Bernoulli.
double deflection_at(double x) {
  return kDeflection * x * x * (3.0 * kLength - x) / (2.0 * kLength * kLength * kLength);
}

struct Bent {
  std::vector<double> x;  // m
  std::vector<double> w;  // m
};

/// Beams in a row, clamped at one end, come to rest under a load at the other.
Bent bent(int beams) {
  const auto section = dynamics::circular_section(kRadius, 1e9, 0.25);
  const double bending = section.young_modulus * section.second_moment;
  dynamics::Scene scene;
  std::vector<NodeId> nodes;
  for (int i = 0; i <= beams; ++i) {
    nodes.push_back(scene.add_node(Vec3(kLength * i / beams, 0.0, 0.0),
                                   i == 0 ? Held::everything : Held::nothing));
    if (i > 0) scene.add_beam(nodes[nodes.size() - 2], nodes.back(), section, kDensity);
  }
  dynamics::NodalForce load;
  load.nodes = {nodes.back()};
  load.force = Vec3(0.0, 0.0, 3.0 * bending / (kLength * kLength * kLength) * kDeflection);
  scene.loads.forces.push_back(load);
  // Critical damping of the slowest mode, 1.8751² / L² sqrt(E I / (rho A)); the faster ones fade
  // with half of the rate.
  const double slowest =
      3.516 / (kLength * kLength) * std::sqrt(bending / (kDensity * section.area));
  dynamics::MassDamping damping;
  damping.nodes = nodes;
  damping.rate = 2.0 * slowest;
  scene.loads.mass_damping.push_back(damping);
  dynamics::Simulation simulation(std::move(scene), {});
  // One beam alone, with its mass at its ends, is slower than that, and creeps.
  while (simulation.time() < 80.0 / slowest) simulation.step();
  Bent result;
  for (const Vec3& x : simulation.state().position) {
    result.x.push_back(x.x());
    result.w.push_back(x.z());
  }
  return result;
}

}  // namespace

CaseReport validate(bool full) {
  CaseReport report;
  Figure figure{"Cantilever under a load at its end", "place (m)", "deflection (m)", {}};
  const std::vector<int> numbers =
      full ? std::vector<int>{1, 2, 4, 8, 16, 32} : std::vector<int>{1, 2, 8};
  Curve ends{"Plekton", CurveStyle::line, {}, {}};
  for (const int beams : numbers) {
    const Bent result = bent(beams);
    report.findings.push_back(
        {fmt::format("deflection of the end, {} beam{}", beams, beams > 1 ? "s" : ""),
         result.w.back(), kDeflection, 1e-5 * kDeflection, "m",
         "Euler-Bernoulli: P L³ / (3 E I), exact at nodes"});
    ends.x.push_back(beams);
    ends.y.push_back(result.w.back());
    if (beams <= 8)
      figure.curves.push_back(
          {fmt::format("{} beams", beams), CurveStyle::points, result.x, result.w});
  }
  Curve theory{"Euler-Bernoulli", CurveStyle::dashed, {}, {}};
  for (int i = 0; i <= 100; ++i) {
    theory.x.push_back(0.01 * i * kLength);
    theory.y.push_back(deflection_at(theory.x.back()));
  }
  figure.curves.push_back(std::move(theory));
  report.figures.push_back(std::move(figure));
  Curve exact{"Euler-Bernoulli", CurveStyle::dashed, ends.x, {}};
  exact.y.assign(exact.x.size(), kDeflection);
  report.figures.push_back({"How many beams the cantilever has",
                            "beams",
                            "deflection of its end (m)",
                            {ends, exact, recorded_curve("yade_cantilever")}});
  return report;
}

}  // namespace plekton::apps::cantilever

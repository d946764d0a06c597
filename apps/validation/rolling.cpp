// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generators.hpp"

#include <cmath>
#include <numbers>

namespace plekton::apps::rolling {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSphere = 0.05;     // m
constexpr double kSheet = 0.01;      // m, half of the thickness
constexpr double kYoung = 1e7;       // Pa
constexpr double kDensity = 2500.0;  // kg/m³
constexpr double kGravity = 9.81;    // m/s²
constexpr double kTime = 0.6;        // s
constexpr double kMass = kDensity * 4.0 / 3.0 * std::numbers::pi * kSphere * kSphere * kSphere;
constexpr double kStiffness = 2.0 * kYoung * kSphere * kSheet / (kSphere + kSheet);  // N/m
constexpr contact::MaterialId kMaterial{0};

struct Descent {
  std::vector<double> times;   // s
  std::vector<double> places;  // m, from the start

  /// m/s², the mean from the start: 2 s / t².
  double acceleration() const { return 2.0 * places.back() / (times.back() * times.back()); }
};

/// A sphere is let go on a fixed sheet, gravity turned by the slope (rad).
Descent descent(double slope, double friction, int cells) {
  dynamics::Scene scene;
  scene.materials = {{kYoung, 0.3, friction}};
  const auto mesh =
      geometry::plane_sheet({.width = 3.2, .length = 0.6, .cells_x = cells, .cells_y = 4});
  for (const Vec3& x : mesh.points) scene.add_node(x + Vec3(1.4, 0.0, 0.0), Held::everything);
  for (const auto& [a, b, c] : mesh.facets) scene.add_facet(a, b, c, kSheet, kMaterial);
  const double overlap = kMass * kGravity * elementary::cos(slope) / kStiffness;
  const Vec3 start(0.07, 0.013, kSphere + kSheet - overlap);
  scene.add_sphere(start, kSphere, kDensity, kMaterial);
  dynamics::SimulationOptions options;
  options.time_step = 0.1 * std::sqrt(kMass / kStiffness);
  options.motion.gravity = kGravity * Vec3(elementary::sin(slope), 0.0, -elementary::cos(slope));
  dynamics::Simulation simulation(std::move(scene), options);
  Descent descent;
  while (simulation.time() < kTime) {
    simulation.step();
    descent.times.push_back(simulation.time());
    descent.places.push_back((simulation.state().position.back() - start).x());
  }
  return descent;
}

/// @param recorded  name of the curve of another program
Figure figure_of(const std::string& title, const Descent& descent, double acceleration,
                 std::string_view recorded) {
  std::vector<double> theory;
  for (const double t : descent.times) theory.push_back(0.5 * acceleration * t * t);
  return {title,
          "time (s)",
          "way (m)",
          {{"Plekton", CurveStyle::line, descent.times, descent.places},
           {"rigid sphere", CurveStyle::dashed, descent.times, theory},
           recorded_curve(recorded)}};
}

}  // namespace

/// A rigid sphere of inertia 2/5 m R² rolls with 5/7 g sin(slope), and slides with
/// g (sin(slope) - mu cos(slope)).
CaseReport validate(bool full) {
  constexpr double kTolerance = 2e-3;  // until the spring is loaded there is less friction
  constexpr double kDegree = std::numbers::pi / 180.0;
  const int cells = full ? 160 : 16;
  const double roll = 5.0 / 7.0 * kGravity * elementary::sin(10.0 * kDegree);
  const double mu = elementary::tan(5.0 * kDegree);
  const double slide =
      kGravity * (elementary::sin(30.0 * kDegree) - mu * elementary::cos(30.0 * kDegree));
  const Descent rolling = descent(10.0 * kDegree, elementary::tan(30.0 * kDegree), cells);
  const Descent sliding = descent(30.0 * kDegree, mu, cells);
  CaseReport report;
  report.findings = {{"acceleration, rolling down 10 deg", rolling.acceleration(), roll,
                      kTolerance * roll, "m/s2", "rigid sphere: 5/7 g sin(slope)"},
                     {"acceleration, sliding down 30 deg", sliding.acceleration(), slide,
                      kTolerance * slide, "m/s2", "Coulomb: g (sin - mu cos)"}};
  report.figures = {figure_of("Rolling down 10 degrees", rolling, roll, "yade_rolling"),
                    figure_of("Sliding down 30 degrees", sliding, slide, "yade_sliding")};
  return report;
}

}  // namespace plekton::apps::rolling

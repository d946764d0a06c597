// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps::fold {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSphere = 0.1;     // m
constexpr double kSheet = 0.02;     // m, half of the thickness
constexpr double kYoung = 1e6;      // Pa
constexpr double kOverlap = 0.002;  // m
constexpr double kStiffness = 2.0 * kYoung * kSphere * kSheet / (kSphere + kSheet);  // N/m
constexpr double kForce = kStiffness * kOverlap;                                     // N
constexpr double kDistance = kSphere + kSheet - kOverlap;                            // m
constexpr double kStart = 0.80137;  // m, from the fold, across it
constexpr double kSlope = 20.0 * std::numbers::pi / 180.0;
constexpr contact::MaterialId kMaterial{0};

/// A sheet folded along y, both halves at a slope (rad, above 0: a ridge); cells cut by turns.
dynamics::Scene folded_sheet(double slope) {
  constexpr std::array<double, 5> kAcross{-1.0, -0.5, 0.0, 0.5, 1.0};  // m
  constexpr std::array<double, 3> kAlong{-0.6, 0.05, 0.7};             // m
  dynamics::Scene scene;
  scene.materials = {{kYoung, 0.3, 0.0}};
  for (const double x : kAcross)
    for (const double y : kAlong)
      scene.add_node(Vec3(x, y, -std::abs(x) * elementary::tan(slope)), Held::everything);
  const auto node = [](int i, int j) { return NodeId{i * 3 + j}; };
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 2; ++j) {
      const bool is_rising = (i + j) % 2 == 0;
      const NodeId a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      scene.add_facet(a, b, is_rising ? c : d, kSheet, kMaterial);
      scene.add_facet(is_rising ? a : b, c, d, kSheet, kMaterial);
    }
  }
  return scene;
}

/// Where a sphere is, and the force that it should feel there.
struct Place {
  Vec3 centre;
  Vec3 force;
};

/// On either side of a ridge, and around it, one contact all the way.
Place over_ridge(double way) {
  const double side = kStart / elementary::cos(kSlope);
  const double arc = 2.0 * kSlope * kDistance;
  const double along = way - side - std::clamp(way - side, 0.0, arc);
  const double turned = std::clamp(way - side, 0.0, arc) / kDistance - kSlope;
  const Vec3 normal(elementary::sin(turned), 0.0, elementary::cos(turned));
  const Vec3 forward(elementary::cos(turned), 0.0, -elementary::sin(turned));
  return {kDistance * normal + along * forward, kForce * normal};
}

/// Down into a valley and up again; near its bottom the other side pushes too.
Place through_valley(double way) {
  const double side = kStart / elementary::cos(kSlope);
  const double from_bottom = way - side;
  const double sign = from_bottom < 0.0 ? -1.0 : 1.0;
  const double height =
      kDistance / elementary::cos(kSlope) + std::abs(from_bottom) * elementary::sin(kSlope);
  const auto normal = [&](double of) {
    return Vec3(-of * elementary::sin(kSlope), 0.0, elementary::cos(kSlope));
  };
  const double other = kOverlap - std::abs(from_bottom) * elementary::sin(2.0 * kSlope);
  return {Vec3(from_bottom * elementary::cos(kSlope), 0.0, height),
          kForce * normal(sign) + kStiffness * std::max(0.0, other) * normal(-sign)};
}

struct Felt {
  std::vector<double> way;       // m
  std::vector<double> force;     // N
  std::vector<double> expected;  // N
  double worst = 0.0;            // N, of any component
};

/// Puts the sphere on so many places, one after the other, a little aside along the fold each.
Felt felt_over(double slope, Place (*place_at)(double way), double whole, int places) {
  constexpr double kAside = 0.12;  // m
  const dynamics::Scene sheet = folded_sheet(slope);
  Felt felt;
  for (int i = 0; i <= places; ++i) {
    const double way = whole * i / places;
    const Place place = place_at(way);
    dynamics::Scene scene = sheet;
    scene.add_sphere(place.centre + (kAside * i / places - 0.08) * Vec3::UnitY(), kSphere, 2500.0,
                     kMaterial);
    scene.properties.held.back() = Held::everything;
    dynamics::SimulationOptions options;
    options.time_step = 1e-6;
    dynamics::Simulation simulation(std::move(scene), options);
    simulation.step();
    const Vec3 force = simulation.forces().force.back();
    felt.way.push_back(way);
    felt.force.push_back(force.norm());
    felt.expected.push_back(place.force.norm());
    const double off = (force - place.force).norm();
    if (!(off <= felt.worst)) felt.worst = off;  // also what is no number
  }
  return felt;
}

Figure figure_of(const std::string& title, const Felt& felt, std::string_view recorded) {
  return {title,
          "way (m)",
          "force (N)",
          {{"Plekton", CurveStyle::line, felt.way, felt.force},
           {"closed form", CurveStyle::dashed, felt.way, felt.expected},
           recorded_curve(recorded)}};
}

}  // namespace

/// Closed form: k_n times the overlap with each plane, and around a ridge with the ridge.
CaseReport validate(bool full) {
  constexpr double kTolerance = 1e-9;  // of one contact
  const int places = full ? 8000 : 800;
  const double side = kStart / elementary::cos(kSlope);
  const Felt ridge = felt_over(kSlope, over_ridge, 2.0 * side + 2.0 * kSlope * kDistance, places);
  const Felt valley = felt_over(-kSlope, through_valley, 2.0 * side, places);
  CaseReport report;
  report.findings = {
      {"largest deviation of the force over a ridge", ridge.worst, 0.0, kTolerance * kForce, "N",
       "closed form: one contact, k_n times the overlap; YADE 2023.02a: nothing around the ridge"},
      {"largest deviation of the force through a valley", valley.worst, 0.0, kTolerance * kForce,
       "N", "closed form: k_n times the overlap with either plane"}};
  report.figures = {figure_of("Over a ridge of 20 degrees", ridge, "yade_ridge"),
                    figure_of("Through a valley of 20 degrees", valley, "yade_valley")};
  return report;
}

}  // namespace plekton::apps::fold

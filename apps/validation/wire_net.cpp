// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

// A double-twisted hexagonal net between two grips, pulled along its twists: the net, the wire and
// the force that YADE's own check of its wire model asserts (scripts/checks-and-tests/checks,
// checkWirePM.py; the model is that of Thoeni, Lambert, Giacomini, Sloan, Computers and Geotechnics
// 49 (2013) 158-169).
namespace plekton::apps::wire_net {
namespace {

using dynamics::Held;
using dynamics::Scene;
using dynamics::WireCurve;
using geometry::index_of;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kMeshSize = 0.08;       // m, between twists of a row
constexpr double kTwist = 0.04;          // m, length of a twist
constexpr double kRise = 0.04;           // m, of a single wire along the twists
constexpr int kAcross = 12;              // meshes
constexpr int kRows = 7;                 // of twists, 12 and 13 by turns
constexpr double kWireRadius = 1.35e-3;  // m
constexpr double kSelvedgeRadius = 1.7e-3;
constexpr double kDensity = 7850.0;      // kg/m³
constexpr double kLambdaStrain = 0.4;    // strains of a twist over those of a wire
constexpr double kLambdaStiff = 0.66;    // part of a twist that is as soft as a helix
constexpr double kPoissonRatio = 0.3;    // of the steel
constexpr double kElongation = 0.04004;  // m, where YADE's check looks
constexpr double kForce = 33626.44;      // N, that it asserts there to 1 %

/// Stress over strain of the wire of a net.
struct StressPoint {
  double strain;
  double stress;  // Pa
};
constexpr StressPoint kSteel[] = {{0.0019230769, 250e6}, {0.0192, 321.95e6}, {0.05, 382.92e6},
                                  {0.15, 512.19e6},      {0.25, 558.54e6},   {0.30, 565.85e6},
                                  {0.35, 565.85e6}};

double area_of(double radius) {
  return std::numbers::pi * radius * radius;
}

WireCurve single_wire(double radius) {
  WireCurve curve;
  for (const StressPoint& point : kSteel)
    curve.points.push_back({point.strain, point.stress * area_of(radius)});
  return curve;
}

/// Two wires wound around each other. They straighten as a helix does, whose stiffness over that of
/// the wire, k_h / k, is with the pitch angle a, tan a = l / (3 pi d),
///
///     l d / A / (48 cos a (41/9 (1 + nu) + 17/4 tan² a)),
///
/// so that both have 2 (lambda_k k_h + (1 - lambda_k) k); all forces of the curve are scaled alike,
/// and strains beyond the first point by lambda_eps.
/// Source: Bertrand, Nicot, Gotteland, Lambert, Canadian Geotechnical Journal 45 (2008) 1104-1117.
WireCurve twisted_wires() {
  constexpr double d = 2.0 * kWireRadius;
  const double tan_a = kTwist / (3.0 * std::numbers::pi * d);
  const double cos_a = 1.0 / std::sqrt(1.0 + tan_a * tan_a);
  const double helix =
      kTwist * d / area_of(kWireRadius) /
      (48.0 * cos_a * (41.0 / 9.0 * (1.0 + kPoissonRatio) + 17.0 / 4.0 * tan_a * tan_a));
  const double scale = 2.0 * (kLambdaStiff * helix + 1.0 - kLambdaStiff);
  WireCurve curve = single_wire(kWireRadius);
  for (WireCurve::Point& point : curve.points) {
    point.force *= scale;
    if (&point != &curve.points.front()) point.strain *= kLambdaStrain;
  }
  return curve;
}

/// A net between its grips.
struct GrippedNet {
  Scene scene;
  std::vector<NodeId> bottom;
  std::vector<NodeId> top;
};

/// Adds bars that follow one curve.
class Bars {
 public:
  Bars(Scene& scene, double radius, WireCurve curve)
      : scene_(scene), radius_(radius), law_{std::move(curve), {}} {}

  void add(NodeId a, NodeId b) {
    law_.bonds.push_back(scene_.add_beam(
        a, b, dynamics::wire_section(radius_, std::get<WireCurve>(law_.law)), kDensity));
  }
  dynamics::BondLaw take() { return std::move(law_); }

 private:
  Scene& scene_;
  double radius_;
  dynamics::BondLaw law_;
};

/// Lower and upper nodes of the twists of a row.
struct TwistRow {
  std::vector<NodeId> lower;
  std::vector<NodeId> upper;
};

/// The first and the last row have 12 twists, and a thicker wire runs along either side from grip
/// to grip; it is the twist there, too.
GrippedNet gripped_net() {
  GrippedNet net;
  Scene& scene = net.scene;
  Bars wires(scene, kWireRadius, single_wire(kWireRadius));
  Bars twists(scene, kWireRadius, twisted_wires());
  Bars selvedges(scene, kSelvedgeRadius, single_wire(kSelvedgeRadius));
  const auto add = [&](double x, double y) {
    return scene.add_node(Vec3(x, y, 0.0), Held::rotation);
  };
  const double width = kAcross * kMeshSize;
  const double height = kRows * kTwist + (kRows - 1) * kRise;
  NodeId sides[] = {add(0.0, 0.0), add(width, 0.0)};  // the uppermost nodes so far
  net.bottom = {sides[0], sides[1]};
  TwistRow below;
  for (int row = 0; row < kRows; ++row) {
    const bool is_wide = row % 2 == 1;
    const int count = is_wide ? kAcross + 1 : kAcross;
    const double y = row * (kTwist + kRise);
    TwistRow twisted;
    for (int i = 0; i < count; ++i) {
      const double x = (is_wide ? i : i + 0.5) * kMeshSize;
      const NodeId lower = add(x, y), upper = add(x, y + kTwist);
      twisted.lower.push_back(lower);
      twisted.upper.push_back(upper);
      if (!is_wide || (i > 0 && i + 1 < count)) {
        twists.add(lower, upper);
        continue;
      }
      NodeId& side = sides[i == 0 ? 0 : 1];
      selvedges.add(side, lower);
      selvedges.add(lower, upper);
      side = upper;
    }
    // A node of a row with 12 twists lies between two of a row with 13.
    for (std::size_t i = 0; i < kAcross && row > 0; ++i) {
      const auto& narrow = is_wide ? below.upper : twisted.lower;
      const auto& wide = is_wide ? twisted.lower : below.upper;
      wires.add(narrow[i], wide[i]);
      wires.add(narrow[i], wide[i + 1]);
    }
    if (row == 0) net.bottom.insert(net.bottom.end(), twisted.lower.begin(), twisted.lower.end());
    below = std::move(twisted);
  }
  net.top = below.upper;
  for (const int side : {0, 1}) {
    net.top.push_back(add(side * width, height));
    selvedges.add(sides[side], net.top.back());
  }
  scene.bond_laws = {wires.take(), twists.take(), selvedges.take()};
  return net;
}

dynamics::PrescribedMotion moving(std::vector<NodeId> nodes, const Vec3& velocity,
                                  const dynamics::TimeTable& factor) {
  dynamics::PrescribedMotion motion;
  motion.nodes = std::move(nodes);
  motion.velocity = velocity;
  motion.factor = factor;
  return motion;
}

struct Pull {
  std::vector<double> elongations;  // m
  std::vector<double> forces;       // N
  double closure = 0.0;             // of the energy, largest

  /// N. The rows are much closer than what changes the force.
  double force_at(double elongation) const {
    const auto next = std::lower_bound(elongations.begin(), elongations.end(), elongation);
    return forces[static_cast<std::size_t>(next - elongations.begin())];
  }
};

/// @param speed  m/s, of the upper grip
Pull pulled(double speed) {
  constexpr double kEnd = 0.05;  // m
  GrippedNet net = gripped_net();
  const dynamics::TimeTable ramp({{0.0, 0.0}, {5e-3 / speed, 1.0}});
  net.scene.loads.motions = {moving(net.bottom, Vec3::Zero(), ramp),
                             moving(net.top, speed * Vec3::UnitY(), ramp)};
  std::vector<std::size_t> all(net.scene.bonds.size());
  std::iota(all.begin(), all.end(), 0U);
  net.scene.loads.beam_damping = {{std::move(all), 0.1}};
  const double start = net.scene.state.position[index_of(net.top[0])].y();
  dynamics::Simulation simulation(std::move(net.scene), {});
  Pull pull;
  while (pull.elongations.empty() || pull.elongations.back() < kEnd) {
    simulation.step();
    if (simulation.steps() % 20 != 0) continue;
    double force = 0.0;
    for (const NodeId node : net.top) force -= simulation.forces().force[index_of(node)].y();
    pull.elongations.push_back(simulation.state().position[index_of(net.top[0])].y() - start);
    pull.forces.push_back(force);
    keep_largest(pull.closure, simulation.energy().closure());
  }
  return pull;
}

}  // namespace

/// The net draws in between its grips, so that there is no closed form.
CaseReport validate(bool full) {
  constexpr double kSpeed = 0.25;  // m/s, slow beside the waves in a wire of steel
  const Pull pull = pulled(kSpeed);
  const double force = pull.force_at(kElongation);
  CaseReport report;
  report.findings = {{"force at 40 mm", force, kForce, 0.01 * kForce, "N",
                      "YADE's check of its own wire model, to the same 1 %"},
                     {"largest closure of the energy, breaks included", pull.closure, 0.0, 5e-3, "",
                      "nothing is lost"}};
  Figure figure{"A net of 0.96 m x 0.52 m is pulled along its twists",
                "elongation (m)",
                "force (N)",
                {{"Plekton", CurveStyle::line, pull.elongations, pull.forces}}};
  if (full) {
    const Pull slow = pulled(0.5 * kSpeed);
    report.findings.push_back({"force at 40 mm with half the speed", slow.force_at(kElongation),
                               force, 5e-3 * force, "N", "that with the whole speed, 0.5 %"});
    figure.curves.push_back({"half the speed", CurveStyle::dashed, slow.elongations, slow.forces});
  }
  figure.curves.push_back(recorded_curve("yade_wire_net"));
  report.figures.push_back(std::move(figure));
  return report;
}

}  // namespace plekton::apps::wire_net

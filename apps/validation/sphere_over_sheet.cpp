// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::apps::sphere_over_sheet {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSphere = 0.05;  // m
constexpr double kSheet = 0.01;   // m, half of the thickness
constexpr double kYoung = 1e7;    // Pa
constexpr double kRatio = 0.3;    // tangential over normal stiffness
constexpr double kFriction = 0.4;
constexpr double kOverlap = 1e-4;                                                    // m
constexpr double kSpeed = 1.0;                                                       // m/s
constexpr double kStep = 1e-5;                                                       // s
constexpr double kWay = 1.0;                                                         // m
constexpr double kStiffness = 2.0 * kYoung * kSphere * kSheet / (kSphere + kSheet);  // N/m
constexpr contact::MaterialId kMaterial{0};

/// Fixed nodes in rows, each moved within the plane by up to a third of the spacing, the same in
/// every run; cells cut by turns.
void add_sheet(dynamics::Scene& scene, int cells) {
  constexpr double kWidth = 0.4;   // m
  constexpr double kLength = 1.4;  // m
  const int across = 5;
  std::uint64_t seed = 12345;
  const auto chance = [&] {
    seed = seed * 6364136223846793005U + 1442695040888963407U;  // Knuth's linear congruence
    return static_cast<double>(seed >> 11U) * 0x1p-53 - 0.5;
  };
  const double dx = kLength / cells;
  const double dy = kWidth / across;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= across; ++j)
      scene.add_node(
          Vec3((i + 0.6 * chance()) * dx - 0.2, (j - 0.5 * across + 0.6 * chance()) * dy, 0.0),
          Held::everything);
  const auto node = [&](int i, int j) { return NodeId{i * (across + 1) + j}; };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < across; ++j) {
      const bool is_rising = (i + j) % 2 == 0;
      const NodeId a = node(i, j);
      const NodeId b = node(i + 1, j);
      const NodeId c = node(i + 1, j + 1);
      const NodeId d = node(i, j + 1);
      scene.add_facet(a, b, is_rising ? c : d, kSheet, kMaterial);
      scene.add_facet(is_rising ? a : b, c, d, kSheet, kMaterial);
    }
  }
}

struct Felt {
  std::vector<double> place;       // m, along the way
  std::vector<double> normal;      // N
  std::vector<double> tangential;  // N, against the motion
};

Felt dragged_over(int cells) {
  dynamics::Scene scene;
  scene.materials = {{kYoung, kRatio, kFriction}};
  add_sheet(scene, cells);
  const Vec3 start(0.0, 0.013, kSphere + kSheet - kOverlap);
  const geometry::SphereId sphere = scene.add_sphere(start, kSphere, 2500.0, kMaterial);
  const NodeId node = scene.elements.spheres[index_of(sphere)].nodes[0];
  dynamics::PrescribedMotion motion;
  motion.nodes = {node};
  motion.held = Held::everything;
  motion.velocity = Vec3(kSpeed, 0.1 * kSpeed, 0.0);
  scene.loads.motions.push_back(motion);
  dynamics::SimulationOptions options;
  options.time_step = kStep;
  dynamics::Simulation simulation(std::move(scene), options);
  Felt felt;
  while (simulation.time() * kSpeed < kWay) {
    simulation.step();
    const Vec3 moved = simulation.force_positions()[index_of(node)] - start;
    const Vec3 force = simulation.forces().force[index_of(node)];
    felt.place.push_back(moved.norm());
    felt.normal.push_back(force.z());
    felt.tangential.push_back(Vec3(force.x(), force.y(), 0.0).norm());
  }
  return felt;
}

}  // namespace

/// Closed form: one contact all the way, F_n = k_n u, F_s = min(k_s s, mu F_n).
CaseReport validate(bool full) {
  const double normal = kStiffness * kOverlap;
  const double limit = kFriction * normal;
  const double increment = kRatio * kStiffness * kSpeed * 1.01 * kStep;  // N in a step
  const Felt felt = dragged_over(full ? 42 : 14);
  std::vector<double> expected;
  double worst_normal = 0.0;
  double worst_tangential = 0.0;
  for (std::size_t i = 0; i < felt.place.size(); ++i) {
    expected.push_back(std::min(kRatio * kStiffness * felt.place[i], limit));
    keep_largest(worst_normal, std::abs(felt.normal[i] / normal - 1.0));
    keep_largest(worst_tangential, std::abs(felt.tangential[i] - expected[i]));
  }
  CaseReport report;
  report.findings = {
      {"largest deviation of the normal force, of itself", worst_normal, 0.0, 1e-9, "",
       "closed form: k_n times overlap, one contact over any facets"},
      // Which step is the first to count is a matter of the scheme, at either end of the spring.
      {"largest deviation of the tangential force", worst_tangential, 0.0, 2.0 * increment, "N",
       "closed form: min(k_s way, mu F_n); two steps' increments"}};
  Figure figure{"Dragged over a sheet of irregular facets", "way (m)", "force (N)", {}};
  figure.curves = {{"normal", CurveStyle::line, felt.place, felt.normal},
                   {"tangential", CurveStyle::line, felt.place, felt.tangential},
                   {"closed form", CurveStyle::dashed, felt.place, expected}};
  report.figures.push_back(std::move(figure));
  return report;
}

}  // namespace plekton::apps::sphere_over_sheet

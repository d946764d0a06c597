// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/random.hpp"
#include "apps/validation/validation_case.hpp"
#include "dynamics/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace plekton::apps::facet_probes {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kSphere = 0.1;  // m
constexpr double kFacet = 0.02;  // m, half of the thickness
constexpr double kYoung = 1e6;   // Pa
constexpr double kRange = kSphere + kFacet;
constexpr double kStiffness = 2.0 * kYoung * kSphere * kFacet / kRange;  // N/m
constexpr contact::MaterialId kMaterial{0};
using Corners = std::array<Vec3, 3>;

/// Weights of the corners in the point of a segment, or of a facet, that is nearest to another.
Vec3 weights_on_side(const Corners& corners, std::size_t from, std::size_t to, const Vec3& x) {
  const Vec3 side = corners[to] - corners[from];
  const double t = std::clamp((x - corners[from]).dot(side) / side.squaredNorm(), 0.0, 1.0);
  Vec3 weights = Vec3::Zero();
  weights[static_cast<int>(from)] = 1.0 - t;
  weights[static_cast<int>(to)] = t;
  return weights;
}

Vec3 point_at(const Corners& corners, const Vec3& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

Vec3 nearest_weights(const Corners& corners, const Vec3& x) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0], d = x - corners[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  const double s = (vv * d.dot(u) - uv * d.dot(v)) / det;
  const double t = (uu * d.dot(v) - uv * d.dot(u)) / det;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return {1.0 - s - t, s, t};
  Vec3 best = weights_on_side(corners, 0, 1, x);
  for (const auto& other : {weights_on_side(corners, 1, 2, x), weights_on_side(corners, 2, 0, x)})
    if ((x - point_at(corners, other)).norm() < (x - point_at(corners, best)).norm()) best = other;
  return best;
}

/// Force (N) on a sphere at a place, by the point of the facet that is nearest to its centre.
Vec3 exact_force(const Corners& corners, const Vec3& centre) {
  const Vec3 away = centre - point_at(corners, nearest_weights(corners, centre));
  return kStiffness * std::max(0.0, kRange - away.norm()) * away.normalized();
}

/// Forces (N) on the corners and on a sphere at a place.
std::array<Vec3, 4> forces_at(const Corners& corners, const Vec3& centre) {
  dynamics::Scene scene;
  scene.materials = {{kYoung, 0.3, 0.0}};
  for (const Vec3& x : corners) scene.add_node(x, Held::everything);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, kFacet, kMaterial);
  scene.add_sphere(centre, kSphere, 2500.0, kMaterial);
  scene.properties.held.back() = Held::everything;
  dynamics::SimulationOptions options;
  options.time_step = 1e-6;
  dynamics::Simulation simulation(std::move(scene), options);
  simulation.step();
  const auto& force = simulation.forces().force;
  return {force[0], force[1], force[2], force[3]};
}

struct Count {
  int probes = 0;
  int wrong = 0;   // by more than 1e-9 of the force
  int missed = 0;  // of these, without any force
};

/// Spheres at random that touch a facet from above it, or from beside it.
Count probed(const Corners& corners, int probes, bool beside, Random& random) {
  Count count;
  while (count.probes < probes) {
    const double x = random.uniform(-0.6, 1.2), y = random.uniform(-0.15, 0.85);
    const Vec3 centre(x, y, random.uniform(0.02, 0.119));
    const Vec3 weights = nearest_weights(corners, centre);
    const Vec3 away = centre - point_at(corners, weights);
    if (away.norm() >= kRange || (weights.minCoeff() <= 0.0) != beside) continue;
    ++count.probes;
    const Vec3 exact = exact_force(corners, centre);
    const std::array<Vec3, 4> forces = forces_at(corners, centre);
    bool is_right = (forces[3] - exact).norm() <= 1e-9 * exact.norm();
    for (std::size_t i = 0; i < 3; ++i)
      is_right = is_right &&
                 (forces[i] + weights[static_cast<int>(i)] * exact).norm() <= 1e-9 * exact.norm();
    if (is_right) continue;
    ++count.wrong;
    count.missed += forces[3].isZero(0.0) ? 1 : 0;
  }
  return count;
}

/// The force on a sphere that passes at one height from above a facet to beside it.
Figure passing_figure(const Corners& corners) {
  constexpr double kHeight = 0.08;  // m
  Figure figure{"A sphere passes from above a facet, over its side, to beside it",
                "distance of its centre from the side, inwards above 0 (m)",
                "force (N)",
                {{"Plekton, along the facet", CurveStyle::line, {}, {}},
                 {"closed form", CurveStyle::dashed, {}, {}},
                 {"Plekton, normal to the facet", CurveStyle::line, {}, {}},
                 {"closed form", CurveStyle::dashed, {}, {}}}};
  const Vec3 middle = 0.5 * (corners[0] + corners[1]), side = corners[1] - corners[0];
  const Vec3 inwards = Vec3(-side.y(), side.x(), 0.0).normalized();
  for (int i = -100; i <= 100; ++i) {
    const double inside = 1e-3 * i;  // m
    const Vec3 centre = middle + inside * inwards + kHeight * Vec3::UnitZ();
    const Vec3 felt = forces_at(corners, centre)[3], exact = exact_force(corners, centre);
    const double values[] = {felt.dot(inwards), exact.dot(inwards), felt.z(), exact.z()};
    for (std::size_t k = 0; k < figure.curves.size(); ++k) {
      figure.curves[k].x.push_back(inside);
      figure.curves[k].y.push_back(values[k]);
    }
  }
  return figure;
}

}  // namespace

/// The point of the facet that is nearest to the centre decides: k_n times the overlap along the
/// line to it, and its weights share it out over the nodes.
CaseReport validate(bool full) {
  const std::array<Corners, 3> facets{{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.9, 0.2, 0)},
                                       {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(-0.4, 0.35, 0)},
                                       {Vec3(0, 0, 0), Vec3(0.8, 0.05, 0), Vec3(0.35, 0.7, 0)}}};
  constexpr std::array<const char*, 3> kNames{"a needle", "an obtuse facet", "a plump facet"};
  const int probes = full ? 10'000 : 116;
  Random random(1);
  CaseReport report;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (const bool beside : {false, true}) {
      const Count count = probed(facets[i], probes, beside, random);
      report.findings.push_back(
          {fmt::format("wrong forces of {} spheres {} {}, {} of them missed", probes,
                       beside ? "beside" : "above", kNames[i], count.missed),
           static_cast<double>(count.wrong), 0.0, 0.0, "",
           beside ? "nearest point by projection; YADE 2023.02a: 108 of 116 wrong, 103 missed"
                  : "nearest point by projection; YADE 2023.02a: 0 of 127"});
    }
  }
  report.figures.push_back(passing_figure(facets[2]));
  return report;
}

}  // namespace plekton::apps::facet_probes

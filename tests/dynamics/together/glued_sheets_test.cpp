// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

/// Two flat sheets, their meshes unlike, set into each other and glued where they are; nothing else
/// acts. The glue has no stretch where their surfaces just touch: the overlap pushes them there.
namespace plekton::test::glued_sheets_test {
namespace {

using dynamics::Held;
using dynamics::Simulation;
using geometry::Vec3;

constexpr double kThickness = 0.004;  // m
constexpr double kOverlap = 5e-5;     // m
constexpr double kModulus = 5e6;      // Pa

void add_sheet(dynamics::Scene& scene, const geometry::PlaneSheet& shape, const Vec3& place,
               Held held) {
  const auto sheet =
      geometry::make_membrane(geometry::plane_sheet(shape), {.thickness = kThickness});
  const auto fibre = dynamics::circular_section(0.5 * kThickness, kModulus, 0.3);
  std::vector<geometry::NodeId> ids;
  for (const Vec3& x : sheet.nodes) ids.push_back(scene.add_node(x + place, held));
  const auto id = [&](geometry::NodeId node) { return ids[index_of(node)]; };
  for (const auto& [n, r] : sheet.facets)
    scene.add_facet(id(n[0]), id(n[1]), id(n[2]), r, contact::MaterialId{0});
  for (const auto& [a, b] : sheet.edges) scene.add_beam(id(a), id(b), fibre, 900.0);
}

/// The lower one is held.
dynamics::Scene glued_sheets() {
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = kModulus, .stiffness_ratio = 0.3, .friction = 0.0}};
  add_sheet(scene, {0.2, 0.1, 10, 5}, Vec3::Zero(), Held::everything);
  add_sheet(scene, {0.2, 0.1, 8, 4}, {0.01, 0.003, kThickness - kOverlap}, Held::nothing);
  return scene;
}

struct Seen {
  double closure = 0.0;       ///< error over the largest turnover, at any step
  double motion = 0.0;        ///< m, of any node at any step
  double along = 0.0;         ///< m, the same along the plane
  double kinetic = 0.0;       ///< J, at any step
  double least_damped = 0.0;  ///< J, dissipated in contacts, at any step
  double left = 0.0;          ///< m, of overlaps or gaps between surfaces at the end, the largest
  dynamics::Energy energy{};  ///< at the end
};

/// @param strength  Pa, of the glue
Seen watch(double strength, dynamics::SimulationOptions options, double time, double part = 1.0) {
  const auto model = contact::model_of<contact::CohesiveFrictional>(
      {{{contact::MaterialId{0}, contact::MaterialId{0}}, {strength, strength, 5e-4}}});
  if (part < 1.0) options.time_step = part * Simulation(glued_sheets(), {}, model).time_step();
  Simulation simulation(glued_sheets(), options, model);
  const std::vector<Vec3> start(simulation.state().position.begin(),
                                simulation.state().position.end());
  Seen seen;
  double error = 0.0, turnover = 0.0;
  while (simulation.time() < time) {
    simulation.step();
    seen.energy = simulation.energy();
    error = std::max(error, std::abs(seen.energy.closure_error()));
    turnover = std::max(turnover, seen.energy.turnover());
    seen.kinetic = std::max(seen.kinetic, seen.energy.kinetic);
    seen.least_damped = std::min(seen.least_damped, seen.energy.friction);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vec3 way = simulation.state().position[i] - start[i];
      seen.motion = std::max(seen.motion, way.norm());
      seen.along = std::max(seen.along, way.head<2>().norm());
    }
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (start[i].z() == 0.0) continue;
    seen.left = std::max(seen.left, std::abs(simulation.state().position[i].z() - kThickness));
  }
  seen.closure = error / turnover;
  return seen;
}

/// J: k u² / 2 of as many contacts as there are squares of the thickness in what lies on each
/// other, 0.19 m x 0.097 m, k = E r.
constexpr double kStored = 0.5 * (kModulus * 0.5 * kThickness) * kOverlap * kOverlap * 0.19 *
                           0.097 / (kThickness * kThickness);

// With numerical damping. One spring would go by twice the overlap at most; this sheet's nodes have
// not all the same share of it, and bend it by a little more.
TEST(GluedSheets, SetIntoEachOtherComeToRestWhereTheyJustTouch) {
  dynamics::SimulationOptions options;
  options.motion.damping = 0.3;
  constexpr double kStrength = 5e5;  // Pa: 2 N for a bond, four times k u

  const Seen coarse = watch(kStrength, options, 0.01);
  const Seen fine = watch(kStrength, options, 0.01, 0.25);

  for (const Seen& seen : {coarse, fine}) {
    EXPECT_LT(seen.left, 1e-2 * kOverlap);
    EXPECT_LT(seen.motion, 2.2 * kOverlap);
    EXPECT_LT(seen.along, 0.1 * kOverlap);
    EXPECT_LT(seen.energy.kinetic, 1e-6 * kStored);
    EXPECT_GE(seen.least_damped, -1e-3 * kStored);
  }
  // At the chosen step it is 4 %, which is more than a run is certified by.
  EXPECT_LT(coarse.closure, 0.05);
  EXPECT_LT(fine.closure, 0.005);
}

// 0.02 N for a bond, of k u = 0.5 N: the upper sheet comes off, with what the glue leaves of the
// energy.
TEST(GluedSheets, SetIntoEachOtherComeOffWeakGlueWithNoMoreThanTheyHadStored) {
  dynamics::SimulationOptions options;
  options.time_step = 1e-6;

  const Seen seen = watch(5e3, options, 1e-3);

  EXPECT_NEAR(seen.energy.initial, kStored, 1e-3 * kStored);
  EXPECT_LT(seen.closure, 1e-3);
  EXPECT_LT(seen.kinetic, (1.0 + 1e-3) * kStored);
  EXPECT_GE(seen.least_damped, -1e-14 * kStored);  // rounding
}

}  // namespace
}  // namespace plekton::test::glued_sheets_test

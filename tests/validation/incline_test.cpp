// SPDX-License-Identifier: GPL-3.0-or-later
// A flat sheet on a flat slope, both of many facets, with mu = 0.5 (26.57 degrees): at 26 degrees
// it rests, at 27.5 and 35 degrees it slides with a = g (sin b - mu cos b), whatever its facets lie
// on.
#include "contact/law_list.hpp"
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/generate/membrane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::test::incline_test {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kThickness = 0.004;  // m
constexpr double kFriction = 0.5;
constexpr double kGravity = 9.81;  // m/s²

std::vector<NodeId> add_sheet(dynamics::Scene& scene, const geometry::PlaneSheet& shape,
                              const Vec3& place, Held held) {
  const auto sheet =
      geometry::make_membrane(geometry::plane_sheet(shape), {.thickness = kThickness});
  const auto fibre = dynamics::circular_section(0.5 * kThickness, 1e7, 0.3);
  std::vector<NodeId> ids;
  for (const Vec3& x : sheet.nodes) ids.push_back(scene.add_node(x + place, held));
  const auto id = [&](NodeId node) { return ids[index_of(node)]; };
  for (const auto& [n, r] : sheet.facets)
    scene.add_facet(id(n[0]), id(n[1]), id(n[2]), r, contact::MaterialId{0});
  for (const auto& [a, b] : sheet.edges) scene.add_beam(id(a), id(b), fibre, 1000.0);
  return ids;
}

struct Motion {
  double acceleration;  ///< m/s², of the centre of mass along the slope, in the second half
  double way;           ///< m
};

Motion slide(double degrees) {
  dynamics::Scene scene;
  scene.materials = {{.young_modulus = 2e6, .stiffness_ratio = 0.5, .friction = kFriction}};
  add_sheet(scene, {0.4, 0.12, 13, 5}, {0.12, 0.0, 0.0}, Held::everything);
  const auto sheet = add_sheet(scene, {0.1, 0.05, 4, 2}, {0.0, 0.003, kThickness}, Held::nothing);
  const double slope = degrees * std::numbers::pi / 180.0;
  // Weight that comes at once makes the sheet bounce, and what bounces has less friction than mu
  // times what it weighs: so it comes slowly, and dashpots along the normal keep it down.
  scene.loads.gravity_factor = dynamics::TimeTable({{0.0, 0.0}, {0.06, 1.0}});
  contact::ContactSettings settings;
  settings.restitution = 0.1;
  dynamics::Simulation simulation(
      scene, {.motion = {.gravity = kGravity * Vec3(std::sin(slope), 0.0, -std::cos(slope))}},
      contact::any_law(
          {{{contact::MaterialId{0}, contact::MaterialId{0}}, contact::properties_of(settings)}}));
  const auto mean = [&](const std::vector<Vec3>& of) {
    double sum = 0.0, mass = 0.0;
    for (const NodeId node : sheet) {
      const double m = simulation.properties().mass[index_of(node)];
      sum += m * of[index_of(node)].x();
      mass += m;
    }
    return sum / mass;
  };
  const double start = mean(simulation.state().position);
  constexpr double kHalf = 0.12;  // s
  while (simulation.step_until(kHalf)) {
  }
  const double before = mean(simulation.state().velocity);
  while (simulation.step_until(2.0 * kHalf)) {
  }
  return {(mean(simulation.state().velocity) - before) / kHalf,
          mean(simulation.state().position) - start};
}

TEST(Incline, LetsASheetRestBelowTheAngleOfFriction) {
  const Motion found = slide(26.0);
  // What is pressed least slips a little until the rest carries it. Sliding with a hundredth of g
  // would be 2.5 mm by then.
  EXPECT_LT(found.way, 1e-5);
  EXPECT_LT(std::abs(found.acceleration), 0.01 * kGravity * 0.01);
}

TEST(Incline, LetsASheetSlideAsTheoryHasIt) {
  for (const double degrees : {27.5, 35.0}) {
    const double slope = degrees * std::numbers::pi / 180.0;
    const double expected = kGravity * (std::sin(slope) - kFriction * std::cos(slope));
    const Motion found = slide(degrees);
    EXPECT_NEAR(found.acceleration, expected, 0.01 * expected) << degrees << " degrees";
  }
}

}  // namespace
}  // namespace plekton::test::incline_test

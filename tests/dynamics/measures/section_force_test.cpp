// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/section_force.hpp"

#include "dynamics/model/scene.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace plekton::dynamics::section_force_test {
namespace {

constexpr double kYoung = 1e6;    // Pa
constexpr double kRadius = 0.01;  // m

/// Three nodes in a row along x, a metre apart, with a beam between each two.
Scene row_of_beams() {
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.add_node(Vec3(i, 0, 0));
  const BeamSection section = circular_section(kRadius, kYoung, 0.3);
  scene.add_beam(NodeId{0}, NodeId{1}, section, 1000.0);
  scene.add_beam(NodeId{1}, NodeId{2}, section, 1000.0);
  return scene;
}

TEST(SectionForce, OfAStretchedBarIsItsTensionAndNothingAfterItBroke) {
  Scene scene = row_of_beams();
  BeamBonds bonds(scene.bonds, scene.state.size());
  const SheetFacets sheets(scene.sheet_facets, scene.state.size());
  geometry::ThreadPool pool(1);
  scene.state.position[2].x() += 1e-3;
  bonds.advance(scene.state, pool);
  const std::vector<char> is_inside{0, 0, 1};
  const Vec3 about(0, 2, 0);

  const ForceAndMoment sum = section_force(is_inside, scene.state, bonds, sheets, about);

  // EA strain, towards the others, at 2 m below the point of the moment.
  const double tension = kYoung * std::numbers::pi * kRadius * kRadius * 1e-3;
  EXPECT_NEAR(sum.force.x(), -tension, 1e-9 * tension);
  EXPECT_NEAR(sum.moment.z(), -2.0 * tension, 1e-9 * tension);
  bonds.break_bond(1);
  EXPECT_EQ(section_force(is_inside, scene.state, bonds, sheets, about).force, Vec3::Zero());
}

TEST(SectionForce, OfAllNodesOrNoneIsNothing) {
  Scene scene = row_of_beams();
  BeamBonds bonds(scene.bonds, scene.state.size());
  const SheetFacets sheets(scene.sheet_facets, scene.state.size());
  geometry::ThreadPool pool(1);
  scene.state.position[2].x() += 1e-3;
  bonds.advance(scene.state, pool);
  for (const char all : {char{0}, char{1}}) {
    const std::vector<char> is_inside(3, all);
    EXPECT_EQ(section_force(is_inside, scene.state, bonds, sheets, Vec3::Zero()).force,
              Vec3::Zero());
  }
}

}  // namespace
}  // namespace plekton::dynamics::section_force_test

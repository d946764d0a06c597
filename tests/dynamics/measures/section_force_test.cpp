// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/section_force.hpp"

#include "dynamics/model/scene.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <vector>

namespace plekton::dynamics::section_force_test {
namespace {

constexpr double kYoung = 1e6;    // Pa
constexpr double kRadius = 0.01;  // m

/// Three nodes in a row along x, a metre apart, with a beam between each two, the last one of which
/// is stretched by a thousandth.
struct StretchedRow {
  StretchedRow() {
    for (int i = 0; i < 3; ++i) scene.add_node(Vec3(i, 0, 0));
    const BeamSection section = circular_section(kRadius, kYoung, 0.3);
    scene.add_beam(NodeId{0}, NodeId{1}, section, 1000.0);
    scene.add_beam(NodeId{1}, NodeId{2}, section, 1000.0);
    bonds.emplace(scene.bonds, scene.state.size());
    scene.state.position[2].x() += 1e-3;
    geometry::ThreadPool pool(1);
    bonds->advance(scene.state, pool);
  }
  ForceAndMoment across(const std::vector<char>& is_inside, const Vec3& about) const {
    return section_force(is_inside, scene.state, *bonds, sheets, about);
  }

  Scene scene;
  std::optional<BeamBonds> bonds;
  SheetFacets sheets{{}, 3};
};

TEST(SectionForce, OfAStretchedBarIsItsTensionAndNothingAfterItBroke) {
  StretchedRow row;
  const std::vector<char> is_inside{0, 0, 1};
  const Vec3 about(0, 2, 0);

  const ForceAndMoment sum = row.across(is_inside, about);

  // EA strain, towards the others, at 2 m below the point of the moment.
  const double tension = kYoung * std::numbers::pi * kRadius * kRadius * 1e-3;
  EXPECT_NEAR(sum.force.x(), -tension, 1e-9 * tension);
  EXPECT_NEAR(sum.moment.z(), -2.0 * tension, 1e-9 * tension);
  row.bonds->break_bond(1);
  EXPECT_EQ(row.across(is_inside, about).force, Vec3::Zero());
}

TEST(SectionForce, OfAllNodesOrNoneIsNothing) {
  const StretchedRow row;
  EXPECT_EQ(row.across({0, 0, 0}, Vec3::Zero()).force, Vec3::Zero());
  EXPECT_EQ(row.across({1, 1, 1}, Vec3::Zero()).force, Vec3::Zero());
}

}  // namespace
}  // namespace plekton::dynamics::section_force_test

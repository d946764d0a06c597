// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_facet.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::sheet_facet_test {
namespace {

using test::Random;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using testing::StrEq;
using testing::ThrowsMessage;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kNodes{NodeId{2}, NodeId{0}, NodeId{1}};

NodeState state_of(const std::vector<Vec3>& positions) {
  const std::size_t count = positions.size();
  return {positions, std::vector<Vec3>(count, Vec3::Zero()), std::vector<Vec3>(count, Vec3::Zero()),
          std::vector<Quat>(count, Quat::Identity())};
}

/// Three turned nodes with sides of about 1 m.
NodeState random_state(Random& random) {
  NodeState state = state_of({Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  const Mat3 turn = random.rotation();
  for (Vec3& x : state.position) x = turn * (x + random.in_cube(0.2));
  for (Quat& orientation : state.orientation) orientation = Quat(random.rotation());
  return state;
}

SheetSection section() {
  return solid_sheet(0.01, 1e7, 0.3);
}

/// At a height z the material is in plane stress: curvature 1 strains it by z, with the stress
/// E / (1 - nu²) z. Two Gauss points integrate z² over the thickness exactly.
TEST(SolidSheet, HasTheMomentOfTheStressesAcrossItsThickness) {
  constexpr double kThickness = 0.02, kModulus = 3e6, kPoisson = 0.4;
  double moment = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    const double z = sign * 0.5 * kThickness / std::sqrt(3.0);
    moment += 0.5 * kThickness * z * (kModulus / (1.0 - kPoisson * kPoisson) * z);
  }

  const SheetSection sheet = solid_sheet(kThickness, kModulus, kPoisson);

  EXPECT_NEAR(sheet.bending_stiffness, moment, 8.0 * kEpsilon * moment);
  EXPECT_DOUBLE_EQ(sheet.tensile_stiffness, 6e4);  // of a strip that is free to narrow
  EXPECT_EQ(sheet.poisson_ratio, kPoisson);
  EXPECT_EQ(sheet.thickness, kThickness);
  EXPECT_EQ(sheet.strength, kInfinity);
}

TEST(SheetFacet, LiesInItsFrameAsItsNodesLieInSpace) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const NodeState state = random_state(random);

    const SheetFacet facet = make_sheet_facet(kNodes, state, section());

    // Coordinates of about 1 are rounded a few times on the way to the frame and back.
    constexpr double kTolerance = 32.0 * kEpsilon;
    const auto x = [&](std::size_t k) { return state.position[index_of(kNodes[k])]; };
    const Vec3 area = 0.5 * (x(1) - x(0)).cross(x(2) - x(0));
    EXPECT_NEAR(area_of(facet), area.norm(), kTolerance);
    EXPECT_EQ(facet.corners[0], Vec2::Zero());
    EXPECT_EQ(facet.corners[1].y(), 0.0);
    EXPECT_GT(facet.corners[1].x(), 0.0);
    for (std::size_t node = 0; node < 3; ++node) {
      const Quat frame = state.orientation[index_of(kNodes[node])] * facet.rest[node];
      EXPECT_LT((frame * Vec3::UnitZ() - area.normalized()).norm(), kTolerance);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 corner(facet.corners[k].x(), facet.corners[k].y(), 0.0);
        EXPECT_LT((x(0) + frame * corner - x(k)).norm(), kTolerance);
      }
    }
  }
}

TEST(SheetFacet, WithoutAreaOrWithNodesThatAreNoneIsRefusedWithThatAlone) {
  const NodeState on_a_line = state_of({Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(3, 6, 9)});

  EXPECT_THAT([&] { make_sheet_facet(kNodes, on_a_line, section()); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(StartsWith("sheet facet (nodes 2, 0, 1): its area at rest is "),
                        EndsWith("0 m2; it must be positive and finite: delete the facet or move "
                                 "its nodes apart"),
                        Not(HasSubstr("\n")))));
  EXPECT_THAT(
      [&] {
        make_sheet_facet({NodeId{0}, NodeId{-1}, NodeId{0}}, on_a_line, section());
      },
      ThrowsMessage<std::invalid_argument>(
          StrEq("sheet facet (nodes 0, -1, 0): there is no node -1, only 3 nodes\n"
                "sheet facet (nodes 0, -1, 0): it repeats a node; delete the facet")));
}

TEST(SheetFacet, IsToldTheLineOfWhatIsWrongAndNoOther) {
  Random random(4);
  const SheetFacet sound = make_sheet_facet(kNodes, random_state(random), section());
  const auto problems_of = [](const SheetFacet& facet) {
    std::ostringstream text;
    list_problems(facet, 3, "facet", text);
    return text.str();
  };
  EXPECT_THAT(problems_of(sound), IsEmpty());
  SheetFacet limp = sound;
  limp.section.bending_stiffness = 0.0;
  EXPECT_THAT(problems_of(limp), IsEmpty());

  struct Case {
    std::function<void(SheetFacet&)> spoil;
    std::string line;
  };
  const std::vector<Case> cases = {
      {[](SheetFacet& f) { f.section.tensile_stiffness = kInfinity; },
       "tensile stiffness (N/m) is inf; it must be positive and finite"},
      {[](SheetFacet& f) { f.section.poisson_ratio = -1.0; },
       "Poisson's ratio is -1; it must be above -1 and below 1"},
      {[](SheetFacet& f) { f.section.bending_stiffness = kInfinity; },
       "bending stiffness (N m) is inf; it must be zero or positive, and finite"},
      {[](SheetFacet& f) { f.section.thickness = kInfinity; },
       "thickness (m) is inf; it must be positive and finite"},
      {[](SheetFacet& f) { f.section.strength = 0.0; },
       "strength (Pa) is 0; it must be positive, or infinite for a sheet that never tears"},
      {[](SheetFacet& f) { std::swap(f.corners[1], f.corners[2]); },
       "its area at rest is -" +
           [&] {
             std::ostringstream area;
             area << area_of(sound);
             return area.str();
           }() +
           " m2; it must be positive and finite: delete the facet or move its nodes apart"},
      {[](SheetFacet& f) { f.rest[1].coeffs() *= 1.0 + 1e-8; },
       "its rotation at rest is not a unit quaternion; normalise it"}};
  for (const Case& one : cases) {
    SheetFacet facet = sound;
    one.spoil(facet);
    EXPECT_EQ(problems_of(facet), "facet (nodes 2, 0, 1): " + one.line + "\n");
  }
}

}  // namespace
}  // namespace plekton::dynamics::sheet_facet_test

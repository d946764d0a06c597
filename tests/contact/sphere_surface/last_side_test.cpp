// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/last_side.hpp"

#include "tests/support/ball_on_surface.hpp"

#include <gtest/gtest.h>

/// A ball whose centre comes to lie exactly on the surface stays on the side from which it came.
namespace plekton::test::last_side_test {
namespace {

constexpr Material kRough{1e6, 0.5, 1e3};  // no sliding within the tests below

/// The force of a contact in which the ball's centre lies on the surface.
double deepest_force(const SphereOnSurface& ball) {
  return ball.parameters().normal_stiffness * ball.range();
}

/// Presses a ball onto a place of a surface from a side and compares the forces there and just
/// before: they differ by the stiffness times the way and by what the spring gains.
void expect_same_side(const Complex& surface, const Vec3& place, const Vec3& side) {
  constexpr double kWay = 1.0 / 1024.0;  // m, exact, so that the ball arrives at the place itself
  SphereOnSurface ball(surface, 0.9, kRough);
  ball.put(place + kWay * side);
  const Vec3 before = ball.move(Vec3::Zero());

  const Vec3 there = ball.move(-kWay * side);

  ASSERT_EQ(ball.centre(), place);
  EXPECT_EQ(ball.contacts().touching(), 1u);
  EXPECT_NEAR((there - deepest_force(ball) * side).norm(), 0.0, 1e-12 * deepest_force(ball));
  EXPECT_LE((there - before).norm(), 1.1 * ball.parameters().normal_stiffness * kWay);
}

TEST(SphereCentredOnTheSurface, IsPushedBackToItsOwnSideOfAFacet) {
  const Complex surface = centred(sheet(8), 8, 1.0);
  for (const double side : {1.0, -1.0}) {
    expect_same_side(surface, Vec3(0.25, 0.125, 0.0), side * Vec3::UnitZ());
  }
}

TEST(SphereCentredOnTheSurface, IsPushedBackToItsOwnSideOfAnEdgeOrANodeBetweenFacets) {
  const Complex surface = centred(sheet(8), 8, 1.0);
  for (const double side : {1.0, -1.0}) {
    expect_same_side(surface, Vec3(0.0, 0.5, 0.0), side * Vec3::UnitZ());
    expect_same_side(surface, Vec3::Zero(), side * Vec3::UnitZ());
  }
}

TEST(SphereCentredOnTheSurface, IsPushedBackToWhereItCameFromOnACylinder) {
  Complex wire;
  wire.node(Vec3(-4, 0, 0));
  wire.node(Vec3(4, 0, 0));
  wire.cylinder(0, 1);
  for (const Vec3& side : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, -1, 0)}) {
    expect_same_side(wire, Vec3(0.5, 0, 0), side);
  }
  expect_same_side(wire, Vec3(4, 0, 0), Vec3(1, 0, 0));
}

TEST(SphereCentredOnTheSurface, KeepsItsSpring) {
  for (const double side : {1.0, -1.0}) {
    SphereOnSurface ball(centred(sheet(8), 8, 1.0), 0.9, kRough);
    ball.put(Vec3(0.25, 0.125, side / 64.0));
    for (int k = 0; k < 4; ++k) ball.move(Vec3(1.0 / 64.0, 0, 0));
    const double along = ball.forces().force.back()[0];

    ball.move(Vec3(0, 0, -side / 64.0));

    const double expected = -ball.parameters().tangential_stiffness * 4.0 / 64.0;
    EXPECT_NEAR(along, expected, 1e-12 * std::abs(expected));
    EXPECT_NEAR(ball.forces().force.back()[0], expected, 1e-12 * std::abs(expected));
  }
}

TEST(NormalOnTheLastSide, IsTheFeaturesOwnWhereTheLastOneLiesInIt) {
  const std::vector<Vec3> x{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  const geometry::CorePoint on_face{
      {NodeId{0}, NodeId{1}, NodeId{2}}, Vec3(0.5, 0.25, 0.25), Feature(geometry::FaceId{0})};
  const geometry::CorePoint on_edge{
      {NodeId{0}, NodeId{1}, NodeId{1}}, Vec3(0.5, 0.5, 0.0), Feature(geometry::EdgeId{0})};

  const Vec3 of_face = contact::normal_on_last_side(
      {on_face, Vec3::UnitZ(), 0.0, 1.0, 0.0, 0.0, 1.0, true}, Vec3::UnitX(), x);
  const Vec3 of_edge = contact::normal_on_last_side(
      {on_edge, Vec3::UnitY(), 0.0, 1.0, 0.0, 0.0, 1.0, true}, Vec3::UnitX(), x);

  EXPECT_EQ(of_face, Vec3::UnitZ());
  EXPECT_EQ(of_edge, Vec3::UnitY());
}

}  // namespace
}  // namespace plekton::test::last_side_test

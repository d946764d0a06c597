// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/mass_properties.hpp"

#include "geometry/mesh/generate/generators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::dynamics::mass_properties_test {
namespace {

using geometry::NodeId;
using Facets = std::vector<std::array<NodeId, 3>>;

MassProperties solid(const geometry::Mesh& mesh, double density) {
  const Vec3 origin = mesh.points.front();
  return mass_of(solid_moments(mesh.points, mesh.facets, origin), density, origin);
}

// Of a box with sides a, b, c: m / 12 (b² + c²) and so on.
TEST(SolidMoments, OfABoxAreThoseOfItsSides) {
  const Vec3 size(0.3, 0.5, 1.1), centre(10.0, -20.0, 5.0);
  geometry::Mesh mesh = geometry::box_shell(size, {2, 3, 4});
  Vec3 lower = mesh.points.front(), upper = lower;
  for (const Vec3& x : mesh.points) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  for (Vec3& x : mesh.points) x += centre - 0.5 * (lower + upper);

  const MassProperties body = solid(mesh, 2000.0);

  const double mass = 2000.0 * size.prod();
  EXPECT_NEAR(body.mass, mass, 1e-13 * mass);
  EXPECT_LT((body.centre - centre).norm(), 1e-14 * centre.norm());
  const Vec3 squares = size.cwiseAbs2();
  const Vec3 moments = mass / 12.0 * (Vec3::Constant(squares.sum()) - squares);
  EXPECT_LT((body.inertia - Mat3(moments.asDiagonal())).norm(), 1e-12 * moments.norm());
}

// The corner tetrahedron x, y, z >= 0, x + y + z <= a has V = a³ / 6, its centre at a / 4 and the
// integrals V a² / 10 of x² and V a² / 20 of x y.
TEST(SolidMoments, OfATetrahedronAreThoseOfItsCorners) {
  const double a = 0.2;
  const std::vector<Vec3> points{Vec3::Zero(), Vec3(a, 0, 0), Vec3(0, a, 0), Vec3(0, 0, a)};
  const Facets facets{{NodeId{0}, NodeId{2}, NodeId{1}},
                      {NodeId{0}, NodeId{1}, NodeId{3}},
                      {NodeId{0}, NodeId{3}, NodeId{2}},
                      {NodeId{1}, NodeId{2}, NodeId{3}}};

  const MassProperties body = mass_of(solid_moments(points, facets, points[3]), 1.0, points[3]);

  const double volume = a * a * a / 6.0;
  EXPECT_NEAR(body.mass, volume, 1e-14 * volume);
  EXPECT_LT((body.centre - Vec3::Constant(a / 4.0)).norm(), 1e-15);
  const double square = volume * a * a * (1.0 / 10.0 - 1.0 / 16.0);
  const double product = volume * a * a * (1.0 / 20.0 - 1.0 / 16.0);
  EXPECT_NEAR(body.inertia(0, 0), 2.0 * square, 1e-13 * square);
  EXPECT_NEAR(body.inertia(0, 1), -product, 1e-13 * square);
}

TEST(SolidMoments, DoNotDependOnWhichWayTheFacetsFace) {
  geometry::Mesh mesh = geometry::icosphere(0.4, 2);
  const MassProperties outwards = solid(mesh, 1000.0);
  for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);

  const MassProperties inwards = solid(mesh, 1000.0);

  EXPECT_NEAR(inwards.mass, outwards.mass, 1e-13 * outwards.mass);
  EXPECT_LT((inwards.inertia - outwards.inertia).norm(), 1e-12 * outwards.inertia.norm());
}

// A polyhedron within the sphere, whose edges subtend 2 pi / (5 2^n) at most, so that its facets are
// within (1 - cos(edge angle / sqrt(3))) of the radius: 4 subdivisions 0.14 %; three times that in
// volume, five times in inertia.
TEST(SolidMoments, OfAnIcosphereComeToThoseOfTheSphere) {
  const double radius = 0.4;

  const MassProperties body = solid(geometry::icosphere(radius, 4), 1000.0);

  const double mass = 1000.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  EXPECT_NEAR(body.mass, mass, 3 * 1.4e-3 * mass);
  EXPECT_LT(body.centre.norm(), 1e-13);
  EXPECT_NEAR(body.inertia(0, 0), 0.4 * mass * radius * radius,
              5 * 1.4e-3 * 0.4 * mass * radius * radius);
  EXPECT_NEAR(body.inertia(0, 1), 0.0, 1e-12);
}

// A plate a x b x t: m / 12 (b² + t²), m / 12 (a² + t²), m / 12 (a² + b²).
TEST(ShellMoments, OfAFlatSheetAreThoseOfAPlate) {
  const std::vector<Vec3> points{Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(2, 1, 1), Vec3(0, 1, 1)};
  const Facets facets{{NodeId{0}, NodeId{1}, NodeId{2}}, {NodeId{0}, NodeId{2}, NodeId{3}}};

  const MassProperties body =
      mass_of(shell_moments(points, facets, 0.1, points[0]), 500.0, points[0]);

  EXPECT_NEAR(body.mass, 100.0, 1e-11);
  EXPECT_LT((body.centre - Vec3(1, 0.5, 1)).norm(), 1e-14);
  const Vec3 moments(100.0 / 12.0 * 1.01, 100.0 / 12.0 * 4.01, 100.0 / 12.0 * 5.0);
  EXPECT_LT((body.inertia - Mat3(moments.asDiagonal())).norm(), 1e-11);
}

TEST(MassProperties, OfTwoHalvesAreThoseOfTheWhole) {
  const geometry::Mesh half = geometry::box_shell(Vec3(1, 1, 1), {1, 1, 1});
  geometry::Mesh other = half;
  for (Vec3& x : other.points) x += Vec3(1, 0, 0);

  const MassProperties body = together(solid(half, 3.0), solid(other, 3.0));

  const MassProperties whole = solid(geometry::box_shell(Vec3(2, 1, 1), {1, 1, 1}), 3.0);
  EXPECT_NEAR(body.mass, 6.0, 1e-14);
  EXPECT_LT((body.inertia - whole.inertia).norm(), 1e-13);
}

TEST(PrincipalAxes, GiveTheTensorBack) {
  Mat3 inertia;
  inertia << 3.0, 0.2, -0.4, 0.2, 2.0, 0.1, -0.4, 0.1, 4.0;

  const auto [moments, orientation] = principal_axes(inertia);

  const Mat3 axes = orientation.toRotationMatrix();
  EXPECT_LT((axes * moments.asDiagonal() * axes.transpose() - inertia).norm(), 1e-14);
  EXPECT_GT(axes.determinant(), 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::mass_properties_test

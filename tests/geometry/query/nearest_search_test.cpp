// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/nearest_search.hpp"

#include "geometry/query/surface_query.hpp"
#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::geometry::nearest_search_test {
namespace {

using test::Complex;

constexpr double kKernelError = 1e-12;  // of a distance (primitive_pairs.hpp)

NearestCell nearest_of_all(const Probe& probe, const PlacedSurface& on) {
  NearestCell best{CellId{0}, proximity(probe, on, CellId{0})};
  for (std::size_t c = 1; c < on.surface.cell_count(); ++c) {
    const Proximity found = proximity(probe, on, id_at<CellId>(c));
    if (found.gap < best.proximity.gap) best = {id_at<CellId>(c), found};
  }
  return best;
}

double least_gap(const PlacedSurface& on_a, const PlacedSurface& on_b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < on_a.surface.cell_count(); ++a) {
    for (std::size_t b = 0; b < on_b.surface.cell_count(); ++b)
      least = std::min(least, proximity(on_a, id_at<CellId>(a), on_b, id_at<CellId>(b)).gap);
  }
  return least;
}

Probe probe_at(test::Random& random, const Vec3& at) {
  if (random.coin()) return Probe::point(at);
  if (random.coin()) return Probe::cylinder(at, at + random.in_cube(1.0), random.unit());
  return Probe::facet({at, at + random.in_cube(1.0), at + random.in_cube(1.0)}, 0.0);
}

TEST(NearestCell, IsThatOfBruteForceOnDegenerateSurfacesOfAnyScale) {
  test::Random random(1);
  for (int trial = 0; trial < 600; ++trial) {
    Complex complex = trial % 2 == 0 ? test::random_degenerate_complex(random)
                                     : test::random_complex(random, trial % 4 == 1);
    if (complex.facets.empty() && complex.cylinders.empty()) continue;
    const double scale = std::array{1.0, 1e-100, 1e-6, 1e70}[random.index(4)];
    for (Vec3& x : complex.x) x *= scale;
    for (Facet& facet : complex.facets) facet.radius = 0.0;
    for (Cylinder& cylinder : complex.cylinders) cylinder.radius = 0.0;
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    for (int k = 0; k < 5; ++k) {
      Probe probe = probe_at(random, random.on_lattice(-1, 4));
      for (Vec3& corner : probe.core.x) corner *= scale;
      probe.radius *= scale;

      const NearestCell found = *query.nearest(probe);

      const NearestCell expected = nearest_of_all(probe, {surface, complex.x});
      const double size = 10.0 * scale;
      ASSERT_NEAR(found.proximity.gap, expected.proximity.gap, kKernelError * size) << trial;
    }
  }
}

/// Radii of structures differ by more than their distances.
TEST(NearestCell, CountsTheRadiusOfEachStructure) {
  test::Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    Complex complex;
    for (int k = 0; k < 60; ++k) {
      const Vec3 at = random.in_cube(3.0);
      const int first = complex.node(at);
      complex.cylinder(first, complex.node(at + random.in_cube(0.3)));
      complex.cylinders.back().radius = random.coin() ? 1e-3 : random.unit();
    }
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    for (int k = 0; k < 20; ++k) {
      const Probe probe = probe_at(random, random.in_cube(4.0));
      const NearestCell found = *query.nearest(probe);
      const NearestCell expected = nearest_of_all(probe, {surface, complex.x});
      EXPECT_EQ(found.cell, expected.cell);
      EXPECT_EQ(found.proximity.gap, expected.proximity.gap);
    }
  }
}

TEST(NearestCell, IsFoundFromAnyDistance) {
  test::Random random(3);
  const Complex ball = test::ball(4);
  const Surface surface = ball.surface();
  const SurfaceQuery query(surface, ball.x);
  for (const double far : {0.0, 1e-300, 1.0, 1e3, 1e6, 1e9, 1e12, 1e15, 1e40, 1e74}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Probe probe = Probe::point(far * random.direction());
      const double expected = nearest_of_all(probe, {surface, ball.x}).proximity.gap;
      ASSERT_NEAR(query.nearest(probe)->proximity.gap, expected, kKernelError * (1.0 + far)) << far;
    }
  }
}

TEST(NearestCells, OfParallelAndCoincidentSheetsAreAsNearAsBruteForceFinds) {
  const Complex sheet = test::sheet(6);
  const Surface surface = sheet.surface();
  for (const double height : {0.0, 1e-9, 0.05, 0.3, 7.0}) {
    for (const double aside : {0.0, 0.37, 20.0}) {
      Complex above = sheet;
      for (Vec3& x : above.x) x += Vec3(aside, 0.5 * aside, height);

      const auto found = SurfaceQuery(surface, sheet.x).nearest(SurfaceQuery(surface, above.x));

      const double expected = least_gap({surface, sheet.x}, {surface, above.x});
      EXPECT_NEAR(found->proximity.gap, expected, kKernelError * 20.0);
      const Proximity again =
          proximity({surface, sheet.x}, found->a, PlacedSurface{surface, above.x}, found->b);
      EXPECT_EQ(found->proximity.gap, again.gap);
    }
  }
}

/// Two pairs of facets far from each other, of which the second is nearer.
TEST(NearestCells, AreFoundAmongFacetsWhoseAreasAreRoundedToNothing) {
  for (const double side : {1.0, 1e-80, 1e-100}) {
    Complex below, above;
    for (const auto& [x, height] : {std::pair{0.0, 1.0}, std::pair{50.0, 0.5}}) {
      for (auto& [complex, z] : {std::pair{&below, 0.0}, std::pair{&above, height}}) {
        const int first = complex->node(side * Vec3(x, 0, z));
        const int second = complex->node(side * Vec3(x + 1, 0, z));
        complex->facet(first, second, complex->node(side * Vec3(x, 1, z)));
        complex->facets.back().radius = 0.0;
      }
    }
    const Surface a = below.surface(), b = above.surface();

    const auto found = SurfaceQuery(a, below.x).nearest(SurfaceQuery(b, above.x));

    EXPECT_NEAR(found->proximity.gap, 0.5 * side, kKernelError * 50.0 * side);
  }
}

TEST(NearestCells, OfCrossingSurfacesHaveTheDeepestOverlap) {
  test::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Complex first = test::rotated(test::sheet(4), random.rotation());
    Complex second = test::rotated(test::ball(2), random.rotation());
    const Vec3 to = first.x[random.index(first.x.size())];
    for (Vec3& x : second.x) x += to;
    const Surface a = first.surface(), b = second.surface();

    const auto found = SurfaceQuery(a, first.x).nearest(SurfaceQuery(b, second.x));

    EXPECT_NEAR(found->proximity.gap, least_gap({a, first.x}, {b, second.x}), kKernelError * 10.0);
  }
}

TEST(NearestCells, OfSingleCellsAreTheseCells) {
  Complex one;
  one.facet(one.node(Vec3(0, 0, 0)), one.node(Vec3(1, 0, 0)), one.node(Vec3(0, 1, 0)));
  Complex other;
  other.cylinder(other.node(Vec3(0.2, 0.2, 3)), other.node(Vec3(0.2, 0.2, 5)));
  const Surface a = one.surface(), b = other.surface();

  const auto found = SurfaceQuery(a, one.x).nearest(SurfaceQuery(b, other.x));

  EXPECT_EQ(found->a, CellId{0});
  EXPECT_EQ(found->b, CellId{0});
  EXPECT_DOUBLE_EQ(found->proximity.gap, 3.0 - 0.2);
}

}  // namespace
}  // namespace plekton::geometry::nearest_search_test

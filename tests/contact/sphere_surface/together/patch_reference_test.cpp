// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/wrap_reference.hpp"

#include <gtest/gtest.h>

/// The patches of a ball against the reference "cells minus seams", on surfaces of every kind, and
/// what bars that wrap the ball give back against its levels.
namespace plekton::test::patch_reference_test {
namespace {

/// Compares one surface at many places. What it saw is counted, so that a test cannot pass by
/// seeing nothing.
struct Comparison {
  int compared = 0;
  int rings = 0;
  int shared = 0;   ///< compared cases with a pass in range
  int several = 0;  ///< compared cases of more than one patch
  int wraps = 0;    ///< compared cases where bars turn around the ball

  void check(const Complex& complex, Random& random, int places) {
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    CriticalFeatureFinder critical(surface);
    const auto cells = all_cells(surface);
    const auto nodes = cell_nodes(surface);
    for (int k = 0; k < places; ++k) {
      const Vec3 centre = place(complex, surface, random);
      const auto nearest = reference_contact(centre, 0.0, nodes, complex.x, identity).nearest;
      // Nearer than this the direction to the foot is rounding error.
      if (nearest < 1e-3) continue;
      const double range = choose_range(centre, nearest, critical, cells, complex.x, random);
      check_at(centre, range, complex, surface, nodes, finder, critical, cells);
      if (::testing::Test::HasFailure()) return;
    }
  }

 private:
  static double identity(double overlap) { return overlap; }

  /// Over a node, on the lattice, over an edge (square to a facet or to the edge), or anywhere
  /// near.
  static Vec3 place(const Complex& complex, const Surface& surface, Random& random) {
    const Vec3& node = complex.x[random.index(complex.x.size())];
    const EdgeId edge = id_at<EdgeId>(random.index(surface.edge_count()));
    const auto& ends = surface.nodes_of(edge);
    const Vec3& a = complex.x[index_of(ends[0])];
    const Vec3 u = complex.x[index_of(ends[1])] - a;
    const Vec3 on_edge = a + (random.coin() ? 0.5 : random.uniform(-0.3, 1.3)) * u;
    switch (random.integer(0, 4)) {
      case 0:
        return node + Vec3(0.0, 0.0, 0.25 * random.integer(1, 8));
      case 1:
        return 0.5 * random.on_lattice(-2, 10);
      case 2: {
        const auto faces = surface.faces_of(edge);
        Vec3 height = u.unitOrthogonal();
        if (!faces.empty()) {
          const auto& n = surface.nodes_of(faces[random.index(faces.size())]);
          const Vec3& x0 = complex.x[index_of(n[0])];
          height =
              (complex.x[index_of(n[1])] - x0).cross(complex.x[index_of(n[2])] - x0).normalized();
        }
        return on_edge + random.uniform(-1.0, 1.0) * height;
      }
      case 3:
        return on_edge + random.uniform(-1.0, 1.0) * u.unitOrthogonal();
      default:
        return node + random.in_cube(1.5);
    }
  }

  /// A range with an overlap of 1e-6 to 0.3 of it; half the time one that some pass is just within.
  static double choose_range(const Vec3& centre, double nearest, CriticalFeatureFinder& critical,
                             std::span<const CellId> cells, Positions x, Random& random) {
    const double widest = nearest / 0.7;
    if (random.coin()) {
      for (const CriticalFeature& feature : critical.find(centre, widest, cells, x)) {
        if (!feature.is_saddle()) continue;
        return std::min(widest,
                        feature.distance * (1.0 + std::pow(10.0, random.uniform(-9.0, -0.5))));
      }
    }
    return nearest / (1.0 - std::pow(10.0, random.uniform(-6.0, std::log10(0.3))));
  }

  void check_at(const Vec3& centre, double range, const Complex& complex, const Surface& surface,
                const std::vector<std::vector<int>>& nodes, PatchFinder& finder,
                CriticalFeatureFinder& critical, std::span<const CellId> cells) {
    const TotalContact total = total_contact(finder, centre, range, cells, complex.x);
    const auto expected = reference_contact(centre, range, nodes, complex.x, identity);
    ASSERT_EQ(total.patches, expected.components);
    // Each term of the reference carries a few roundings of the range, and the terms are a few
    // hundred.
    const bool is_shared =
        has_cycles_or_voids(critical, centre, range, cells, complex.x, total.patches);
    const double wrap = reference_wrap_energy(surface, complex.x, centre, range, contact::kTurn);
    if (is_shared) {
      // Holes begin at a mean over their rings, not where the shallowest pass does: of a ring of
      // two passes by at most 2.4 % of the energy, and of bars never too late (cycle_weights.hpp).
      ASSERT_NEAR(total.energy - wrap, expected.energy, 0.04 * expected.energy);
      if (complex.facets.empty()) {
        ASSERT_GE(total.energy - wrap, expected.energy - 1e-8 * range * range);
      }
      ++rings;
      return;
    }
    ++compared;
    shared += critical_passes(critical, centre, range, cells, complex.x);
    several += total.patches > 1;
    if (wrap > 0.0) {
      // Simpson's rule at steps of 1 / 4000 of the root of the depth.
      ASSERT_NEAR(total.energy, expected.energy + wrap, 1e-8 * range * range);
      ++wraps;
      return;
    }
    ASSERT_NEAR(total.overlaps, expected.overlaps, 1e-12 * range);
    ASSERT_NEAR((total.force - expected.force).norm(), 0.0, 1e-10 * range)
        << "centre " << centre.transpose() << ", range " << range;
  }

  static bool critical_passes(CriticalFeatureFinder& critical, const Vec3& centre, double range,
                              std::span<const CellId> cells, Positions x) {
    const auto found = critical.find(centre, range, cells, x);
    return std::any_of(found.begin(), found.end(),
                       [](const CriticalFeature& f) { return f.is_saddle(); });
  }
};

void expect_enough(const Comparison& comparison, int compared, int shared, int several) {
  EXPECT_GE(comparison.compared, compared);
  EXPECT_GE(comparison.shared, shared);
  EXPECT_GE(comparison.several, several);
}

TEST(PatchAgainstReference, AgreesOnSheetsOfAnyRoughness) {
  Random random(1);
  for (const double roughness : {0.0, 1e-12, 1e-3, 0.1}) {
    Comparison comparison;
    for (int k = 0; k < 20; ++k)
      comparison.check(roughened(sheet(6), 1.0, roughness, random), random, 300);
    SCOPED_TRACE(roughness);
    expect_enough(comparison, 900, roughness > 0.0 ? 100 : 0, 0);
  }
}

TEST(PatchAgainstReference, AgreesOnIntegerAndTurnedFlatSheets) {
  Random random(2);
  Comparison comparison;
  comparison.check(sheet(6), random, 1000);
  for (int k = 0; k < 60; ++k) comparison.check(rotated(sheet(5), random.rotation()), random, 200);
  expect_enough(comparison, 1800, 100, 0);
}

TEST(PatchAgainstReference, AgreesOnClosedSurfaces) {
  Random random(3);
  Comparison comparison;
  for (int k = 0; k < 10; ++k) {
    comparison.check(rotated(cube(3), random.rotation()), random, 300);
    comparison.check(rotated(ball(2), random.rotation()), random, 300);
  }
  comparison.check(cube(4), random, 400);
  expect_enough(comparison, 1000, 100, 50);
}

TEST(PatchAgainstReference, AgreesWhereManyCylindersMeetAtANode) {
  Random random(4);
  Comparison comparison;
  for (int k = 0; k < 2000; ++k)
    comparison.check(junction(random.integer(1, 7), random), random, 10);
  expect_enough(comparison, 15000, 2000, 400);
  EXPECT_GE(comparison.wraps, 400);
}

TEST(PatchAgainstReference, AgreesOnFinsBooksAndBowTies) {
  Random random(5);
  Comparison comparison;
  for (int k = 0; k < 60; ++k) comparison.check(sheet_with_fin(0.1, random), random, 30);
  for (int k = 0; k < 200; ++k) {
    std::vector<double> angles(static_cast<std::size_t>(random.integer(1, 5)));
    for (double& angle : angles) angle = random.uniform(0.0, 360.0);
    comparison.check(rotated(book(angles), random.rotation()), random, 10);
  }
  comparison.check(bow_tie(), random, 300);
  expect_enough(comparison, 1200, 300, 50);
}

TEST(PatchAgainstReference, AgreesOnRandomNonManifoldComplexes) {
  Random random(6);
  Comparison comparison;
  for (int k = 0; k < 2000; ++k) {
    const Complex complex = random_complex(random, random.coin());
    if (complex.surface().cell_count() > 0) comparison.check(complex, random, 10);
  }
  expect_enough(comparison, 3000, 1000, 300);
}

}  // namespace
}  // namespace plekton::test::patch_reference_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Sheets that lie flat on each other, their meshes registered or nearly so. k = 1 N/m: a force
/// over the overlap is a number of contacts, and a square of one range (sum of both radii) counts
/// for one.
namespace plekton::test {
namespace {

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.001;
constexpr double kHeight = kRange - kOverlap;

double largest_force_along_plane(const StructurePair& structure_pair) {
  double largest = 0.0;
  for (const Vec3& force : structure_pair.forces())
    largest = std::max(largest, force.head<2>().norm());
  return largest;
}

TEST(FlatSheets, PushAtTheMiddleOfARegisteredSquareAtEveryAngle) {
  const Body b = sheet(8, 8, 0.4, 0.4);
  for (const double turn : {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    StructurePair structure_pair(sheet(20, 20, 1.0, 1.0), b, kRange);
    structure_pair.place(moved(b, {0.0, 0.0, turn}, {0.0, 0.0, kHeight}));
    EXPECT_NEAR(structure_pair.force_on_b().z() / kOverlap, 16.0, 1e-9) << turn;
    const Vec3 moment = structure_pair.moment_on_b({0.0, 0.0, kHeight});
    // Edges that cross at 1e-12 do so at a place that rounding moves by 1e-4 of their length.
    const double part_of_side = turn == 1e-12 ? 1e-5 : 1e-6;
    EXPECT_LT(moment.head<2>().norm(), part_of_side * 0.4 * structure_pair.force_on_b().norm())
        << turn;
  }
}

TEST(FlatSheets, HardlyPushNodesAlongThePlaneOfADish) {
  for (const double slope : {1e-6, 1e-5, 1e-4, 1e-3}) {
    for (const double turn : {0.0, 1e-9, 1e-7, 1e-5}) {
      Body b = sheet(2, 2, 0.4, 0.4);
      for (Vec3& x : b.x) x.z() += slope * x.head<2>().norm();
      StructurePair structure_pair(sheet(2, 2, 0.4, 0.4), b, kRange);
      structure_pair.place(moved(b, {0.0, 0.0, turn}, {0.0, 0.0, kHeight}));
      EXPECT_LT(largest_force_along_plane(structure_pair),
                1e-3 * structure_pair.force_on_b().norm())
          << slope << ' ' << turn;
    }
  }
}

// The diagonals of two pairs of facets cross at an angle that goes to 0.
TEST(FlatSheets, PushNoHarderThanTheNormalForceWhereEdgesCoincide) {
  for (const double d : {1e-6, 1e-9, 1e-12}) {
    Body lower;
    lower.x = {{0, -0.5, 0}, {0, 0.5, 0}, {-0.6, 0, 0}, {0.6, 0, 0}};
    lower.facets = {{0, 1, 2}, {0, 3, 1}};
    const double z = 2 * 5e-3 - 2e-5;
    Body upper;
    upper.x = {{-d, -0.05, z}, {d, 0.05, z + 1e-5}, {-0.05, 0.01, z}, {0.05, -0.01, z}};
    upper.facets = {{0, 1, 2}, {0, 3, 1}};
    StructurePair structure_pair(lower, upper, 1e-2);
    structure_pair.place(upper);
    const double normal = structure_pair.force_on_b().z();
    EXPECT_GT(normal, 0.0);
    for (const Vec3& force : structure_pair.forces()) {
      EXPECT_LT(force.norm(), normal) << d;
      EXPECT_LT(force.head<2>().norm(), 1e-2 * normal) << d;
    }
  }
}

// Stiffness of a node: that of the facets around it, 6 * (side^2 / 2) / range^2 / 6 contacts or so.
TEST(FlatSheets, PushANodeAlikeOnBothSidesOfFlat) {
  const Body a = sheet(4, 4, 0.8, 0.8);
  const Body b = sheet(2, 2, 0.4, 0.4);
  const std::size_t middle = 4;
  const auto force_at = [&](double height) {
    Body bent = moved(b, Vec3::Zero(), {0.0, 0.0, kHeight});
    bent.x[middle].z() += height;
    StructurePair structure_pair(a, b, kRange);
    structure_pair.place(bent);
    return structure_pair.forces()[structure_pair.first_node_of_b() + middle].z();
  };
  const double step = 1e-10;
  const double stiffness = 16.0;  // N/m, of the whole sheet: more than that of one node
  EXPECT_LT(std::abs(force_at(step) - force_at(-step)), 2.0 * step * stiffness);
}

/// A bumpy sheet.
Body bumpy(int cells, double side, double height, Random& random) {
  Body body = sheet(cells, cells, side, side, Cut::alternating);
  for (Vec3& x : body.x) x.z() += height * random.uniform(-1.0, 1.0);
  return body;
}

TEST(FlatSheets, PushAgainstTheGradientOfTheirEnergyAlsoOntoTheirMirrorImage) {
  Random random(5);
  for (const double height : {0.0, 1e-6, 1e-5, 1e-4, 5e-4, 2e-3}) {
    const Body a = bumpy(5, 1.0, height, random);
    Body b;  // its middle, turned over
    for (std::size_t j = 1; j < 5; ++j) {
      for (std::size_t i = 1; i < 5; ++i) b.x.push_back(a.x[6 * j + i]);
    }
    b.facets = sheet(3, 3, 0.6, 0.6, Cut::alternating).facets;
    for (Vec3& x : b.x) x.z() = kHeight - x.z();
    StructurePair structure_pair(a, b, kRange);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<Vec3> direction;
      for (std::size_t i = 0; i < b.x.size(); ++i)
        direction.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const auto energy_at = [&](double step) {
        Body shifted = b;
        for (std::size_t i = 0; i < b.x.size(); ++i) shifted.x[i] += step * direction[i];
        structure_pair.place(shifted);
        return structure_pair.energy();
      };
      // Central differences; the third derivative is that of shares, k / overlap.
      constexpr double kStep = 1e-9;
      const double change = (energy_at(kStep) - energy_at(-kStep)) / (2.0 * kStep);
      energy_at(0.0);
      double power = 0.0, scale = 0.0;
      for (std::size_t i = 0; i < b.x.size(); ++i) {
        const Vec3& force = structure_pair.forces()[structure_pair.first_node_of_b() + i];
        power += force.dot(direction[i]);
        scale += force.norm() * direction[i].norm();
      }
      EXPECT_NEAR(power, -change, 1e-5 * scale) << height;
    }
  }
}

/// N. Where a rim of one sheet passes over an edge of the other, the other's resistance to a fold
/// there begins or ends: a fold by an angle t makes its facets, seen along their normals from one
/// range above, share or miss a strip of range * t, with energy / range^2 on it. A node of cells of
/// 0.2 m is the end of two edges in line with one facet on either side of each, and folds them by 4
/// / 0.2 m together at most.
constexpr double kFoldChange = 0.5 * kOverlap * kOverlap * 0.2 / kRange * 4.0 / 0.2;

TEST(FlatSheets, ChangeTheirForcesInProportionToTheStep) {
  Random random(6);
  const Body a = sheet(5, 5, 1.0, 1.0);
  for (const double bump : {0.0, 1e-5, 2e-4}) {
    const Body b = bumpy(3, 0.6, bump, random);
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      direction.emplace_back(0.3 * random.uniform(-1, 1), 0.3 * random.uniform(-1, 1),
                             random.uniform(-1, 1));
    double last = 0.0;
    for (const double step : {1e-6, 1e-7, 1e-8}) {
      StructurePair structure_pair(a, b, kRange);
      double largest = 0.0;
      std::vector<Vec3> before;
      for (int i = -20; i <= 20; ++i) {
        Body placed = moved(b, Vec3::Zero(), {0.0, 0.0, kHeight});
        for (std::size_t n = 0; n < b.x.size(); ++n)
          placed.x[n] += (i - 0.37) * step * direction[n];
        structure_pair.place(placed);
        for (std::size_t n = 0; n < before.size(); ++n)
          largest = std::max(largest, (structure_pair.forces()[n] - before[n]).norm());
        before = structure_pair.forces();
      }
      if (last > 0.0) {
        EXPECT_LT(largest, std::max(0.15 * last, kFoldChange)) << bump << ' ' << step;
      }
      last = largest;
    }
  }
}

}  // namespace
}  // namespace plekton::test

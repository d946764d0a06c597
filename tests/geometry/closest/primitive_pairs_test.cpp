// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/primitive_pairs.hpp"

#include "tests/support/complexes.hpp"
#include "tests/support/exact_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::geometry::primitive_pairs_test {
namespace {

using test::Complex;

std::vector<Vec3> corners_of(const Surface& surface, CellId cell, Positions x) {
  std::vector<Vec3> corners;
  for (const NodeId node : surface.nodes_of(cell)) corners.push_back(x[index_of(node)]);
  return corners;
}

/// The corners, of those of a cell, that span a feature.
unsigned witness_features_of(const Surface& surface, CellId cell, const Feature& feature) {
  unsigned bits = 0;
  const auto nodes = surface.nodes_of(cell);
  for (const NodeId node : test::nodes_of(surface, feature)) {
    const auto at = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
    bits |= 1U << at;
  }
  return bits;
}

/// Judges the features and the distance that a proximity of two cells names.
void expect_true(const Surface& surface, CellId a, CellId b, Positions x, const Proximity& p) {
  const auto corners_a = corners_of(surface, a, x);
  const auto corners_b = corners_of(surface, b, x);
  const test::ExactPair pair(corners_a, corners_b);
  const auto feet = pair.feet(witness_features_of(surface, a, p.a.feature),
                              witness_features_of(surface, b, p.b.feature));
  ASSERT_TRUE(feet.has_value());
  EXPECT_TRUE(pair.are_nearest(*feet));
  const double distance = static_cast<double>(pair.distance(*feet));
  EXPECT_EQ(p.relation == Relation::touching_or_crossing, distance == 0.0);
  if (p.relation == Relation::touching_or_crossing) {
    EXPECT_LE(p.gap, -0.2);
    EXPECT_LE((position(p.a, x) - position(p.b, x)).norm(), 1e-14 * 10.0);
    return;
  }
  EXPECT_NEAR(p.gap, distance - 0.2, 1e-12 * distance + 1e-16);
  EXPECT_LE((position(p.a, x) + (p.gap + 0.2) * p.normal - position(p.b, x)).norm(), 1e-14 * 10.0);
}

TEST(ProximityOfCells, NamesTheExactFeaturesOfTheSurface) {
  test::Random random(1);
  for (int trial = 0; trial < 400 && !::testing::Test::HasFailure(); ++trial) {
    const Complex complex = test::random_complex(random, random.coin());
    const Surface surface = complex.surface();
    for (std::size_t i = 0; i < surface.cell_count(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const CellId a = id_at<CellId>(i);
        const CellId b = id_at<CellId>(j);
        expect_true(surface, a, b, complex.x, proximity(surface, a, b, complex.x));
      }
    }
  }
}

TEST(ProximityOfCells, IsTheSameFromBothSides) {
  test::Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Complex complex = test::random_complex(random, random.coin());
    const Surface surface = complex.surface();
    for (std::size_t i = 0; i < surface.cell_count(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Proximity p = proximity(surface, id_at<CellId>(i), id_at<CellId>(j), complex.x);
        const Proximity q = proximity(surface, id_at<CellId>(j), id_at<CellId>(i), complex.x);

        EXPECT_EQ(p.gap, q.gap);
        EXPECT_EQ(p.a.feature, q.b.feature);
        EXPECT_EQ(p.b.feature, q.a.feature);
        EXPECT_EQ(p.a.weights, q.b.weights);
        EXPECT_EQ(p.normal, -q.normal);
      }
    }
  }
}

// Every cell that holds the nearest feature of a sheet gives the same answer, whatever else it is.
TEST(ProximityOfCells, AgreesBitForBitBetweenFacetsOnTheirCommonEdge) {
  Complex complex = test::book({-100, 100, 170});
  complex.cylinder(complex.node(Vec3(3, -2, 0.25)), complex.node(Vec3(2.9, 2, -0.125)));
  const Surface surface = complex.surface();
  const CellId bar{3};

  const Proximity first = proximity(surface, CellId{0}, bar, complex.x);

  ASSERT_EQ(first.a.feature.kind, FeatureKind::edge);
  for (int k = 1; k < 3; ++k) {
    const Proximity other = proximity(surface, CellId{k}, bar, complex.x);
    EXPECT_EQ(other.a.feature, first.a.feature);
    EXPECT_EQ(other.a.weights, first.a.weights);
    EXPECT_EQ(other.gap, first.gap);
    EXPECT_EQ(other.normal, first.normal);
  }
}

TEST(ProximityOfCells, OfNeighboursIsTheirCommonNode) {
  const Complex complex = test::bow_tie();
  const Surface surface = complex.surface();

  const Proximity p = proximity(surface, CellId{0}, CellId{1}, complex.x);

  EXPECT_EQ(p.relation, Relation::touching_or_crossing);
  EXPECT_EQ(p.a.feature, Feature(NodeId{0}));
  EXPECT_EQ(p.b.feature, Feature(NodeId{0}));
  EXPECT_LE(p.gap, -0.2);
}

TEST(ProximityOfCells, ReportsABarThroughASheetWithTheWayOut) {
  Complex complex;
  for (const Vec3& x : {Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)}) complex.node(x);
  complex.facet(0, 1, 2);
  complex.cylinder(complex.node(Vec3(0, 0, -0.25)), complex.node(Vec3(0, 0, 4)));
  const Surface surface = complex.surface();

  const Proximity p = proximity(surface, CellId{0}, CellId{1}, complex.x);

  EXPECT_EQ(p.relation, Relation::touching_or_crossing);
  EXPECT_EQ(p.normal, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(p.gap, -0.25 - 0.2);
  EXPECT_LE((position(p.a, complex.x) - position(p.b, complex.x)).norm(), 1e-15);
}

TEST(ProximityOfAProbe, IsTheGapOfASphereThatNoNodeCarries) {
  const Complex complex = test::sheet(2);
  const Surface surface = complex.surface();

  const Proximity p =
      proximity(Probe::ball(Vec3(0.6, 0.3, 0.75), 0.25), {surface, complex.x}, CellId{0});

  EXPECT_DOUBLE_EQ(p.gap, 0.75 - 0.25 - 0.1);
  EXPECT_EQ(p.normal, Vec3(0, 0, -1));
  EXPECT_EQ(p.a.feature, Feature(NodeId{0}));
}

TEST(ProximityOfAProbe, NamesItsOwnCornersAndSides) {
  const Complex complex = test::sheet(2);
  const Surface surface = complex.surface();
  const PlacedSurface sheet{surface, complex.x};
  const std::array<Vec3, 3> wedge{Vec3(0.5, 0.25, 3), Vec3(0.5, 0.25, 1), Vec3(0.75, 0.5, 2)};
  const std::array<Vec3, 3> beside{Vec3(0.25, -1, -1), Vec3(0.5, -9, 0.25), Vec3(0.75, -1, 1)};

  EXPECT_EQ(proximity(Probe::facet(wedge, 0.1), sheet, CellId{0}).a.feature, Feature(NodeId{1}));
  EXPECT_EQ(proximity(Probe::facet(beside, 0.1), sheet, CellId{0}).a.feature, Feature(EdgeId{2}));
  EXPECT_EQ(proximity(Probe::cylinder(wedge[1], wedge[2], 0.1), sheet, CellId{0}).a.feature,
            Feature(NodeId{0}));
}

}  // namespace
}  // namespace plekton::geometry::primitive_pairs_test

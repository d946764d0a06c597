// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/critical_features.hpp"

#include "tests/support/complexes.hpp"
#include "tests/support/exact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace plekton::geometry::critical_features_test {
namespace {

using test::Complex;
using ::testing::ElementsAre;
using ::testing::Pair;

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// {coefficient, branches} of a feature.
std::pair<int, int> link_of(const Complex& complex, Feature feature, const Vec3& point) {
  const Surface surface = complex.surface();
  const DescendingLink link = CriticalFeatureFinder(surface).link(feature, point, complex.x);
  return {link.coefficient, link.branches};
}

const Feature kSpine{EdgeId{0}};  // the common edge of a book
const Feature kCentre{NodeId{0}};

/// Spokes from the origin to a circle of radius 1 at a height, with facets between the first
/// neighbours.
Complex umbrella(int spokes, double height, int facets) {
  Complex result;
  result.node(Vec3::Zero());
  for (int k = 0; k < spokes; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / spokes;
    result.cylinder(0, result.node(Vec3(std::cos(angle), std::sin(angle), height)));
  }
  for (int k = 0; k < facets; ++k) result.facet(0, 1 + k, 1 + (k + 1) % spokes);
  return result;
}

TEST(DescendingLink, OfAFaceIsEmptyUnderAPointOverItsInside) {
  const Complex sheet = test::sheet(1);

  EXPECT_THAT(link_of(sheet, Feature(FaceId{0}), Vec3(0.75, 0.25, 1)), Pair(1, 0));
  EXPECT_THAT(link_of(sheet, Feature(FaceId{1}), Vec3(0.75, 0.25, 1)), Pair(0, -1));
  EXPECT_THAT(link_of(sheet, Feature(FaceId{0}), Vec3(0.5, 0.5, 1)),
              Pair(0, -1));  // over the side: not inside
}

TEST(DescendingLink, OfAnEdgeCountsTheFacetsThatFallAwayFromIt) {
  const Vec3 point(1, 0, 0);

  EXPECT_THAT(link_of(test::book({120, -120}), kSpine, point), Pair(1, 0));  // convex
  // cos 90 degrees is rounded to 6e-17: concave, and the exact signs see it.
  EXPECT_THAT(link_of(test::book({90, -90}), kSpine, point), Pair(-1, 2));
  EXPECT_THAT(link_of(test::book({30, -120}), kSpine, point), Pair(0, 1));     // beside it
  EXPECT_THAT(link_of(test::book({30, -30}), kSpine, point), Pair(-1, 2));     // concave: a saddle
  EXPECT_THAT(link_of(test::book({60, 0, -60}), kSpine, point), Pair(-2, 3));  // non-manifold
  EXPECT_THAT(link_of(test::book({60, 0, -60, 150}), kSpine, point), Pair(-2, 3));
  EXPECT_THAT(link_of(test::book({}), kCentre, point), Pair(1, 0));
}

TEST(DescendingLink, OfAnEdgeOnAFlatSheetIsEmptyUnderAPointOverIt) {
  const Complex sheet = test::sheet(1);
  const Feature diagonal{EdgeId{2}};

  ASSERT_EQ(sheet.surface().faces_of(EdgeId{2}).size(), 2U);
  EXPECT_THAT(link_of(sheet, diagonal, Vec3(0.5, 0.5, 1)), Pair(1, 0));
  EXPECT_THAT(link_of(sheet, diagonal, Vec3(0.5, 0.5, 0)), Pair(1, 0));
  EXPECT_THAT(link_of(sheet, diagonal, Vec3(0.75, 0.25, 1)), Pair(0, 1));
}

TEST(DescendingLink, OfAnEdgeNeedsAFootBetweenTheEnds) {
  const Complex book = test::book({30, -30});

  EXPECT_THAT(link_of(book, kSpine, Vec3(1, 0, 1)), Pair(0, -1));
  EXPECT_THAT(link_of(book, kSpine, Vec3(1, 0, 5)), Pair(0, -1));
  EXPECT_THAT(link_of(book, kSpine, Vec3(1, 0, std::nextafter(1.0, 0.0))), Pair(-1, 2));
}

TEST(DescendingLink, OfAStarCountsTheCylindersThatFall) {
  const Vec3 above(0, 0, 3);

  for (const int spokes : {1, 2, 3, 7}) {
    EXPECT_THAT(link_of(umbrella(spokes, -1, 0), kCentre, above), Pair(1, 0));
    EXPECT_THAT(link_of(umbrella(spokes, 1, 0), kCentre, above), Pair(1 - spokes, spokes));
  }
  EXPECT_THAT(link_of(umbrella(4, 0, 0), kCentre, above), Pair(1, 0));  // level: no direction falls
}

TEST(DescendingLink, OfANodeJoinsFallingEdgesByFacets) {
  const Vec3 above(0, 0, 3);

  EXPECT_THAT(link_of(umbrella(5, 1, 1), kCentre, above), Pair(-3, 4));
  EXPECT_THAT(link_of(umbrella(5, 1, 4), kCentre, above), Pair(0, 1));  // an open fan
  EXPECT_THAT(link_of(umbrella(5, 1, 5), kCentre, above),
              Pair(1, 1));  // the bottom of a pit: a maximum of the distance
  EXPECT_THAT(link_of(test::bow_tie(), kCentre, Vec3(0, 0, 9)),
              Pair(-1, 2));  // the second facet and the cylinder
  EXPECT_THAT(link_of(test::bow_tie(), kCentre, Vec3(1, 0, 0)), Pair(0, 1));
}

TEST(DescendingLink, OfANodeMayHaveSeveralPiecesAndCoefficientZero) {
  Complex pit = umbrella(5, 1, 5);
  pit.cylinder(0, pit.node(Vec3(0, 0, 1)));
  const Surface surface = pit.surface();
  CriticalFeatureFinder finder(surface);
  const Vec3 above(0, 0, 3);
  std::vector<CellId> cells(surface.cell_count());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = id_at<CellId>(c);

  EXPECT_THAT(link_of(pit, kCentre, above), Pair(0, 2));
  const auto found = finder.find(above, 10.0, cells, pit.x);
  EXPECT_EQ(std::count_if(found.begin(), found.end(),
                          [](const auto& f) { return f.core.feature == kCentre; }),
            1);
}

TEST(CriticalFeature, KnowsMinimaAndPasses) {
  const CriticalFeature minimum{test::core_point(NodeId{0}), Vec3::UnitX(), 1.0, 1, 0};
  const CriticalFeature saddle{test::core_point(NodeId{0}), Vec3::UnitX(), 1.0, -1, 2};
  const CriticalFeature maximum{test::core_point(NodeId{0}), Vec3::UnitX(), 1.0, 1, 1};

  EXPECT_TRUE(minimum.is_minimum() && !minimum.is_saddle());
  EXPECT_TRUE(!saddle.is_minimum() && saddle.is_saddle());
  EXPECT_FALSE(maximum.is_minimum() || maximum.is_saddle());
}

/// Distance of a closed feature (m).
double exact_distance(const Surface& surface, Feature feature, const Vec3& point, Positions x) {
  const auto n = test::nodes_of(surface, feature);
  const auto at = [&](std::size_t k) { return x[index_of(n[k])]; };
  if (n.size() == 1)
    return static_cast<double>(test::exact_foot(point, std::array{at(0)}).distance());
  if (n.size() == 2)
    return static_cast<double>(test::exact_foot(point, std::array{at(0), at(1)}).distance());
  return static_cast<double>(test::exact_foot(point, std::array{at(0), at(1), at(2)}).distance());
}

/// Minima, saddles and maxima of a whole complex by link(), with their distances.
std::map<Feature, std::pair<DescendingLink, double>> critical_features(const Complex& complex,
                                                                       const Surface& surface,
                                                                       const Vec3& point) {
  CriticalFeatureFinder finder(surface);
  std::map<Feature, std::pair<DescendingLink, double>> result;
  for (const Feature feature : test::features_of(surface)) {
    const DescendingLink link = finder.link(feature, point, complex.x);
    if (link.coefficient == 0 && link.branches < 2) continue;
    result[feature] = {link, exact_distance(surface, feature, point, complex.x)};
  }
  return result;
}

/// Checks what find() returned against the list of the whole complex. Distances so near to the
/// range that rounding decides may be in or out.
void expect_found(std::span<const CriticalFeature> found, const Complex& complex,
                  const Surface& surface, const Vec3& point, double range) {
  auto missing = critical_features(complex, surface, point);
  const double rounding = 64.0 * kEps * (range + 10.0);  // 10 m: size of the complexes
  CellId last{0};
  for (const CriticalFeature& one : found) {
    const auto expected = missing.find(one.core.feature);
    ASSERT_NE(expected, missing.end())
        << one.core.feature << " is not critical, or was found twice";
    const auto& [link, distance] = expected->second;
    EXPECT_EQ(one.coefficient, link.coefficient);
    EXPECT_EQ(one.branches, link.branches);
    EXPECT_NEAR(one.distance, distance, rounding);
    EXPECT_LT(one.distance, range);
    EXPECT_NEAR((position(one.core, complex.x) - point - one.distance * one.direction).norm(), 0.0,
                rounding);
    EXPECT_NEAR(one.direction.norm(), 1.0, 4.0 * kEps);
    missing.erase(expected);
    const Feature feature = one.core.feature;
    const CellId owner = feature.kind == FeatureKind::face   ? CellId{feature.id}
                         : feature.kind == FeatureKind::edge ? surface.owner_of(EdgeId{feature.id})
                                                             : surface.owner_of(NodeId{feature.id});
    EXPECT_LE(last, owner);
    last = owner;
  }
  for (const auto& [feature, entry] : missing)
    EXPECT_GE(entry.second, range - rounding) << feature << " was not found";
}

TEST(CriticalFeatureFinder, FindsWhatLinkNamesInRangeOnceFromAllCellsAndFromNearCells) {
  test::Random random(1);
  for (int trial = 0; trial < 1500; ++trial) {
    Complex complex = test::random_complex(random, random.coin());
    if (random.coin()) complex = test::rotated(complex, random.rotation());
    const Surface surface = complex.surface();
    CriticalFeatureFinder finder(surface);
    std::vector<CellId> all(surface.cell_count());
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = id_at<CellId>(c);
    for (int query = 0; query < 4; ++query) {
      const Vec3 point = test::random_point(random, complex);
      const double range = random.coin() ? random.uniform(0.0, 4.0) : random.integer(0, 4);
      std::vector<CellId> near;
      for (const CellId cell : all) {
        const double distance = exact_distance(surface, surface.feature_of(cell), point, complex.x);
        if (distance < range * (1.0 + 1e-9) + 1e-9 || random.integer(0, 3) == 0)
          near.push_back(cell);
      }

      expect_found(finder.find(point, range, all, complex.x), complex, surface, point, range);
      expect_found(finder.find(point, range, near, complex.x), complex, surface, point, range);
      if (HasFailure()) FAIL() << "trial " << trial << " at " << point.transpose();
    }
  }
}

TEST(CriticalFeatureFinder, FindsEverythingInAnInfiniteRange) {
  const Complex cube = test::cube(2);
  const Surface surface = cube.surface();
  CriticalFeatureFinder finder(surface);
  std::vector<CellId> all(surface.cell_count());
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = id_at<CellId>(c);
  const Vec3 point(0.9, 0.8, 0.7);

  const auto found = finder.find(point, std::numeric_limits<double>::infinity(), all, cube.x);

  EXPECT_EQ(found.size(), critical_features(cube, surface, point).size());
  EXPECT_EQ(std::accumulate(found.begin(), found.end(), 0,
                            [](int sum, const auto& f) { return sum + f.coefficient; }),
            surface.euler_characteristic());
}

TEST(CriticalFeatureFinder, FindsOneContactOnAFlatSheetWhereverThePointIs) {
  const Complex flat = test::sheet(4);
  const Surface surface = flat.surface();
  CriticalFeatureFinder finder(surface);
  std::vector<CellId> all(surface.cell_count());
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = id_at<CellId>(c);

  for (int i = 0; i <= 32; ++i) {
    for (int j = 0; j <= 32; ++j) {
      const auto found = finder.find(Vec3(i * 0.125, j * 0.125, 0.25), 1.0, all, flat.x);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].coefficient, 1);
      EXPECT_TRUE(found[0].is_minimum());
      EXPECT_EQ(found[0].distance, 0.25);
    }
  }
}

/// Pieces of the link of a node by exact signs: each falling edge, with the set of falling edges it
/// is joined to.
std::vector<std::set<std::int32_t>> pieces_of(const Surface& surface, NodeId node,
                                              const Vec3& point, Positions x) {
  std::vector<std::set<std::int32_t>> pieces;
  for (const EdgeId edge : surface.edges_of(node)) {
    const auto& ends = surface.nodes_of(edge);
    const NodeId other = ends[0] == node ? ends[1] : ends[0];
    if (test::exact_sign_past_vertex(x[index_of(node)], x[index_of(other)], point) > 0) {
      pieces.push_back({static_cast<std::int32_t>(edge)});
    }
  }
  for (const FaceId face : surface.faces_of(node)) {
    std::set<std::int32_t> joined;
    for (const EdgeId side : surface.edges_of(face)) {
      for (const auto& piece : pieces) {
        if (piece.contains(static_cast<std::int32_t>(side)))
          joined.insert(piece.begin(), piece.end());
      }
    }
    const auto touches = [&](const auto& piece) { return joined.contains(*piece.begin()); };
    if (std::count_if(pieces.begin(), pieces.end(), touches) < 2) continue;
    std::erase_if(pieces, touches);
    pieces.push_back(joined);
  }
  return pieces;
}

TEST(CriticalFeatureFinder, NamesOneCellDownhillForEachBranch) {
  test::Random random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const Complex complex = test::random_complex(random, random.coin());
    const Surface surface = complex.surface();
    CriticalFeatureFinder finder(surface);
    const Vec3 point = test::random_point(random, complex);
    for (const Feature feature : test::features_of(surface)) {
      const DescendingLink link = finder.link(feature, point, complex.x);
      if (link.branches < 0) continue;

      const auto cells = finder.branches(feature, point, complex.x);

      ASSERT_EQ(static_cast<int>(cells.size()), link.branches) << feature;
      EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
      if (feature.kind != FeatureKind::node) continue;
      const auto pieces = pieces_of(surface, NodeId{feature.id}, point, complex.x);
      ASSERT_EQ(pieces.size(), cells.size()) << feature;
      for (const auto& piece : pieces) {
        EXPECT_EQ(std::count_if(cells.begin(), cells.end(),
                                [&](Feature cell) { return piece.contains(cell.id); }),
                  1);
      }
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::critical_features_test

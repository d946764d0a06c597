// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/critical/descent.hpp"

#include "geometry/critical/critical_features.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace plekton::geometry::descent_test {
namespace {

using test::Complex;
using test::ExactFoot;

/// Exact nearest point of a closed feature; corners in ascending order of nodes.
ExactFoot exact_foot(const Surface& surface, Feature feature, const Vec3& point, Positions x) {
  auto n = test::nodes_of(surface, feature);
  std::sort(n.begin(), n.end());
  const auto at = [&](std::size_t k) { return x[index_of(n[k])]; };
  if (n.size() == 1) return test::exact_foot(point, std::array{at(0)});
  if (n.size() == 2) return test::exact_foot(point, std::array{at(0), at(1)});
  return test::exact_foot(point, std::array{at(0), at(1), at(2)});
}

std::vector<NodeId> sorted(std::vector<NodeId> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// One of many kinds of complexes, a third of them with repeated positions and facets without area.
Complex any_complex(test::Random& random) {
  switch (random.integer(0, 2)) {
    case 0:
      return test::random_degenerate_complex(random);
    case 1:
      return test::random_complex(random, true);
    default:
      return test::rotated(test::random_complex(random, random.coin()), random.rotation());
  }
}

TEST(ClosestFeature, IsTheLowestThatHoldsTheExactNearestPointAlsoWithoutAreaAndInAnyOrderOfNodes) {
  test::Random random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Complex complex = any_complex(random);
    if (complex.facets.empty() && complex.cylinders.empty()) continue;
    const Surface surface = complex.surface();
    const Vec3 point = test::random_point(random, complex);
    const Feature cell = surface.feature_of(id_at<CellId>(random.index(surface.cell_count())));
    const auto corners = sorted(test::nodes_of(surface, cell));
    const unsigned witness_features =
        exact_foot(surface, cell, point, complex.x).witness_features();
    std::vector<NodeId> expected;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if ((witness_features >> k & 1U) != 0) expected.push_back(corners[k]);
    }

    const Feature feature = closest_feature(surface, cell, point, complex.x);

    ASSERT_EQ(sorted(test::nodes_of(surface, feature)), expected)
        << "trial " << trial << ", " << cell;
  }
}

/// Connected parts of {distance <= level} of a whole complex.
class SublevelParts {
 public:
  SublevelParts(const Surface& surface, const ExactFoot& level, const Vec3& point, Positions x) {
    for (const Feature feature : test::features_of(surface)) {
      if (test::compare_distances(exact_foot(surface, feature, point, x), level) <= 0)
        part_[feature] = feature;
    }
    // The part of a convex cell is convex, so a cell and a feature of its rim hang together if both
    // have a part.
    for (std::size_t e = 0; e < surface.edge_count(); ++e) {
      for (const NodeId node : surface.nodes_of(id_at<EdgeId>(e)))
        join(Feature(id_at<EdgeId>(e)), Feature(node));
    }
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      for (const EdgeId edge : surface.edges_of(id_at<FaceId>(f)))
        join(Feature(id_at<FaceId>(f)), Feature(edge));
    }
  }

  bool connects(Feature a, Feature b) const {
    return part_.contains(a) && part_.contains(b) && root(a) == root(b);
  }

 private:
  Feature root(Feature feature) const {
    while (part_.at(feature) != feature) feature = part_.at(feature);
    return feature;
  }
  void join(Feature a, Feature b) {
    if (part_.contains(a) && part_.contains(b)) part_[root(a)] = root(b);
  }

  std::map<Feature, Feature> part_;
};

TEST(Descend, EndsInAMinimumOfTheConnectedPartItStartedIn) {
  test::Random random(2);
  for (int trial = 0; trial < 5000; ++trial) {
    const Complex complex = any_complex(random);
    const Surface surface = complex.surface();
    const auto features = test::features_of(surface);
    if (features.empty()) continue;
    CriticalFeatureFinder finder(surface);
    const Vec3 point = test::random_point(random, complex);
    const Feature start = features[random.index(features.size())];

    const Feature end = descend(surface, start, point, complex.x);

    const ExactFoot level = exact_foot(surface, start, point, complex.x);
    EXPECT_EQ(finder.link(end, point, complex.x).branches, 0);
    EXPECT_LE(test::compare_distances(exact_foot(surface, end, point, complex.x), level), 0);
    EXPECT_TRUE(SublevelParts(surface, level, point, complex.x).connects(start, end));
    EXPECT_EQ(descend(surface, end, point, complex.x), end);
    if (HasFailure()) FAIL() << "trial " << trial << " from " << start << " to " << end;
  }
}

TEST(Descend, StaysAtTheGlobalMinimumFromAnyCellThatHoldsIt) {
  test::Random random(3);
  for (int trial = 0; trial < 3000; ++trial) {
    const Complex complex = any_complex(random);
    const Surface surface = complex.surface();
    if (surface.cell_count() == 0) continue;
    const Vec3 point = test::random_point(random, complex);
    std::vector<ExactFoot> feet;
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      feet.push_back(exact_foot(surface, surface.feature_of(id_at<CellId>(c)), point, complex.x));
    }
    const auto nearest = std::min_element(
        feet.begin(), feet.end(),
        [](const ExactFoot& a, const ExactFoot& b) { return test::compare_distances(a, b) < 0; });

    for (std::size_t c = 0; c < feet.size(); ++c) {
      if (test::compare_distances(feet[c], *nearest) != 0) continue;
      const Feature cell = surface.feature_of(id_at<CellId>(c));
      EXPECT_EQ(descend(surface, cell, point, complex.x),
                closest_feature(surface, cell, point, complex.x));
    }
  }
}

TEST(Descend, EndsInOneMillionRandomWalksAlsoWithTiesAndDegenerateFacets) {
  test::Random random(4);
  int not_a_minimum = 0;
  for (int k = 0; k < 11000; ++k) {
    const Complex complex = any_complex(random);
    const Surface surface = complex.surface();
    const auto features = test::features_of(surface);
    if (features.empty()) continue;
    CriticalFeatureFinder finder(surface);
    for (int walk = 0; walk < 100; ++walk) {
      const Vec3 point = test::random_point(random, complex);

      const Feature end =
          descend(surface, features[random.index(features.size())], point, complex.x);

      not_a_minimum += finder.link(end, point, complex.x).branches != 0;
    }
  }
  EXPECT_EQ(not_a_minimum, 0);
}

TEST(Descend, CrossesAFlatSheetToTheOnlyMinimumFromAnywhere) {
  const Complex flat = test::sheet(6);
  const Surface surface = flat.surface();
  CriticalFeatureFinder finder(surface);
  const auto features = test::features_of(surface);
  for (const Vec3& point :
       {Vec3(2, 3, 1), Vec3(2.5, 2.5, 0), Vec3(0.5, 4, -1), Vec3(5.7, 0.2, 3), Vec3(-1, -1, 1)}) {
    std::vector<Feature> minima;
    for (const Feature feature : features) {
      if (finder.link(feature, point, flat.x).branches == 0) minima.push_back(feature);
    }
    ASSERT_EQ(minima.size(), 1U);

    for (const Feature start : features)
      EXPECT_EQ(descend(surface, start, point, flat.x), minima[0]);
  }
}

TEST(Descend, StopsInTheValleyOnTheSideOfTheRidgeItStartedOn) {
  const Complex roof =
      test::book({150, -150});  // both facets fall away from the point, edge 0 is the ridge
  const Surface surface = roof.surface();
  const Complex trough = test::book({30, -30});
  const Surface fold = trough.surface();

  EXPECT_EQ(descend(surface, Feature(FaceId{0}), Vec3(2, 0, 0), roof.x), Feature(EdgeId{0}));
  EXPECT_EQ(descend(fold, Feature(FaceId{0}), Vec3(0.5, 0, 0), trough.x), Feature(FaceId{0}));
  EXPECT_EQ(descend(fold, Feature(FaceId{1}), Vec3(0.5, 0, 0), trough.x), Feature(FaceId{1}));
}

}  // namespace
}  // namespace plekton::geometry::descent_test

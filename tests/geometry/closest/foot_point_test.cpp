// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/foot_point.hpp"

#include "geometry/critical/descent.hpp"
#include "geometry/primitives/elements.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/point_triangle_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::geometry::foot_point_test {
namespace {

using test::ExactFoot;
using test::kFamilies;
using test::kFamilyNames;
using test::PointTriangle;
using test::PointTriangleFamilies;

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A surface of one facet with nodes 0, 1, 2; its edges 0, 1, 2 are then 01, 02, 12.
Surface one_facet() {
  const std::array<Facet, 1> facets{Facet{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1}};
  return Surface({}, facets, 3);
}

/// Bit k: corner k carries the feature.
unsigned witness_features_of(Feature feature) {
  constexpr std::array<unsigned, 3> kEnds{0b011, 0b101, 0b110};
  if (feature.kind == FeatureKind::face) return 0b111;
  const auto id = static_cast<std::size_t>(feature.id);
  return feature.kind == FeatureKind::edge ? kEnds[id] : 1U << id;
}

/// Foot on the feature, with the weights of all three corners.
FootPoint foot_on(const Surface& surface, Feature feature, const PointTriangle& query) {
  if (feature.kind == FeatureKind::face) return foot_on_face(query.p, query.x);
  if (feature.kind == FeatureKind::node) {
    FootPoint foot = foot_on_node(query.p, query.x[static_cast<std::size_t>(feature.id)]);
    foot.weights = Vec3::Unit(feature.id);
    return foot;
  }
  const auto [a, b] = surface.nodes_of(EdgeId{feature.id});
  FootPoint foot = foot_on_edge(query.p, {query.x[index_of(a)], query.x[index_of(b)]});
  const Vec3 weights = foot.weights;
  foot.weights.setZero();
  foot.weights[static_cast<int>(a)] = weights[0];
  foot.weights[static_cast<int>(b)] = weights[1];
  return foot;
}

double longest_side(const std::array<Vec3, 3>& x) {
  return std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
}

/// Height over the longest side (m), of a triangle with an area; from the exact area.
double exact_height(const std::array<Vec3, 3>& x) {
  const auto s = test::scaled(x);
  const auto normal = test::cross(test::difference(s.points[1], s.points[0]),
                                  test::difference(s.points[2], s.points[0]));
  const long double doubled_area =
      std::ldexp(std::sqrt(test::dot(normal, normal).convert_to<long double>()), 2 * s.exponent);
  return static_cast<double>(doubled_area) / longest_side(x);
}

/// Distance (m) between the foot by the weights and the exact foot.
double position_error(const FootPoint& foot, const ExactFoot& exact, const std::array<Vec3, 3>& x) {
  using LongVec = Eigen::Matrix<long double, 3, 1>;
  LongVec error = LongVec::Zero();
  for (std::size_t k = 1; k < 3; ++k) {
    const long double excess = foot.weights[static_cast<int>(k)] - exact.weight(k);
    error += excess * (x[k] - x[0]).cast<long double>();
  }
  return static_cast<double>(error.norm());
}

/// What a query must fulfil beyond its region.
///
/// Coordinate differences carry half an ulp, so every length has an error of a few ulps of distance
/// + size: the relative error of the distance is below 1e-12 as soon as the distance is above 2e-3
/// of the size. In the face of a sliver the foot moves across the longest side by that error over
/// the height, but never by more than the height.
void expect_accurate(const FootPoint& foot, const ExactFoot& exact, Feature feature,
                     const PointTriangle& query) {
  const double distance = static_cast<double>(exact.distance());
  const double size = distance + longest_side(query.x);
  const double ulps = 4.0 * kEps * size;
  const double sliver = feature.kind == FeatureKind::face ? exact_height(query.x) : 0.0;

  EXPECT_NEAR(foot.distance, distance, ulps);
  if (distance > 2e-3 * size) {
    EXPECT_NEAR(foot.distance, distance, 1e-12 * distance);
  }
  EXPECT_LE(position_error(foot, exact, query.x),
            ulps + (sliver > 0.0 ? std::min(sliver, ulps * size / sliver) : 0.0));
  EXPECT_GE(foot.weights.minCoeff(), 0.0);
  EXPECT_LE(foot.weights.maxCoeff(), 1.0);
  EXPECT_NEAR(foot.weights.sum(), 1.0, kEps);
  EXPECT_NEAR(foot.direction.norm(), 1.0, 4.0 * kEps);
}

TEST(PointTriangle, OneMillionAdversarialRegionQueriesAgainstExactRationalsAre0WrongAnd0NaN) {
  constexpr int kQueriesPerFamily = 84000;  // 12 families
  const Surface surface = one_facet();
  PointTriangleFamilies families(1);
  for (std::size_t k = 0; k < kFamilies.size(); ++k) {
    SCOPED_TRACE(kFamilyNames[k]);
    int wrong = 0;
    int not_a_number = 0;

    for (int trial = 0; trial < kQueriesPerFamily && !::testing::Test::HasNonfatalFailure();
         ++trial) {
      const PointTriangle query = families.draw(kFamilies[k]);
      const ExactFoot exact = test::exact_foot(query.p, query.x);
      const Feature feature = closest_feature(surface, Feature(FaceId{0}), query.p, query.x);
      const FootPoint foot = foot_on(surface, feature, query);
      wrong += witness_features_of(feature) != exact.witness_features();
      not_a_number +=
          !(std::isfinite(foot.distance) && foot.direction.allFinite() && foot.weights.allFinite());
      expect_accurate(foot, exact, feature, query);
    }

    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(not_a_number, 0);
  }
}

// A triangle with an area far below the rounding error of its sides: its height computes as noise,
// or as zero.
TEST(FootOnFace, StaysAccurateOnTrianglesThinnerThanTheRoundingError) {
  test::Random random(2);
  int faces = 0;
  for (int trial = 0; trial < 20000 && !::testing::Test::HasNonfatalFailure(); ++trial) {
    const double height = std::pow(10.0, random.uniform(-19.0, -8.0));
    const Mat3 turn = random.coin() ? random.rotation() : Mat3(Mat3::Identity());
    const double along = random.unit();
    const Vec3 flat(random.unit(), 0.5 * height,
                    random.coin() ? random.signed_power(-18.0, 0.0) : 0.0);
    const PointTriangle query{turn * flat,
                              {Vec3(0, 0, 0), turn * Vec3(1, 0, 0), turn * Vec3(along, height, 0)}};
    const ExactFoot exact = test::exact_foot(query.p, query.x);
    if (exact.witness_features() != 0b111) continue;
    ++faces;

    const FootPoint foot = foot_on_face(query.p, query.x);

    SCOPED_TRACE(height);
    expect_accurate(foot, exact, Feature(FaceId{0}), query);
  }
  EXPECT_GT(faces, 5000);
}

TEST(FootOnNode, PointsUpAtDistanceZero) {
  const FootPoint foot = foot_on_node(Vec3(1, 2, 3), Vec3(1, 2, 3));

  EXPECT_EQ(foot.distance, 0.0);
  EXPECT_EQ(foot.direction, Vec3(0, 0, 1));
}

TEST(FootOnEdge, HasADirectionOfTheLineAloneAtDistanceZero) {
  const std::array<Vec3, 2> x{Vec3(0, 0, 0), Vec3(4, 2, 8)};

  const FootPoint first = foot_on_edge(Vec3(1, 0.5, 2), x);
  const FootPoint second = foot_on_edge(Vec3(3, 1.5, 6), x);

  EXPECT_EQ(first.distance, 0.0);
  EXPECT_EQ(first.direction, second.direction);
  EXPECT_NEAR(first.direction.dot(x[1] - x[0]), 0.0, 4.0 * kEps * x[1].norm());
  EXPECT_EQ(first.weights, Vec3(0.75, 0.25, 0.0));
  EXPECT_EQ(second.weights, Vec3(0.25, 0.75, 0.0));
}

TEST(FootOnFace, HasTheNormalAsDirectionAtDistanceZero) {
  const std::array<Vec3, 3> x{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};

  const FootPoint foot = foot_on_face(Vec3(1, 1, 1), x);

  EXPECT_EQ(foot.distance, 0.0);
  EXPECT_NEAR(std::abs(foot.direction[2]), 1.0, kEps);
  EXPECT_NEAR((foot.weights - Vec3(0.5, 0.25, 0.25)).norm(), 0.0, 4.0 * kEps);
}

TEST(FootOnFace, PointsFromThePointToTheFaceOnBothSides) {
  const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  for (const double height : {1e-12, 1e-3, 1.0, 1e3}) {
    EXPECT_NEAR((foot_on_face(Vec3(1, 1, height), x).direction - Vec3(0, 0, -1)).norm(), 0.0,
                4.0 * kEps);
    EXPECT_NEAR((foot_on_face(Vec3(1, 1, -height), x).direction - Vec3(0, 0, 1)).norm(), 0.0,
                4.0 * kEps);
  }
}

// The direction is what a force acts along, and the weights are where: both must describe one line.
TEST(FootPoint, LiesWhereDirectionAndDistanceLead) {
  const Surface surface = one_facet();
  PointTriangleFamilies families(3);
  for (std::size_t k = 0; k < kFamilies.size(); ++k) {
    SCOPED_TRACE(kFamilyNames[k]);
    for (int trial = 0; trial < 2000 && !::testing::Test::HasNonfatalFailure(); ++trial) {
      const PointTriangle query = families.draw(kFamilies[k]);
      const Feature feature = closest_feature(surface, Feature(FaceId{0}), query.p, query.x);
      const FootPoint foot = foot_on(surface, feature, query);

      Vec3 gap = foot.distance * foot.direction;  // to the foot by the weights, from differences
      for (int i = 0; i < 3; ++i)
        gap -= foot.weights[i] * (query.x[static_cast<std::size_t>(i)] - query.p);

      EXPECT_LE(gap.norm(), 16.0 * kEps * (foot.distance + longest_side(query.x)));
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::foot_point_test

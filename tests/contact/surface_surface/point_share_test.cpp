// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/point_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plekton::contact::structure::point_share_test {
namespace {

constexpr double kRange = 0.3;
constexpr double kTilted = 1.0 - kCosineOfCrossing * kCosineOfCrossing;
/// Ranges, at which facets count as crossing.
constexpr double kThrough = 1.0 + kDepthOfCrossing;

double share_at(double tilt, double ranges) {
  return point_share(tilt, ranges * kRange, kRange).share;
}

TEST(PointShare, IsOneOfFacetsThatCrossAndNothingOfFlatOnes) {
  EXPECT_EQ(share_at(kTilted, 1.0), 1.0);
  EXPECT_EQ(share_at(-1.0, 1.0), 1.0);  // where one has no area
  EXPECT_EQ(share_at(0.0, 0.5), 0.0);
  EXPECT_EQ(share_at(0.0, 1.0), 0.0);
}

/// Which features are nearest is another question there at every turn.
TEST(PointShare, IsOneOfFacetsThatAreThroughEachOther) {
  for (const double tilt : {0.0, 0.01, 0.3, 1.0}) {
    EXPECT_EQ(share_at(tilt, kThrough), 1.0) << tilt;
    EXPECT_NEAR(share_at(tilt, kThrough * (1.0 - 1e-9)), 1.0, 1e-15) << tilt;
    EXPECT_NEAR(share_at(tilt, 1.0 + 1e-9), share_at(tilt, 1.0), 1e-8) << tilt;
  }
}

TEST(PointShare, HasItsDerivatives) {
  constexpr double kStep = 1e-6;
  for (const double tilt : {0.001, 0.05, 0.18, 0.6}) {
    for (double ranges = 0.1; ranges < kThrough + 0.5; ranges += 0.0317) {
      const double u = ranges * kRange;
      const PointShare share = point_share(tilt, u, kRange);
      const double by_overlap = (point_share(tilt, u + kStep * kRange, kRange).share -
                                 point_share(tilt, u - kStep * kRange, kRange).share) /
                                (2.0 * kStep * kRange);
      const double by_tilt =
          (share_at(tilt * (1.0 + kStep), ranges) - share_at(tilt * (1.0 - kStep), ranges)) /
          (2.0 * kStep * tilt);
      // Central differences across a corner of the second derivative are off by their step.
      const double scale = 1.0 / ranges + 1.0;
      EXPECT_NEAR(share.by_distance, -by_overlap, 100.0 * kStep * scale / kRange) << ranges;
      EXPECT_NEAR(share.by_tilt, by_tilt, 100.0 * kStep * scale / tilt) << ranges;
    }
  }
}

/// A linear spring stores the square of the overlap.
TEST(PointShare, OfADeeperOverlapNeverStoresLess) {
  for (const double tilt : {0.0, 1e-6, 0.01, 0.1, 0.19, 0.5, 1.0}) {
    double last = 0.0;
    for (double ranges = 0.01; ranges < kThrough + 1.0; ranges += 0.01) {
      const double energy = ranges * ranges * share_at(tilt, ranges);
      EXPECT_GE(energy, last * (1.0 - 1e-15)) << tilt << ' ' << ranges;
      last = energy;
    }
  }
}

}  // namespace
}  // namespace plekton::contact::structure::point_share_test

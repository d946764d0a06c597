// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/structure/facing_facets.hpp"

#include "contact/laws/linear_frictional.hpp"
#include "contact/structure/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace plekton::contact::structure {
namespace {

constexpr double kRange = 0.3;
const LinearFrictional::Parameters kParameters{2e3, 1e3, 0.5};

NormalSpring spring() {
  return NormalSpring::of<LinearFrictional>(kParameters, kRange);
}

/// The part of the overlap that is in range.
Polygon in_range(const FacetOverlap& facets) {
  Polygon kept;
  const Polygon& region = facets.region;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Real here = Real(kRange) - facets.distance(region[i]);
    const Real there = Real(kRange) - facets.distance(region.next(i));
    if (here.value > 0.0) kept.add(region[i]);
    if ((here.value > 0.0) != (there.value > 0.0))
      kept.add(region[i] + (here / (here - there)) * (region.next(i) - region[i]));
  }
  return kept;
}

/// The plain twin: the same integral with numbers that carry their derivatives along.
PairForces forwards(const Simplex& a, const Simplex& b) {
  const FacetOverlap facets = face_to_face(corners(a, Side::a), corners(b, Side::b));
  const Polygon region = in_range(facets);
  Real sum(0.0);
  for (std::size_t i = 1; i + 1 < region.size(); ++i) {
    const Vector &p = region[0], &q = region[i], &r = region[i + 1];
    const Real area = 0.5 * facets.axis.dot((q - p).cross(r - p));
    const auto middle = [&](const Vector& u, const Vector& v) {
      return spring().energy(facets.distance(0.5 * (u + v)));
    };
    sum = sum + (1.0 / 3.0) * area * (middle(p, q) + middle(q, r) + middle(r, p));
  }
  return forces_of((1.0 / (kRange * kRange)) * parallel_share(facets.cosine) * sum);
}

/// Two triangles of size 1, one over the other at a distance of about the range, at angles up to
/// some 0.3.
class FacingFacets : public ::testing::TestWithParam<unsigned> {
 protected:
  Simplex triangle(double height, double slope) {
    const double tilt_x = slope * u_(random_), tilt_y = slope * u_(random_);
    Simplex found;
    found.count = 3;
    for (Vec3& x : found.x) {
      x = {u_(random_), u_(random_), 0.0};
      x[2] = height + tilt_x * x[0] + tilt_y * x[1];
    }
    return found;
  }

  std::mt19937 random_{GetParam()};
  std::uniform_real_distribution<double> u_{-1.0, 1.0};
};

TEST_P(FacingFacets, PushAsTheGradientFoundForwardsSays) {
  int pushing = 0;
  for (int i = 0; i < 2000; ++i) {
    const Simplex a = triangle(0.0, 0.15);
    const Simplex b =
        triangle(0.5 * kRange * (1.0 + u_(random_)) * (i % 2 == 0 ? 1.0 : -1.0), 0.15);

    const PairForces found = facing_facets(a, b, spring());
    const PairForces expected = forwards(a, b);

    // Narrow triangles and cuts that nearly graze a corner divide by small numbers: what both ways
    // round differently is larger by the inverse of the narrowest height.
    const auto height = [](const Simplex& t) {
      const double longest =
          std::max({(t.x[1] - t.x[0]).norm(), (t.x[2] - t.x[1]).norm(), (t.x[0] - t.x[2]).norm()});
      return area_normal_of(t).norm() / longest;
    };
    const double narrow = std::min(height(a), height(b));
    if (narrow < 1e-2) continue;
    double scale = 0.0;
    for (const Vec3& force : expected.on_a) scale = std::max(scale, force.norm());
    const double tolerance = 1e-10 * (scale + expected.energy) / (narrow * narrow);
    EXPECT_NEAR(found.energy, expected.energy, tolerance);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE((found.on_a[k] - expected.on_a[k]).norm(), tolerance) << i;
      EXPECT_LE((found.on_b[k] - expected.on_b[k]).norm(), tolerance) << i;
    }
    pushing += expected.energy > 0.0 ? 1 : 0;
  }
  EXPECT_GT(pushing, 500);
}

TEST_P(FacingFacets, KeepForceAndMoment) {
  for (int i = 0; i < 2000; ++i) {
    const Simplex a = triangle(0.0, 0.15);
    const Simplex b = triangle(0.4 * kRange, 0.15);
    const PairForces pair = facing_facets(a, b, spring());

    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double scale = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      force += pair.on_a[k] + pair.on_b[k];
      moment += a.x[k].cross(pair.on_a[k]) + b.x[k].cross(pair.on_b[k]);
      scale = std::max({scale, pair.on_a[k].norm(), pair.on_b[k].norm()});
    }
    EXPECT_LE(force.norm(), 1e-12 * scale);
    EXPECT_LE(moment.norm(), 1e-12 * scale);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FacingFacets, ::testing::Values(1U, 2U, 3U));

// A corner of one on a corner of the other, and sides at a small angle: where the sides cross moves
// fast along them, and that is no reason for a force.
TEST(FacingFacetsAlone, DoNotPushHardAcrossWhereCornersFallTogether) {
  Simplex a;
  a.count = 3;
  a.x = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0)};
  for (const double turn : {1e-10, 1e-8, 1e-6, 1e-4}) {
    Simplex b = a;
    for (Vec3& x : b.x)
      x = Vec3(std::cos(turn) * x[0] - std::sin(turn) * x[1],
               std::sin(turn) * x[0] + std::cos(turn) * x[1], 0.9 * kRange);

    const PairForces pair = facing_facets(a, b, spring());

    EXPECT_GT(pair.energy, 0.0);
    for (const Vec3& force : pair.on_b) EXPECT_LT(force.norm(), 10.0 * pair.energy / 0.1) << turn;
  }
}

TEST(FacingFacetsAlone, DoNothingWithoutArea) {
  Simplex needle;
  needle.count = 3;
  needle.x = {Vec3(0.0, 0.0, 0.1), Vec3(1.0, 0.0, 0.1), Vec3(0.5, 0.0, 0.1)};
  Simplex facet;
  facet.count = 3;
  facet.x = {Vec3(0.0, -1.0, 0.0), Vec3(1.0, -1.0, 0.0), Vec3(0.5, 1.0, 0.0)};

  EXPECT_EQ(facing_facets(needle, facet, spring()).energy, 0.0);
  EXPECT_EQ(facing_facets(facet, needle, spring()).energy, 0.0);
}

}  // namespace
}  // namespace plekton::contact::structure

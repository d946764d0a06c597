// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/facing_facets.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace plekton::contact::structure::facing_facets_test {
namespace {

constexpr double kRange = 0.3;
const LinearFrictional::Parameters kParameters{2e3, 1e3, 0.5};

NormalSpring spring() {
  return NormalSpring::of<LinearFrictional>(kParameters, kRange);
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

TEST_P(FacingFacets, PushAgainstTheGradientOfTheirEnergy) {
  int pushing = 0;
  for (int i = 0; i < 2000; ++i) {
    Simplex a = triangle(0.0, 0.15);
    Simplex b = triangle(0.5 * kRange * (1.0 + u_(random_)) * (i % 2 == 0 ? 1.0 : -1.0), 0.15);
    // Narrow triangles divide by small numbers.
    const auto height = [](const Simplex& t) {
      const double longest =
          std::max({(t.x[1] - t.x[0]).norm(), (t.x[2] - t.x[1]).norm(), (t.x[0] - t.x[2]).norm()});
      return area_normal_of(t).norm() / longest;
    };
    if (std::min(height(a), height(b)) < 0.1) continue;
    const PairForces found = facing_facets(a, b, spring());
    double scale = 0.0;
    for (const Vec3& force : found.on_a) scale = std::max(scale, force.norm());

    // Central differences: the error is the step times the change of the slope at the few places
    // where the overlap gains a corner, and its square elsewhere.
    constexpr double kStep = 1e-6;
    for (Simplex* moving : {&a, &b}) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          double& x = moving->x[k][axis];
          const double at = x;
          x = at + kStep;
          const double above = facing_facets(a, b, spring()).energy;
          x = at - kStep;
          const double below = facing_facets(a, b, spring()).energy;
          x = at;
          const Vec3& force = moving == &a ? found.on_a[k] : found.on_b[k];
          EXPECT_NEAR(force[axis], -(above - below) / (2.0 * kStep),
                      100.0 * kStep * (scale + found.energy / kRange))
              << i;
        }
      }
    }
    pushing += found.energy > 0.0 ? 1 : 0;
  }
  EXPECT_GT(pushing, 200);
}

/// Twice the energy of two facets by a sum over a grid: of the area of each over the other.
double twice_the_energy(const Simplex& a, const Simplex& b) {
  constexpr int kGrid = 100;
  const Vec3 normal_a = area_normal_of(a).normalized(), normal_b = area_normal_of(b).normalized();
  const double cosine = std::abs(normal_a.dot(normal_b));
  const double share = std::max(0.0, (cosine - kCosineOfCrossing) / (1.0 - kCosineOfCrossing));
  double sum = 0.0;
  for (const auto& [own, other, up] :
       {std::tuple(&a, &b, normal_b), std::tuple(&b, &a, normal_a)}) {
    const Vec3 u = own->x[1] - own->x[0], v = own->x[2] - own->x[0];
    const double cell = u.cross(v).norm() / (kGrid * kGrid);
    for (int i = 0; i < kGrid; ++i) {
      for (int k = 0; i + k < kGrid; ++k) {
        const double at_u = (i + 1.0 / 3.0) / kGrid, at_v = (k + 1.0 / 3.0) / kGrid;
        const Vec3 p = own->x[0] + at_u * u + at_v * v;
        bool is_over = true;
        for (std::size_t m = 0; m < 3; ++m) {
          const Vec3 inward = up.cross(other->x[(m + 1) % 3] - other->x[m]);
          const Vec3 to_third = other->x[(m + 2) % 3] - other->x[m];
          is_over = is_over && (p - other->x[m]).dot(inward) * to_third.dot(inward) > 0.0;
        }
        if (is_over) {
          const double half = i + k + 1 == kGrid ? 0.5 : 1.0;
          sum += half * cell * spring().energy(std::abs((p - other->x[0]).dot(up)));
        }
      }
    }
  }
  return share * share * sum / (kRange * kRange);
}

// The sum is rough where the outline of the overlap cuts cells of the grid.
TEST_P(FacingFacets, StoreWhatLiesOnBothSidesWhereTheyCross) {
  double largest = 0.0, error = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Simplex a = triangle(0.0, 0.15), b = triangle(0.0, 0.15);
    const double sum = 0.5 * twice_the_energy(a, b);
    largest = std::max(largest, sum);
    error = std::max(error, std::abs(facing_facets(a, b, spring()).energy - sum));
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(error, 0.1 * largest);
}

TEST_P(FacingFacets, KeepForceAndMoment) {
  for (int i = 0; i < 2000; ++i) {
    const Simplex a = triangle(0.0, 0.15);
    const Simplex b = triangle(i % 2 == 0 ? 0.4 * kRange : 0.0, 0.15);
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

INSTANTIATE_TEST_SUITE_P(Seeds, FacingFacets, ::testing::Values(1U, 2U, 3U),
                         ::testing::PrintToStringParamName());

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

// As a corner of the overlap leaves it, the fan of its triangles begins at another one: with three
// points a triangle, exact for a linear spring alone, the energy changed by 0.4 %.
TEST(FacingFacetsAlone, StoreTheSameUnderHertzHoweverTheirOverlapIsCutIntoTriangles) {
  constexpr double kNear = 0.02;  // m, range
  const HertzMindlin::Parameters parameters{1e6, 3e5, 0.01, 0.0};
  const NormalSpring spring = NormalSpring::of<HertzMindlin>(parameters, kNear);
  const auto energy = [&](double slope, double shift) {
    Simplex a, b;
    a.count = b.count = 3;
    a.x = {Vec3(0.0, 0.0, 0.01), Vec3(0.1, 0.0, 0.01 + 0.1 * slope), Vec3(0.0, 0.1, 0.01)};
    b.x = {Vec3(-1.0, shift - 0.05, 0.0), Vec3(1.0, shift + 0.05, 0.0),
           Vec3(-1.0, shift + 0.05, 0.0)};
    return facing_facets(a, b, spring).energy;
  };
  for (const double slope : {0.05, 0.1, 0.2}) {
    const double before = energy(slope, -1e-9);
    EXPECT_GT(before, 0.0);
    EXPECT_NEAR(energy(slope, 1e-9), before, 1e-4 * before) << slope;
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
}  // namespace plekton::contact::structure::facing_facets_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/sphere_union.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::dynamics::sphere_union_test {
namespace {

constexpr double kPi = std::numbers::pi;
/// Rounding of some 500 slices, relative.
constexpr double kRounding = 1e-12;

TEST(SphereUnion, OfOneSphereIsTheSphere) {
  const std::vector<Vec3> centres{Vec3(1.0, 2.0, 3.0)};
  const std::vector<double> radii{0.5};

  const auto [moments, error] = sphere_union(centres, radii, Vec3(1.0, 2.0, 3.0));

  const double volume = 4.0 / 3.0 * kPi * 0.125;
  EXPECT_NEAR(moments.volume, volume, kRounding * volume);
  EXPECT_LT(moments.first.norm(), kRounding * volume);
  EXPECT_LT((moments.second - volume * 0.25 / 5.0 * Mat3::Identity()).norm(), kRounding * volume);
  EXPECT_LT(error, kRounding);
}

// Two spheres of radius r, their centres d apart, have the lens pi / 12 (4 r + d) (2 r - d)² in
// common. About the axis through them the union of such spheres is a solid of revolution: its moment
// is pi / 2 times the integral of rho⁴ along it.
TEST(SphereUnion, OfTwoSpheresHasTheirLensOnce) {
  const double r = 1.0, d = 1.2;
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.6, 0.48, 0.64)}) {
    const std::vector<Vec3> centres{-0.5 * d * direction, 0.5 * d * direction};
    const std::vector<double> radii{r, r};

    const auto [moments, error] = sphere_union(centres, radii, Vec3::Zero());

    const double lens = kPi / 12.0 * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d);
    const double volume = 8.0 / 3.0 * kPi * r * r * r - lens;
    EXPECT_NEAR(moments.volume, volume, kRounding * volume);
    EXPECT_LT(moments.first.norm(), kRounding * volume);
    // Twice the integral of (r² - s²)² from -d / 2 to r.
    const auto primitive = [&](double s) {
      return r * r * r * r * s - 2.0 / 3.0 * r * r * s * s * s + s * s * s * s * s / 5.0;
    };
    const double about_axis = kPi * (primitive(r) - primitive(-0.5 * d));
    const double across = moments.second.trace() - direction.dot(moments.second * direction);
    EXPECT_NEAR(across, about_axis, kRounding * volume);
    EXPECT_LT(error, kRounding);
  }
}

// Inclusion and exclusion with a fourth sphere that swallows all: the union is that sphere.
TEST(SphereUnion, OfSpheresWithinOneIsThatOne) {
  const std::vector<Vec3> centres{Vec3(0.2, 0, 0), Vec3(-0.1, 0.2, 0), Vec3(0, 0, 0),
                                  Vec3(0, 0.1, 0.3), Vec3(0, 0, 0)};
  const std::vector<double> radii{0.3, 0.4, 1.0, 0.2, 1.0};

  const auto [moments, error] = sphere_union(centres, radii, Vec3::Zero());

  const double volume = 4.0 / 3.0 * kPi;
  EXPECT_NEAR(moments.volume, volume, kRounding * volume);
  EXPECT_LT(moments.first.norm(), kRounding);
}

// Where three spheres have points in common: turned as a whole the body keeps its volume and its
// principal moments, while every slice is another one.
TEST(SphereUnion, OfThreeThatOverlapDoesNotDependOnHowItIsTurned) {
  const std::vector<Vec3> centres{Vec3(0, 0, 0), Vec3(0.7, 0, 0), Vec3(0.3, 0.6, 0.1)};
  const std::vector<double> radii{0.6, 0.5, 0.55};
  const auto straight = sphere_union(centres, radii, Vec3::Zero());
  const Quat turn = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  std::vector<Vec3> turned_centres;
  for (const Vec3& centre : centres) turned_centres.push_back(turn * centre);

  const auto turned = sphere_union(turned_centres, radii, Vec3::Zero());

  const double volume = straight.moments.volume;
  EXPECT_NEAR(turned.moments.volume, volume, kRounding * volume);
  EXPECT_LT((turned.moments.first - turn * straight.moments.first).norm(), kRounding * volume);
  const Mat3 axes = turn.toRotationMatrix();
  EXPECT_LT((turned.moments.second - axes * straight.moments.second * axes.transpose()).norm(),
            kRounding * volume);
  EXPECT_LT(std::max(straight.error, turned.error), kRounding);
}

}  // namespace
}  // namespace plekton::dynamics::sphere_union_test

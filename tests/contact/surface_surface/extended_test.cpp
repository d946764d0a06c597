// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/extended.hpp"

#include "contact/law/linear_frictional.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plekton::contact::structure::extended_test {
namespace {

using test::Random;

constexpr double kRange = 0.3;      // m
constexpr double kStiffness = 2e3;  // N/m
const LinearFrictional::Parameters kParameters{kStiffness, 1e3, 0.5};

NormalSpring spring() {
  return NormalSpring::of<LinearFrictional>(kParameters, kRange);
}

/// J, of one contact.
double energy_at(double distance) {
  return 0.5 * kStiffness * std::pow(std::max(0.0, kRange - distance), 2);
}

Simplex node(const Vec3& x) {
  return {{x, Vec3::Zero(), Vec3::Zero()}, 1, {}};
}
Simplex cylinder(const Vec3& first, const Vec3& last) {
  return {{first, last, Vec3::Zero()}, 2, {}};
}
Simplex seam(const Vec3& first, const Vec3& last) {
  return {{first, last, Vec3::Zero()}, 2, {true, false, false}};
}
Simplex facet(const Vec3& x, const Vec3& y, const Vec3& z) {
  return {{x, y, z}, 3, {}};
}

double energy_of(const Simplex& a, const Simplex& b) {
  const double energy = extended_part(a, b, spring()).energy;
  // From either side, but for the order of roundings.
  EXPECT_NEAR(extended_part(b, a, spring()).energy, energy, 1e-12 * energy_at(0.0) / kRange);
  return energy;
}

/// The factor for lines at an angle: 1, and 0 from a cosine of 0.9 on.
double share(double cosine) {
  return std::pow(std::max(0.0, (cosine - 0.9) / 0.1), 2);
}

const Simplex kFacet = facet({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

TEST(CanExtend, TakesFacetsAndFreeCylindersAndNothingElse) {
  const Simplex point = node({0, 0, 1});
  const Simplex bar = cylinder({0, 0, 1}, {1, 0, 1}), side = seam({0, 0, 1}, {1, 0, 1});

  for (const Simplex& other : {point, bar, side, kFacet}) {
    EXPECT_FALSE(can_extend(point, other));
    EXPECT_FALSE(can_extend(other, point));
  }
  for (const Simplex& other : {bar, side, kFacet}) {
    EXPECT_TRUE(can_extend(bar, other));
    EXPECT_TRUE(can_extend(other, bar));
  }
  EXPECT_TRUE(can_extend(kFacet, kFacet));
  EXPECT_FALSE(can_extend(side, side));
  EXPECT_FALSE(can_extend(side, kFacet));
  EXPECT_FALSE(can_extend(kFacet, side));
}

TEST(ExtendedPart, OfParallelCylindersCountsRangesOfTheLengthSideBySide) {
  const Simplex a = cylinder({0, 0, 0}, {4, 0, 0});
  const double d = std::hypot(0.1, 0.2);
  const auto beside = [&](double from, double to) {
    return cylinder({from, 0.1, 0.2}, {to, 0.1, 0.2});
  };

  const double contact = energy_at(d) / kRange;
  EXPECT_NEAR(energy_of(a, beside(1, 3)), 2.0 * contact, 1e-14);
  EXPECT_NEAR(energy_of(a, beside(3, 1)), 2.0 * contact, 1e-14) << "the other way round";
  EXPECT_NEAR(energy_of(a, beside(3, 9)), 1.0 * contact, 1e-14);
  EXPECT_NEAR(energy_of(a, beside(-9, 9)), 4.0 * contact, 1e-13);
  EXPECT_EQ(energy_of(a, beside(5, 9)), 0.0) << "one behind the other";
  EXPECT_EQ(energy_of(a, cylinder({0, 0, 0.3}, {4, 0, 0.3})), 0.0) << "out of range";
}

TEST(ExtendedPart, OfALevelCylinderCountsItsLengthOverAFacetOrBesideIt) {
  // Along y = 1 m over 3 m of the facet; along its side y = 0, beyond it, by the distance to that.
  const double contact = energy_at(0.2) / kRange;
  EXPECT_NEAR(energy_of(cylinder({-1, 1, 0.2}, {7, 1, 0.2}), kFacet), 3.0 * contact, 1e-13);
  EXPECT_NEAR(energy_of(cylinder({-1, 1, -0.2}, {7, 1, -0.2}), kFacet), 3.0 * contact, 1e-13);
  EXPECT_NEAR(energy_of(cylinder({1, 1, 0.2}, {1.5, 1, 0.2}), kFacet), 0.5 * contact, 1e-14);
  EXPECT_NEAR(energy_of(cylinder({1, -0.1, 0.2}, {3, -0.1, 0.2}), kFacet),
              2.0 * energy_at(std::hypot(0.1, 0.2)) / kRange, 1e-13);
  EXPECT_EQ(energy_of(cylinder({1, -0.4, 0}, {3, -0.4, 0}), kFacet), 0.0);
}

TEST(ExtendedPart, OfASlopingCylinderIsTheIntegralOfWhatIsInRange) {
  for (const double slope : {0.02, 0.1, 0.3}) {
    // Over all of y = 1 m from x = 0.5 on, where it is 0.1 m high, to x = 2.5 m.
    const Vec3 first(0.5, 1, 0.1), last(2.5, 1, 0.1 + 2.0 * slope);
    const double length = (last - first).norm();
    const double sine = 2.0 * slope / length;

    const double energy = energy_of(cylinder(first, last), kFacet);

    // The integral of k (R - h)^2 / 2 over the length is k (R - h)^3 / (6 sine) from end to end.
    const double low = kRange - 0.1, high = std::max(0.0, kRange - last[2]);
    const double integral =
        kStiffness / (6.0 * sine) * (std::pow(low, 3) - std::pow(high, 3)) / kRange;
    // The cosine to second order of the sine.
    const double expected = share(1.0 - 0.5 * sine * sine) * integral;
    EXPECT_NEAR(energy, expected, 1e-12 * integral) << slope;
    EXPECT_GT(expected, 0.0);
  }
}

TEST(ExtendedPart, FallsToNothingWhereCylindersCross) {
  const Simplex a = cylinder({-1, 0, 0}, {1, 0, 0});
  const auto turned = [](double degrees) {
    const double angle = degrees / 180.0 * std::acos(-1.0);
    const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
    return cylinder(Vec3(0, 0, 0.2) - along, Vec3(0, 0, 0.2) + along);
  };
  double last = energy_of(a, turned(0.0));
  for (const double degrees : {5.0, 10.0, 15.0, 20.0, 25.0}) {
    const double energy = energy_of(a, turned(degrees));
    EXPECT_LT(energy, last) << degrees;
    EXPECT_GT(energy, 0.0) << degrees;
    last = energy;
  }
  for (const double degrees : {26.0, 45.0, 90.0, 150.0})
    EXPECT_EQ(energy_of(a, turned(degrees)), 0.0);
}

TEST(ExtendedPart, OfPiecesAddsUpToThatOfTheWhole) {
  Random random(1);
  int pushing = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // One after the other: compilers take arguments in different orders.
    const double y = random.uniform(0.2, 1.0), x = random.uniform(-1.0, 1.0);
    const double rise = 0.2 * random.uniform(-1.0, 1.0), aside = 0.1 * random.uniform(-1.0, 1.0);
    const Vec3 first(x, y, 0.2), last = first + Vec3(3.0, aside, rise);
    const Vec3 third = first + (last - first) / 3.0, middle = first + 0.5 * (last - first);
    const Simplex bar = cylinder(Vec3(0, 0.6, 0.05), Vec3(4, 0.5, 0.0));
    for (const Simplex& other : {kFacet, bar}) {
      const double whole = energy_of(cylinder(first, last), other);

      const double pieces = energy_of(cylinder(first, third), other) +
                            energy_of(cylinder(third, middle), other) +
                            energy_of(cylinder(middle, last), other);

      // Over a facet Simpson's rule is exact; between cylinders five points are off by some 1e-5
      // where the distance turns round within a piece.
      const double error = other.count == 3 ? 1e-12 : 1e-4;
      EXPECT_NEAR(pieces, whole, error * energy_at(0.0) / kRange) << trial;
      pushing += whole > 0.0;
    }
  }
  EXPECT_GT(pushing, 200);
}

TEST(ExtendedPart, OfANeedleIsThatOfItsLongestSideAndOfNothingWithFacets) {
  const Simplex needle = facet({1, 0, 0}, {3, 0, 0}, {0, 0, 0});
  const Simplex bar = cylinder({-1, 0.1, 0.1}, {2, 0.2, 0.1});

  EXPECT_GT(energy_of(bar, needle), 0.0);
  EXPECT_NEAR(energy_of(bar, needle), energy_of(bar, seam({0, 0, 0}, {3, 0, 0})), 1e-12);
  EXPECT_EQ(energy_of(needle, facet({0, -1, 0.1}, {3, -1, 0.1}, {1, 2, 0.1})), 0.0);
}

/// A cylinder at small angles to the x axis, some of its length near it.
Simplex random_cylinder(Random& random) {
  const Vec3 middle(random.uniform(0.5, 1.5), random.uniform(-0.2, 1.0), random.uniform(0.02, 0.2));
  const Vec3 half(random.uniform(0.3, 1.5), random.uniform(-0.2, 0.2), random.uniform(-0.1, 0.1));
  return cylinder(middle - half, middle + half);
}

TEST(ExtendedPart, PushesAgainstTheGradientAndKeepsForceAndMoment) {
  constexpr double kStep = 1e-6;
  Random random(2);
  int pushing = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::array<Simplex, 3> others{kFacet, cylinder({0, 0, 0}, {2, 0, 0}),
                                        seam({0, 0, 0}, {2, 0, 0})};
    Simplex a = random_cylinder(random), b = others[static_cast<std::size_t>(trial % 3)];
    if (trial % 2 == 1) std::swap(a, b);
    const PairForces pair = extended_part(a, b, spring());
    if (pair.energy == 0.0) continue;
    ++pushing;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      force += pair.on_a[k] + pair.on_b[k];
      moment += a.x[k].cross(pair.on_a[k]) + b.x[k].cross(pair.on_b[k]);
    }
    const double scale = energy_at(0.0) / kRange;  // N, of a range of length
    EXPECT_LE(force.norm(), 1e-10 * scale);
    EXPECT_LE(moment.norm(), 1e-10 * scale);
    for (Simplex* moving : {&a, &b}) {
      for (std::size_t k = 0; k < moving->count; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          double& x = moving->x[k][axis];
          const double at = x;
          x = at + kStep;
          const double above = extended_part(a, b, spring()).energy;
          x = at - kStep;
          const double below = extended_part(a, b, spring()).energy;
          x = at;
          const Vec3& on = moving == &a ? pair.on_a[k] : pair.on_b[k];
          // By the step times the change of the slope where a part begins to end elsewhere.
          EXPECT_NEAR(on[axis], -(above - below) / (2.0 * kStep), 1e3 * kStep * scale) << trial;
        }
      }
    }
  }
  EXPECT_GT(pushing, 100);
}

}  // namespace
}  // namespace plekton::contact::structure::extended_test

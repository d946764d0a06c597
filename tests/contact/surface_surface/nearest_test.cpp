// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/nearest.hpp"

#include "contact/law/linear_frictional.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace plekton::contact::structure::nearest_test {
namespace {

using test::Random;

constexpr double kRange = 0.3;      // m
constexpr double kStiffness = 2e3;  // N/m
const LinearFrictional::Parameters kParameters{kStiffness, 1e3, 0.5};

NormalSpring spring() {
  return NormalSpring::of<LinearFrictional>(kParameters, kRange);
}

Simplex node(const Vec3& x) {
  return {{x, Vec3::Zero(), Vec3::Zero()}, 1, {}};
}
Simplex cylinder(const Vec3& first, const Vec3& last) {
  return {{first, last, Vec3::Zero()}, 2, {}};
}
Simplex facet(const Vec3& x, const Vec3& y, const Vec3& z) {
  return {{x, y, z}, 3, {}};
}

CoreProximity proximity(const Simplex& a, const Simplex& b) {
  return geometry::core_proximity({a.x, a.count}, {b.x, b.count});
}
PairForces nearest_part(const Simplex& a, const Simplex& b) {
  return nearest_part(a, b, proximity(a, b), true, spring());
}

bool are_equal(const PairForces& p, const PairForces& q) {
  return p.energy == q.energy && p.on_a == q.on_a && p.on_b == q.on_b;
}

/// J, of one contact; N, of it.
double energy_at(double distance) {
  return 0.5 * kStiffness * std::pow(kRange - distance, 2);
}
double force_at(double distance) {
  return kStiffness * (kRange - distance);
}

const Simplex kFacet = facet({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

TEST(AtNearestPoints, PushesThereWithTheForceOfOneContact) {
  const Simplex a = node({1, 2, 0.1});

  const PairForces pair = at_nearest_points(proximity(a, kFacet), spring());

  EXPECT_DOUBLE_EQ(pair.energy, energy_at(0.1));
  const double force = force_at(0.1);
  EXPECT_NEAR((pair.on_a[0] - Vec3(0, 0, force)).norm(), 0.0, 1e-12 * force);
  // Weights of (1, 2) in the facet: 1/4, 1/4 and 1/2.
  for (const auto& [k, weight] : {std::pair(0, 0.25), std::pair(1, 0.25), std::pair(2, 0.5)})
    EXPECT_NEAR((pair.on_b[static_cast<std::size_t>(k)] + Vec3(0, 0, weight * force)).norm(), 0.0,
                1e-12 * force);
}

TEST(PushingApart, IsAForceAlongTheNormalWithoutEnergy) {
  const Simplex a = cylinder({0, 0, 0}, {2, 0, 0}), b = cylinder({0.5, -1, 0.2}, {0.5, 1, 0.2});

  const PairForces pair = pushing_apart(proximity(a, b), 8.0);

  EXPECT_EQ(pair.energy, 0.0);
  const std::array<double, 2> shares_a{0.75, 0.25}, shares_b{0.5, 0.5};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR((pair.on_a[k] - Vec3(0, 0, -8.0 * shares_a[k])).norm(), 0.0, 1e-13);
    EXPECT_NEAR((pair.on_b[k] - Vec3(0, 0, 8.0 * shares_b[k])).norm(), 0.0, 1e-13);
  }
}

TEST(NearestPart, IsThatOfTheNearestPointsWhereNothingLiesAlong) {
  const Simplex bar = cylinder({0, 1, 0.2}, {3, 1, 0.2});
  for (const auto& [a, b] :
       {std::pair(node({1, 1, 0.1}), kFacet), std::pair(node({1, 1, 0.1}), bar),
        std::pair(cylinder({1, 0, 0}, {1, 2, 0.1}), bar),
        std::pair(facet({1, 1, 0.1}, {3, 1, 0.3}, {1, 3, 0.3}), kFacet),
        std::pair(cylinder({1, 1, 0.1}, {2, 1, 0.101}), kFacet)}) {
    EXPECT_TRUE(are_equal(nearest_part(a, b), at_nearest_points(proximity(a, b), spring())));
    EXPECT_TRUE(are_equal(nearest_part(b, a), at_nearest_points(proximity(b, a), spring())));
  }
}

TEST(NearestPart, OfALevelCylinderPushesEvenlyAtBothEndsOfItsPartOverAFacet) {
  // From its own end at x = 1 m; to the side x + y = 4 m, at x = 3 m of 1 to 9 m.
  const double force = force_at(0.2);

  const PairForces within = nearest_part(cylinder({1, 1, 0.2}, {2, 1, 0.2}), kFacet);
  const PairForces across = nearest_part(cylinder({1, 1, 0.2}, {9, 1, 0.2}), kFacet);

  EXPECT_NEAR(within.energy, energy_at(0.2), 1e-12);
  EXPECT_NEAR(across.energy, energy_at(0.2), 1e-12);
  EXPECT_NEAR((within.on_a[0] - Vec3(0, 0, 0.5 * force)).norm(), 0.0, 1e-12 * force);
  EXPECT_NEAR((within.on_a[1] - Vec3(0, 0, 0.5 * force)).norm(), 0.0, 1e-12 * force);
  EXPECT_NEAR((across.on_a[0] - Vec3(0, 0, 0.875 * force)).norm(), 0.0, 1e-12 * force);
  EXPECT_NEAR((across.on_a[1] - Vec3(0, 0, 0.125 * force)).norm(), 0.0, 1e-12 * force);
}

TEST(NearestPart, SharesBetweenTheEndsByTheTiltsThatLetEachBeTheNearest) {
  for (const double x : {-0.9, -0.3, 0.0, 0.5, 0.99}) {
    const double slope = x * kLargestTilt;  // and so the sine, but for its third power
    const double low = 0.2, high = 0.2 + slope;

    const double energy = nearest_part(cylinder({1, 1, low}, {2, 1, high}), kFacet).energy;

    // Of a disc of tilts the part on one side of a chord at x.
    const double rising = 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
    EXPECT_NEAR(energy, rising * energy_at(low) + (1.0 - rising) * energy_at(high),
                1e-6 * std::abs(energy_at(low) - energy_at(high)) + 1e-12)
        << x;
  }
}

TEST(NearestPart, OfParallelCylindersPushesEvenlyAtBothEndsOfThePartSideBySide) {
  const double force = force_at(0.2);
  const Simplex a = cylinder({0, 0, 0}, {4, 0, 0});

  for (const auto& [from, to] : {std::pair(1.0, 3.0), std::pair(2.0, 6.0), std::pair(6.0, 2.0)}) {
    const PairForces pair = nearest_part(a, cylinder({from, 0, 0.2}, {to, 0, 0.2}));

    EXPECT_NEAR(pair.energy, energy_at(0.2), 1e-12);
    const double middle = 0.5 * (std::min(from, to) + std::min(std::max(from, to), 4.0));
    const double on_a = middle / 4.0, on_b = (middle - from) / (to - from);
    EXPECT_NEAR((pair.on_a[0] - Vec3(0, 0, -(1.0 - on_a) * force)).norm(), 0.0, 1e-10 * force);
    EXPECT_NEAR((pair.on_a[1] - Vec3(0, 0, -on_a * force)).norm(), 0.0, 1e-10 * force);
    EXPECT_NEAR((pair.on_b[0] - Vec3(0, 0, (1.0 - on_b) * force)).norm(), 0.0, 1e-10 * force);
    EXPECT_NEAR((pair.on_b[1] - Vec3(0, 0, on_b * force)).norm(), 0.0, 1e-10 * force);
  }
}

/// A cylinder over the facet or beside another one, at angles up to some times the largest tilt,
/// and what it meets.
std::pair<Simplex, Simplex> nearly_parallel(Random& random, double tilts) {
  const double tilt = tilts * kLargestTilt;
  const Vec3 first(random.uniform(-0.5, 1.0), random.uniform(0.5, 1.0), random.uniform(0.1, 0.2));
  const double length = random.uniform(1.0, 4.0);
  const Vec3 way(length, length * tilt * random.uniform(-1.0, 1.0),
                 length * tilt * random.uniform(-1.0, 1.0));
  const bool is_on_facet = random.coin();
  const Vec3 shift = is_on_facet ? Vec3(0, 0, 0) : Vec3(0, -first[1] + 0.05, 0);
  const Simplex bar = cylinder(first + shift, first + shift + way);
  return {bar, is_on_facet ? kFacet : cylinder({0, 0, 0}, {2, 0, 0})};
}

TEST(NearestPart, PushesAgainstTheGradientAndKeepsForceAndMoment) {
  // Shares change over tilts of 3e-4: third derivatives of the energy are the force over 1e-7 m^2,
  // and more towards the largest tilt.
  constexpr double kStep = 1e-7;
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    auto [a, b] = nearly_parallel(random, 0.6);
    if (trial % 2 == 1) std::swap(a, b);
    const PairForces pair = nearest_part(a, b);
    const double scale = force_at(0.1);
    ASSERT_GT(pair.energy, 0.0);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      force += pair.on_a[k] + pair.on_b[k];
      moment += a.x[k].cross(pair.on_a[k]) + b.x[k].cross(pair.on_b[k]);
    }
    EXPECT_LE(force.norm(), 1e-9 * scale) << trial;
    EXPECT_LE(moment.norm(), 1e-9 * scale) << trial;
    for (Simplex* moving : {&a, &b}) {
      for (std::size_t k = 0; k < moving->count; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          double& x = moving->x[k][axis];
          const double at = x;
          x = at + kStep;
          const double above = nearest_part(a, b).energy;
          x = at - kStep;
          const double below = nearest_part(a, b).energy;
          x = at;
          const Vec3& on = moving == &a ? pair.on_a[k] : pair.on_b[k];
          EXPECT_NEAR(on[axis], -(above - below) / (2.0 * kStep), 1e-5 * scale) << trial;
        }
      }
    }
  }
}

TEST(MayBeFlat, IsTrueOfALevelCylinderOverAFacetAlone) {
  const auto answer = [](const Simplex& a, const Simplex& b) {
    const bool found = may_be_flat(a, b, proximity(a, b));
    EXPECT_EQ(may_be_flat(b, a, proximity(b, a)), found) << "from the other side";
    return found;
  };
  const Simplex level = cylinder({1, 1, 0.2}, {2, 1, 0.2});
  Simplex side = level;
  side.is_seam[0] = true;

  EXPECT_TRUE(answer(level, kFacet));
  EXPECT_TRUE(answer(cylinder({1, 1, 0.2}, {2, 1, 0.2 + 0.99 * kLargestTilt}), kFacet));
  EXPECT_FALSE(answer(cylinder({1, 1, 0.2}, {2, 1, 0.2 + 1.01 * kLargestTilt}), kFacet));
  EXPECT_FALSE(answer(side, kFacet)) << "facets lie on it";
  EXPECT_FALSE(answer(level, cylinder({1, 1, 0}, {2, 1, 0})));
  EXPECT_FALSE(answer(level, facet({0, 0, 0}, {4, 0, 0}, {2, 0, 0}))) << "it has no normal";
  EXPECT_FALSE(answer(facet({1, 1, 0.2}, {2, 1, 0.2}, {1, 2, 0.2}), kFacet));
}

TEST(MayBeFlat, SparesNothingWhereItSaysNo) {
  Random random(2);
  std::array<int, 2> answers{};
  for (int trial = 0; trial < 500; ++trial) {
    const auto [a, b] = nearly_parallel(random, random.coin() ? 2.0 : 100.0);
    const CoreProximity nearest = proximity(a, b);
    if (nearest.signed_distance >= kRange) continue;
    const bool may = may_be_flat(a, b, nearest);
    ++answers[may ? 1 : 0];
    EXPECT_TRUE(are_equal(nearest_part(a, b, nearest, may, spring()),
                          nearest_part(a, b, nearest, true, spring())))
        << trial;
  }
  EXPECT_GT(answers[0], 50);
  EXPECT_GT(answers[1], 50);
}

}  // namespace
}  // namespace plekton::contact::structure::nearest_test

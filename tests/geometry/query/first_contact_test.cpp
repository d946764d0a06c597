// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/first_contact.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace plekton::geometry::first_contact_test {
namespace {

Probe random_probe(test::Random& random, const Vec3& at) {
  const double radius = random.coin() ? 0.0 : 0.3 * random.unit();
  switch (random.integer(0, 2)) {
    case 0:
      return Probe::ball(at, radius);
    case 1:
      return Probe::cylinder(at, at + random.in_cube(1.0), radius);
    default:
      return Probe::facet({at, at + random.in_cube(1.0), at + random.in_cube(1.0)}, radius);
  }
}

/// Moves, turns and stretches.
MovingProbe random_motion(test::Random& random, const Vec3& from, const Vec3& to) {
  const Probe probe = random_probe(random, from);
  MovingProbe moving = MovingProbe::translated(probe, to - from);
  if (random.coin()) {
    for (std::size_t k = 0; k < probe.core.count; ++k) moving.to.x[k] += random.in_cube(0.5);
  }
  return moving;
}

Probe at(const MovingProbe& moving, double t) {
  Probe probe{moving.from, moving.radius};
  for (std::size_t k = 0; k < moving.from.count; ++k)
    probe.core.x[k] = (1.0 - t) * moving.from.x[k] + t * moving.to.x[k];
  return probe;
}

double gap_at(const MovingProbe& a, const MovingProbe& b, double t) {
  return proximity(at(a, t), at(b, t)).gap;
}

TEST(FirstContact, OfTwoBallsIsWhereTheQuadraticIsZero) {
  // |(-3 + 4 t, 0.3, 0)| = 0.5
  const auto a = MovingProbe::translated(Probe::ball(Vec3(0, 0, 0), 0.2), Vec3(4, 0, 0));
  const auto b = MovingProbe::resting(Probe::ball(Vec3(3, 0.3, 0), 0.3));
  const double expected = (3.0 - std::sqrt(0.5 * 0.5 - 0.3 * 0.3)) / 4.0;

  const auto found = first_contact(a, b, {1e-12});

  ASSERT_TRUE(found.has_value());
  EXPECT_LE(found->t, expected);
  // The gap closes at 4 m / 1 times the cosine 0.8 of the way with the normal.
  EXPECT_NEAR(found->t, expected, 2e-12 / (4.0 * 0.8));
  EXPECT_LE(found->proximity.gap, 1e-12);
}

TEST(FirstContact, IsNoneOfBallsThatPassEachOther) {
  const auto a = MovingProbe::translated(Probe::ball(Vec3(0, 0, 0), 0.2), Vec3(4, 0, 0));
  EXPECT_FALSE(first_contact(a, MovingProbe::resting(Probe::ball(Vec3(2, 0.5 + 1e-9, 0), 0.3))));
  EXPECT_FALSE(first_contact(a, MovingProbe::resting(Probe::ball(Vec3(5, 0, 0), 0.3))));
  EXPECT_FALSE(first_contact(a, MovingProbe::resting(Probe::ball(Vec3(-1, 0, 0), 0.3))));
  EXPECT_TRUE(first_contact(a, MovingProbe::resting(Probe::ball(Vec3(2, 0.5 - 1e-9, 0), 0.3))));
}

TEST(FirstContact, IsNotPassedThroughByWhatHasNoThickness) {
  const auto wall =
      MovingProbe::resting(Probe::facet({Vec3(0, -9, -9), Vec3(0, 9, -9), Vec3(0, 0, 9)}, 0.0));
  for (const double speed : {1.0, 1e3, 1e9}) {
    const auto point =
        MovingProbe::translated(Probe::point(Vec3(-0.25 * speed, 0.1, 0.2)), Vec3(speed, 0.3, 0.1));
    const auto found = first_contact(point, wall);
    ASSERT_TRUE(found.has_value()) << speed;
    EXPECT_LE(found->t, 0.25);
    EXPECT_NEAR(found->t, 0.25, 1e-12) << speed;
  }
}

TEST(FirstContact, IsAtTheStartOfWhatOverlapsThen) {
  const auto a = MovingProbe::resting(Probe::ball(Vec3::Zero(), 1.0));
  const auto b = MovingProbe::translated(Probe::ball(Vec3(1.5, 0, 0), 1.0), Vec3(9, 0, 0));
  EXPECT_EQ(first_contact(a, b)->t, 0.0);
  EXPECT_EQ(first_contact(a, a)->t, 0.0);
}

/// Samples of the motion are the reference: nothing before t overlaps, and what overlaps is found.
TEST(FirstContact, IsNeverLaterThanAnOverlapOnTheWay) {
  test::Random random(3);
  int hits = 0, misses = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double size = trial % 3 == 0 ? 1.0 : trial % 3 == 1 ? 1e-6 : 1e6;
    auto a = random_motion(random, random.in_cube(1.0), random.in_cube(1.0));
    auto b = random_motion(random, random.in_cube(1.0), random.in_cube(1.0));
    for (MovingProbe* probe : {&a, &b}) {
      probe->radius *= size;
      for (Core* core : {&probe->from, &probe->to}) {
        for (Vec3& corner : core->x) corner *= size;
      }
    }
    const double tolerance = 1e-9 * size;
    const auto found = first_contact(a, b, {tolerance});

    double overlap = 2.0;
    constexpr int kSamples = 200;
    for (int k = 0; k <= kSamples && overlap > 1.0; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      if (gap_at(a, b, t) <= 0.0) overlap = t;
    }
    if (overlap <= 1.0) {
      ASSERT_TRUE(found.has_value()) << trial;
      ASSERT_LE(found->t, overlap) << trial;
    }
    (found ? hits : misses)++;
    if (!found) continue;
    EXPECT_LE(found->proximity.gap, tolerance) << trial;
    // 4 ulps of coordinates of at most 4 sizes.
    EXPECT_NEAR(gap_at(a, b, found->t), found->proximity.gap, 1e-14 * size) << trial;
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(FirstContact, IsTheSameForBothOrders) {
  test::Random random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const auto a = random_motion(random, random.in_cube(1.0), random.in_cube(1.0));
    const auto b = random_motion(random, random.in_cube(1.0), random.in_cube(1.0));
    const auto one = first_contact(a, b, {1e-9}), other = first_contact(b, a, {1e-9});
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    EXPECT_LE(gap_at(a, b, other->t), 1e-9 + 1e-14);
  }
}

TEST(FirstContact, RefusesWhatItCannotUse) {
  const auto ball = MovingProbe::resting(Probe::ball(Vec3::Zero(), 1.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto uneven = ball;
  uneven.to.count = 2;

  Probe of_four = Probe::point(Vec3::Zero());
  of_four.core.count = 4;

  EXPECT_THROW((void)first_contact(ball, MovingProbe::translated(of_four, Vec3::UnitX())),
               std::invalid_argument);
  EXPECT_THROW((void)first_contact(ball, uneven), std::invalid_argument);
  EXPECT_THROW((void)first_contact(ball, MovingProbe::resting(Probe::ball(Vec3(nan, 0, 0), 1.0))),
               std::invalid_argument);
  EXPECT_THROW((void)first_contact(ball, MovingProbe::resting(Probe::ball(Vec3::Zero(), -1.0))),
               std::invalid_argument);
  EXPECT_THROW((void)first_contact(ball, ball, {-1.0}), std::invalid_argument);
  EXPECT_THROW((void)first_contact(ball, ball, {nan}), std::invalid_argument);
}

TEST(FirstContact, NamesWhichOfTheTwoItCannotUseAndWhen) {
  const auto ball = MovingProbe::resting(Probe::ball(Vec3::Zero(), 1.0));
  auto spoilt = ball;
  spoilt.to.x[0].x() = std::numeric_limits<double>::quiet_NaN();

  try {
    (void)first_contact(ball, spoilt);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "b at the end of the step has a corner at (nan   0   0) m; coordinates must be "
                 "finite and below 1e75");
  }
}

}  // namespace
}  // namespace plekton::geometry::first_contact_test

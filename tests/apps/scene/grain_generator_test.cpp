// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/grain_generator.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plekton::apps::grain_generator_test {
namespace {

using testing::HasSubstr;

GrainSettings graded(std::size_t count, const Vec3& size) {
  GrainSettings settings;
  settings.name = "gravel";
  settings.sizes =
      SizeCurve(std::vector<Sieve>{{0.006, 0.0}, {0.008, 0.3}, {0.016, 1.0}}, PassingBy::mass);
  settings.amount = count;
  settings.box = {Vec3(-0.1, 0.2, 0.0), Vec3(-0.1, 0.2, 0.0) + size};
  settings.seed = 5;
  return settings;
}

GrainSettings equal(std::size_t count, double radius, const Vec3& size) {
  GrainSettings settings = graded(count, size);
  settings.sizes = SizeCurve(2.0 * radius);
  return settings;
}

/// Overlap is decided on rounded distances: a gap may be below 0 by the rounding of coordinates of
/// this size (m).
constexpr double kRounding = 1e-15;

void expect_apart_and_inside(const std::vector<PlacedGrain>& grains, const Box& box) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(grains[i].centre[axis] - grains[i].radius, box.lower[axis] - kRounding);
      ASSERT_LE(grains[i].centre[axis] + grains[i].radius, box.upper[axis] + kRounding);
    }
    for (std::size_t j = 0; j < i; ++j) {
      ASSERT_GE((grains[i].centre - grains[j].centre).norm() - grains[i].radius - grains[j].radius,
                -kRounding)
          << i << ' ' << j;
    }
  }
}

std::string error_of(const GrainSettings& settings) {
  try {
    generate_grains(settings, {});
  } catch (const DoesNotFit& error) {
    return error.what();
  }
  return "";
}

TEST(GrainGenerator, PlacesGradedGrainsApartAndInside) {
  const GrainSettings settings = graded(1000, {0.12, 0.12, 0.12});

  const std::vector<PlacedGrain> grains = generate_grains(settings, {});

  ASSERT_EQ(grains.size(), 1000U);
  expect_apart_and_inside(grains, settings.box);
}

// Random sequential placement of equal balls jams at 0.384 of the volume (Zhang and Torquato
// 2013).
TEST(GrainGenerator, PlacesEqualGrainsDenserThanChanceAllowsOnALatticeOnly) {
  GrainSettings settings = equal(900, 0.005, {0.1, 0.1, 0.1});
  ASSERT_GT(900.0 * settings.sizes.mean_volume(), 0.45 * 1e-3);
  ASSERT_THAT(error_of(settings), HasSubstr("do not fit"));
  settings.placement = GrainPlacement::lattice;

  const std::vector<PlacedGrain> grains = generate_grains(settings, {});

  ASSERT_EQ(grains.size(), 900U);
  expect_apart_and_inside(grains, settings.box);
}

TEST(GrainGenerator, FillsABoxOfExactlyOneGrain) {
  GrainSettings settings = equal(1, 0.5, {1.0, 1.0, 1.0});
  settings.box = {Vec3::Zero(), Vec3::Ones()};
  const std::vector<PlacedGrain> grains = generate_grains(settings, {});

  ASSERT_EQ(grains.size(), 1U);
  expect_apart_and_inside(grains, settings.box);
}

// 0.01 + 0.05 is above 0.11 - 0.05 by rounding.
TEST(GrainGenerator, FillsABoxOfOneGrainAsItIsWritten) {
  GrainSettings settings;
  settings.sizes = SizeCurve(0.1);
  settings.amount = std::size_t{1};
  settings.box = {Vec3(-0.05, -0.05, 0.01), Vec3(0.05, 0.05, 0.11)};

  const auto grains = generate_grains(settings, {});

  ASSERT_EQ(grains.size(), 1u);
  EXPECT_NEAR(grains[0].centre[2], 0.06, 1e-15);
}

TEST(GrainGenerator, GivesTheSameGrainsForTheSameSeedOnly) {
  GrainSettings settings = graded(100, {0.1, 0.1, 0.1});
  const auto first = generate_grains(settings, {});
  const auto again = generate_grains(settings, {});
  settings.seed = 6;
  const auto other = generate_grains(settings, {});

  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].centre, again[i].centre);
    EXPECT_EQ(first[i].radius, again[i].radius);
  }
  EXPECT_NE(first[0].centre, other[0].centre);
}

TEST(GrainGenerator, ReachesAVolumeToHalfAGrain) {
  GrainSettings settings = graded(1, {0.2, 0.2, 0.2});
  settings.amount = 1e-3;

  double volume = 0.0;
  for (const PlacedGrain& grain : generate_grains(settings, {})) {
    volume += 4.0 / 3.0 * std::numbers::pi * std::pow(grain.radius, 3);
  }

  // The count is rounded, and each grain is drawn from a part of the curve: together at most 1.5 of
  // the largest.
  EXPECT_NEAR(volume, 1e-3, 1.5 * std::numbers::pi / 6.0 * std::pow(0.016, 3));
}

// With 100 grains of 2 to 20 mm chance alone missed it by up to a quarter.
TEST(GrainGenerator, ReachesAVolumeOfFewGrainsOfManySizes) {
  GrainSettings settings = graded(1, {0.3, 0.3, 0.3});
  settings.sizes = SizeCurve(std::vector<Sieve>{{0.002, 0.0}, {0.02, 1.0}}, PassingBy::mass);
  const double wanted = 100.0 * settings.sizes.mean_volume();
  settings.amount = wanted;
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    settings.seed = seed;
    double volume = 0.0;
    for (const PlacedGrain& grain : generate_grains(settings, {}))
      volume += 4.0 / 3.0 * std::numbers::pi * std::pow(grain.radius, 3);
    worst = std::max(worst, std::abs(volume / wanted - 1.0));
  }

  // By chance such grains are off by some 10 %, one in three by more: eight tries in a row are so in
  // one of 10 000 cases.
  EXPECT_LE(worst, 0.1);
}

TEST(GrainGenerator, KeepsClearOfFacetsBallsAndPlanes) {
  const GrainSettings settings = equal(200, 0.005, {0.1, 0.1, 0.1});
  const Vec3 corner = settings.box.lower;
  const Vec3 middle = corner + Vec3::Constant(0.05);
  const std::vector<Obstacle> obstacles = {
      {{corner + Vec3(-0.1, -0.1, 0.03), corner + Vec3(0.3, -0.1, 0.03),
        corner + Vec3(-0.1, 0.3, 0.03)},
       0.002},
      {{middle, middle, middle}, 0.02}};
  const std::vector<contact::Plane> planes = {
      {corner + Vec3(0.02, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3::Zero(), {}}};

  for (const PlacedGrain& grain : generate_grains(settings, {obstacles, planes})) {
    EXPECT_GE(std::abs(grain.centre[2] - corner[2] - 0.03), 0.007 - kRounding);
    EXPECT_GE((grain.centre - middle).norm(), 0.025 - kRounding);
    EXPECT_GE(grain.centre[0] - grain.radius, corner[0] + 0.02 - kRounding);
  }
}

// Twelve neighbours at the distance of a diameter around each ball of a face-centred cubic lattice;
// none in a random packing has any.
TEST(GrainGenerator, MakesTheLatticeThatIsAskedForAlsoWhereChanceWouldDo) {
  const double radius = 0.005;
  GrainSettings settings = equal(100, radius, {0.1, 0.1, 0.1});
  const auto contacts = [&](GrainPlacement placement) {
    settings.placement = placement;
    const auto grains = generate_grains(settings, {});
    EXPECT_EQ(grains.size(), 100U);
    int count = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if ((grains[i].centre - grains[j].centre).norm() < 2.0 * radius * (1.0 + 1e-6)) ++count;
      }
    }
    return count;
  };

  EXPECT_EQ(contacts(GrainPlacement::random), 0);
  EXPECT_GT(contacts(GrainPlacement::lattice), 0);
}

TEST(GrainGenerator, SaysHowFarALatticeWentWhenGrainsDoNotFit) {
  GrainSettings settings = equal(1300, 0.005, {0.1, 0.1, 0.1});
  settings.placement = GrainPlacement::lattice;

  const std::string error = error_of(settings);

  EXPECT_THAT(error, testing::ContainsRegex("on a lattice, [0-9]+ of 1300 found room"));
  EXPECT_THAT(error, testing::Not(HasSubstr("placement")));
}

TEST(GrainGenerator, SaysHowFarItWentWhenGrainsDoNotFit) {
  const std::string error = error_of(equal(1200, 0.005, {0.1, 0.1, 0.1}));

  EXPECT_THAT(error, HasSubstr("gravel: 1200 grains of 0.0006283 m3 in all"));
  EXPECT_THAT(
      error,
      HasSubstr(
          "do not fit the box of 0.1 m x 0.1 m x 0.1 m, 0.001 m3, 63 % of which they would fill"));
  // Centres have 0.9 of each side: 0.384 * 0.9^3 = 0.28 of the box when it jams.
  EXPECT_THAT(error, testing::ContainsRegex("[0-9]+ of 1200 found room, filling 2[678] %"));
  EXPECT_THAT(error, HasSubstr("make the box larger"));
  EXPECT_THAT(error, HasSubstr("placement = \"lattice\""));
}

// Random sequential placement ends at 0.38 of a large box: these fill 0.55.
TEST(GrainGenerator, PacksGradedGrainsToAPorosityWithTheirSizes) {
  GrainSettings settings = graded(0, {0.12, 0.12, 0.12});
  settings.placement = GrainPlacement::packed;
  settings.porosity = 0.45;

  const std::vector<PlacedGrain> grains = generate_grains(settings, {});

  double solids = 0.0;
  for (const PlacedGrain& grain : grains) {
    EXPECT_GE(grain.radius, 0.003);
    EXPECT_LE(grain.radius, 0.008);
    solids += geometry::ball_volume(grain.radius);
  }
  // To the last grain, the mean of which has 2e-4 of the box.
  EXPECT_NEAR(1.0 - solids / (0.12 * 0.12 * 0.12), 0.45, 1e-3);
  expect_apart_and_inside(grains, settings.box);
}

TEST(GrainGenerator, PacksGrainsUntilTheyPressOnEachOther) {
  GrainSettings settings = equal(0, 0.005, {0.06, 0.06, 0.06});
  settings.placement = GrainPlacement::packed;
  settings.stress = 1e4;
  Surroundings surroundings;
  surroundings.young_modulus = 1e7;

  const std::vector<PlacedGrain> grains = generate_grains(settings, surroundings);

  // Stress by its definition, from all overlaps: 2 E r / 2 between grains, E r at walls.
  double moment = 0.0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double r = grains[i].radius;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = grains[i].centre[axis] - settings.box.lower[axis];
      for (const double distance : {x, 0.06 - x})
        if (distance < r) moment += 1e7 * r * (r - distance) * distance;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (grains[i].centre - grains[j].centre).norm();
      if (distance < 2.0 * r) moment += 1e7 * r * (2.0 * r - distance) * distance;
    }
  }
  EXPECT_NEAR(moment / (3.0 * 0.06 * 0.06 * 0.06), 1e4, 0.011e4);
  EXPECT_NEAR(grains[0].radius, 0.005, 0.0005);
}

TEST(GrainGenerator, PlacesGrainsInACylinderInEveryWay) {
  for (const GrainPlacement placement :
       {GrainPlacement::random, GrainPlacement::lattice, GrainPlacement::packed}) {
    GrainSettings settings = equal(150, 0.005, Vec3::Ones());
    settings.cylinder = geometry::CylinderRegion{{0.0, 0.0, 0.1}, {0.0, 0.1, 0.2}, 0.04};
    settings.placement = placement;

    const std::vector<PlacedGrain> grains = generate_grains(settings, {});

    ASSERT_EQ(grains.size(), 150U);
    const Vec3 axis = Vec3(0.0, 1.0, 1.0).normalized();
    for (const PlacedGrain& grain : grains) {
      const Vec3 from = grain.centre - Vec3(0.0, 0.0, 0.1);
      const double height = axis.dot(from);
      EXPECT_LE((from - height * axis).norm(), 0.035 * (1.0 + 1e-6));
      EXPECT_GE(height, 0.005 * (1.0 - 1e-6));
      EXPECT_LE(height, 0.1 * std::sqrt(2.0) - 0.005 * (1.0 - 1e-6));
    }
  }
}

TEST(GrainGenerator, SaysAtWhichPorosityAPackingJams) {
  GrainSettings settings = graded(0, {0.08, 0.08, 0.08});
  settings.placement = GrainPlacement::packed;
  settings.porosity = 0.2;

  EXPECT_THAT(error_of(settings),
              testing::ContainsRegex("packed without friction they jam at a porosity of 0.[34]"));
}

TEST(GrainGenerator, RefusesAGrainLargerThanTheBox) {
  EXPECT_THAT(error_of(equal(1, 0.06, {0.1, 0.2, 0.2})), HasSubstr("0 of 1 found room"));
}

TEST(GrainGenerator, RefusesMoreGrainsThanMemoryHoldsWithoutDrawingThem) {
  EXPECT_THAT(error_of(equal(100'000'000'000'000, 0.005, {0.1, 0.1, 0.1})),
              HasSubstr("no arrangement of balls can"));
}

TEST(GrainGenerator, RefusesALatticeOfMoreSitesThanMemoryHoldsWithoutListingThem) {
  GrainSettings settings = equal(10, 0.001, {3.0, 3.0, 3.0});
  settings.placement = GrainPlacement::lattice;

  try {
    generate_grains(settings, {});
    FAIL() << "a lattice of billions of sites was listed";
  } catch (const InputError& error) {
    // sqrt(2) 27 / 0.002^3
    EXPECT_THAT(
        error.what(),
        testing::AllOf(HasSubstr("4.77e+09 sites"), HasSubstr("box of 3 m x 3 m x 3 m"),
                       HasSubstr("radius of 0.001 m"), HasSubstr("placement = \"random\"")));
  }
  settings.placement = GrainPlacement::random;
  EXPECT_EQ(generate_grains(settings, {}).size(), 10U);
}

TEST(DistanceToTriangle, IsTheSmallestOverThePointsOfTheTriangle) {
  test::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const std::array<Vec3, 3> triangle = {random.in_cube(1.0), random.in_cube(1.0),
                                          random.in_cube(1.0)};
    const Vec3 point = random.in_cube(2.0);
    double sampled = 1e9;
    constexpr int kSteps = 100;
    for (int a = 0; a <= kSteps; ++a) {
      for (int b = 0; a + b <= kSteps; ++b) {
        const Vec3 w = Vec3(a, b, kSteps - a - b) / kSteps;
        sampled = std::min(
            sampled, (w[0] * triangle[0] + w[1] * triangle[1] + w[2] * triangle[2] - point).norm());
      }
    }
    const double distance = distance_to_triangle(point, triangle);
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance,
              sampled - 2.0 * 3.5 /
                            kSteps);  // half the widest distance between samples, sides up to 3.5 m
  }
}

TEST(DistanceToTriangle, KnowsCollinearAndPointTriangles) {
  const Vec3 o = Vec3::Zero(), x(1.0, 0.0, 0.0), far(2.0, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({3.0, 0.0, 0.0}, {o, x, far}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.5, 2.0, 0.0}, {o, x, far}), 2.0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.0, 0.0, 3.0}, {o, o, o}), 3.0);
}

}  // namespace
}  // namespace plekton::apps::grain_generator_test

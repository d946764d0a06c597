// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/surface_query.hpp"

#include "tests/support/complexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace plekton::geometry::surface_query_test {
namespace {

using test::Complex;

Probe random_probe(test::Random& random, double spread) {
  const Vec3 at = random.in_cube(spread);
  switch (random.integer(0, 3)) {
    case 0:
      return Probe::point(at);
    case 1:
      return Probe::ball(at, random.unit());
    case 2:
      return Probe::cylinder(at, at + random.in_cube(1.0), random.unit());
    default:
      return Probe::facet({at, at + random.in_cube(1.0), at + random.in_cube(1.0)}, random.unit());
  }
}

NearestCell brute_force(const Probe& probe, const Surface& surface, Positions x) {
  NearestCell best{CellId{0}, proximity(probe, {surface, x}, CellId{0})};
  for (std::size_t c = 1; c < surface.cell_count(); ++c) {
    const Proximity found = proximity(probe, {surface, x}, id_at<CellId>(c));
    if (found.gap < best.proximity.gap) best = {id_at<CellId>(c), found};
  }
  return best;
}

void expect_same(const NearestCell& found, const NearestCell& expected) {
  EXPECT_EQ(found.cell, expected.cell);
  EXPECT_EQ(found.proximity.gap, expected.proximity.gap);
  EXPECT_EQ(found.proximity.normal, expected.proximity.normal);
  EXPECT_EQ(found.proximity.b.feature, expected.proximity.b.feature);
}

TEST(SurfaceQuery, FindsWhatBruteForceFindsNearAndFar) {
  test::Random random(1);
  for (const Complex& complex : {test::sheet(6), test::net(5), test::ball(3), test::bow_tie()}) {
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    for (int trial = 0; trial < 300 && !::testing::Test::HasFailure(); ++trial) {
      const Probe probe = random_probe(random, trial < 200 ? 6.0 : 600.0);
      expect_same(*query.nearest(probe), brute_force(probe, surface, complex.x));
    }
  }
}

/// The cells around a nearest node are equally near but for rounding.
TEST(SurfaceQuery, NamesTheLowestOfTheCellsAroundANodeWhoseGapsAreEqualToTheLastBit) {
  test::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Complex turned = test::rotated(test::ball(1), random.rotation());
    const Surface surface = turned.surface();
    const std::size_t node = random.index(turned.x.size());
    const Probe probe = Probe::point(3.0 * turned.x[node]);

    const NearestCell found = *SurfaceQuery(surface, turned.x).nearest(probe);

    expect_same(found, brute_force(probe, surface, turned.x));
    EXPECT_EQ(found.proximity.b.feature, Feature(id_at<NodeId>(node)));
    const double rounding = 2.0 * 1e-12 * 2.0;  // m, of both distances of 2 m (primitive_pairs.hpp)
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      const auto nodes = surface.nodes_of(id_at<CellId>(c));
      if (std::find(nodes.begin(), nodes.end(), id_at<NodeId>(node)) == nodes.end()) continue;
      const Proximity around = proximity(probe, {surface, turned.x}, id_at<CellId>(c));
      EXPECT_NEAR(around.gap, found.proximity.gap, rounding);
    }
  }
}

TEST(SurfaceQuery, FollowsTheNodes) {
  test::Random random(2);
  Complex complex = test::sheet(5);
  const Surface surface = complex.surface();
  SurfaceQuery query(surface, complex.x);
  for (int step = 0; step < 20; ++step) {
    for (Vec3& x : complex.x) x += random.in_cube(0.3);
    query.move(complex.x);

    const Probe probe = random_probe(random, 4.0);
    expect_same(*query.nearest(probe), brute_force(probe, surface, complex.x));
  }
}

TEST(SurfaceQuery, ListsEveryCellWithinAGap) {
  test::Random random(3);
  const Complex complex = test::sheet(6);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  for (int trial = 0; trial < 100; ++trial) {
    const Probe probe = random_probe(random, 6.0);
    const auto found = query.within(probe, 1.5);

    std::size_t next = 0;
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      if (!(proximity(probe, {surface, complex.x}, id_at<CellId>(c)).gap < 1.5)) continue;
      ASSERT_LT(next, found.size());
      EXPECT_EQ(found[next++].cell, id_at<CellId>(c));
    }
    EXPECT_EQ(next, found.size());
  }
}

TEST(SurfaceQuery, GivesTheDistanceOfTwoSurfaces) {
  test::Random random(4);
  const Complex first = test::ball(2);
  for (int trial = 0; trial < 20; ++trial) {
    Complex second = test::rotated(test::net(3), random.rotation());
    const Vec3 way = 5.0 * random.direction();
    for (Vec3& x : second.x) x += way;
    const Surface a = first.surface();
    const Surface b = second.surface();

    const auto found = SurfaceQuery(a, first.x).nearest(SurfaceQuery(b, second.x));

    NearestCells best{CellId{0}, CellId{0}, {}};
    best.proximity.gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.cell_count(); ++i) {
      for (std::size_t k = 0; k < b.cell_count(); ++k) {
        const Proximity p =
            proximity(PlacedSurface{a, first.x}, id_at<CellId>(i), {b, second.x}, id_at<CellId>(k));
        if (p.gap < best.proximity.gap) best = {id_at<CellId>(i), id_at<CellId>(k), p};
      }
    }
    EXPECT_EQ(found->a, best.a);
    EXPECT_EQ(found->b, best.b);
    EXPECT_EQ(found->proximity.gap, best.proximity.gap);
    EXPECT_EQ(found->proximity.normal, best.proximity.normal);
  }
}

TEST(SurfaceQuery, AnswersBatchesAlikeForAnyNumberOfThreads) {
  test::Random random(5);
  const Complex complex = test::ball(3);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  std::vector<Probe> probes;
  std::vector<Ray> rays;
  for (int k = 0; k < 500; ++k) {
    probes.push_back(random_probe(random, 3.0));
    rays.push_back({random.in_cube(3.0), random.in_cube(1.0)});
  }
  ThreadPool one(1);
  const auto nearest = query.nearest(probes, one);
  const auto hits = query.first_hits(rays, one);
  for (const int threads : {2, 3}) {
    ThreadPool pool(threads);
    const auto again = query.nearest(probes, pool);
    const auto hits_again = query.first_hits(rays, pool);
    for (std::size_t i = 0; i < probes.size(); ++i) {
      expect_same(*again[i], *nearest[i]);
      ASSERT_EQ(hits_again[i].has_value(), hits[i].has_value());
      if (hits[i]) {
        EXPECT_EQ(hits_again[i]->t, hits[i]->t);
      }
    }
  }
}

TEST(SurfaceQuery, HasNoAnswerWithoutCells) {
  const Surface nothing({}, {}, 0);
  const SurfaceQuery query(nothing, {});

  EXPECT_FALSE(query.nearest(Probe::point(Vec3::Zero())).has_value());
  EXPECT_FALSE(query.nearest(query).has_value());
  EXPECT_FALSE(query.first_hit({Vec3::Zero(), Vec3::UnitX()}).has_value());
  EXPECT_TRUE(query.within(Probe::point(Vec3::Zero()), 1.0).empty());
}

TEST(SurfaceQuery, RefusesProbesThatItCannotUse) {
  const Complex complex = test::sheet(1);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ThreadPool pool(2);

  EXPECT_THROW((void)query.nearest(Probe::point(Vec3(nan, 0, 0))), std::invalid_argument);
  EXPECT_THROW((void)query.within(Probe::ball(Vec3::Zero(), -1.0), 1.0), std::invalid_argument);
  Probe empty = Probe::point(Vec3::Zero());
  empty.core.count = 0;
  EXPECT_THROW((void)query.nearest(empty), std::invalid_argument);
  EXPECT_THROW((void)query.nearest(Probe::cylinder(Vec3::Zero(), Vec3(0, 1e90, 0), 1.0)),
               std::invalid_argument);
  EXPECT_THROW((void)query.nearest(std::vector{Probe::ball(Vec3::Zero(), nan)}, pool),
               std::invalid_argument);
}

TEST(SurfaceQuery, RefusesPositionsThatItCannotUse) {
  Complex complex = test::sheet(1);
  const Surface surface = complex.surface();
  complex.x[2].y() = std::numeric_limits<double>::quiet_NaN();
  complex.x[3].x() = 1e80;

  EXPECT_THROW(SurfaceQuery(surface, std::vector<Vec3>(3, Vec3::Zero())), std::invalid_argument);
  try {
    SurfaceQuery query(surface, complex.x);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "node 2 is at (  1 nan   0) m; coordinates must be finite and below 1e75\n"
                 "node 3 is at (1e+80     1     0) m; coordinates must be finite and below 1e75");
  }
}

TEST(SurfaceQuery, ListsAllCellsWithinAnyLengthThatIsLongEnough) {
  const Complex complex = test::sheet(6);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  const double infinity = std::numeric_limits<double>::infinity();
  // From the furthest point that may be asked with the cells are nearly 1e75 m away.
  for (const Vec3& x : {Vec3(0, 0, 5), Vec3(0.99e75, 0, 0)}) {
    for (const double gap : {1e76, 1e160, std::numeric_limits<double>::max(), infinity}) {
      const auto found = query.within(Probe::point(x), gap);

      ASSERT_EQ(found.size(), surface.cell_count()) << gap;
      for (std::size_t c = 0; c < found.size(); ++c) EXPECT_EQ(found[c].cell, id_at<CellId>(c));
    }
  }
  EXPECT_TRUE(query.within(Probe::point(Vec3(0, 0, 5)), -infinity).empty());
}

TEST(SurfaceQuery, RefusesToListCellsWithinWhatIsNoLength) {
  const Complex complex = test::sheet(1);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);

  EXPECT_THROW(
      (void)query.within(Probe::point(Vec3::Zero()), std::numeric_limits<double>::quiet_NaN()),
      std::invalid_argument);
}

TEST(SurfaceQuery, NamesTheProbesOfManyThatItCannotUse) {
  const Complex complex = test::sheet(1);
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Probe> probes(1000, Probe::point(Vec3(0, 0, 5)));
  probes[617] = Probe::point(Vec3(nan, 0, 0));
  probes[901] = Probe::ball(Vec3(0, 0, 1), -1.0);
  const auto message = [&](int threads) -> std::string {
    ThreadPool pool(threads);
    try {
      (void)query.nearest(probes, pool);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };

  for (const int threads : {1, 3}) {
    EXPECT_EQ(message(threads),
              "probe 617 has a corner at (nan   0   0) m; coordinates must be finite and below "
              "1e75\nprobe 901 has radius -1 m; expected from 0 to below 1e75");
  }
  for (std::size_t i = 0; i < 10; ++i) probes[i] = Probe::ball(Vec3::Zero(), nan);
  EXPECT_TRUE(message(2).starts_with("probe 0 has radius nan m"));
  EXPECT_TRUE(
      message(2).ends_with("probe 7 has radius nan m; expected from 0 to below 1e75\n"
                           "and 4 more probes like these"));
}

/// It would keep the address of what is gone.
TEST(SurfaceQuery, CannotBeMadeOfATemporary) {
  EXPECT_TRUE((std::is_constructible_v<SurfaceQuery, const Surface&, Positions>));
  EXPECT_FALSE((std::is_constructible_v<SurfaceQuery, Surface, Positions>));
}

}  // namespace
}  // namespace plekton::geometry::surface_query_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/skin.hpp"

#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/primitives/facet.hpp"
#include "geometry/primitives/sphere.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace plekton::geometry::skin_test {
namespace {

using Random = std::mt19937_64;

// All lengths below are whole multiples of 2^-16 between -8 and 8, and weights are eighths. Then
// coordinates of points with such weights have at most 23 bits, and their differences, squares and
// sums are exact in double: the test knows without any error whether two elements touch.
constexpr double kUnit = 0x1p-16;

double lattice(Random& random, double low, double high) {
  const auto bound = [](double length) { return static_cast<int>(std::lround(length / kUnit)); };
  return kUnit * std::uniform_int_distribution<int>(bound(low), bound(high))(random);
}

Vec3 lattice_point(Random& random, double low, double high) {
  return {lattice(random, low, high), lattice(random, low, high), lattice(random, low, high)};
}

/// A lattice vector no longer than a length; now and then exactly as long, along an axis.
Vec3 displacement(Random& random, double length) {
  if (random() % 8 == 0)
    return Vec3::Unit(static_cast<int>(random() % 3)) * (random() % 2 == 0 ? length : -length);
  Vec3 result;
  do {
    result = lattice_point(random, -length, length);
  } while (result.squaredNorm() > length * length);
  return result;
}

void displace(std::vector<Vec3>& positions, const std::vector<Vec3>& from, Random& random,
              double length) {
  for (std::size_t node = 0; node < from.size(); ++node)
    positions[node] = from[node] + displacement(random, length);
}

std::vector<Vec3> random_nodes(Random& random, std::size_t count, double half_width) {
  std::vector<Vec3> nodes(count);
  for (Vec3& node : nodes) node = lattice_point(random, -half_width, half_width);
  return nodes;
}

bool listed(const std::vector<IndexPair>& pairs, std::size_t a, std::size_t b) {
  return std::binary_search(pairs.begin(), pairs.end(),
                            IndexPair{static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
}

template <class Element>
BroadPhase broad_phase_of(const std::vector<Element>& elements, Positions x, double margin) {
  std::vector<Box> boxes;
  for (const Element& element : elements) boxes.push_back(box(element, x, margin));
  BroadPhase broad_phase;
  broad_phase.rebuild(boxes);
  return broad_phase;
}

/// Whether a sphere touches a facet at one of the facet's points whose weights are eighths.
bool touches_at_an_eighth(const Sphere& sphere, const Facet& facet, Positions x) {
  const Vec3& centre = x[index_of(sphere.nodes[0])];
  const auto [x0, x1, x2] = core(facet, x);
  const double range = sphere.radius + facet.radius;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; i + j <= 8; ++j) {
      const Vec3 point = i / 8.0 * x0 + j / 8.0 * x1 + (8 - i - j) / 8.0 * x2;
      if ((point - centre).squaredNorm() <= range * range) return true;
    }
  }
  return false;
}

constexpr double kSkin = 0x1p-3;

TEST(Skin, KeepsEveryPairOfTouchingSpheresListedUntilItAsksForARebuild) {
  Random random(1);
  ThreadPool pool(2);
  std::size_t touching = 0;
  for (int scene = 0; scene < 300; ++scene) {
    const std::vector<Vec3> built = random_nodes(random, 60, 1.0);
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < built.size(); ++i)
      spheres.push_back({{id_at<NodeId>(i)}, lattice(random, 0.125, 0.25)});
    Skin skin(kSkin);
    skin.mark_built(built);
    std::vector<IndexPair> pairs;
    broad_phase_of(spheres, built, skin.margin()).self_pairs(pairs);

    for (int motion = 0; motion < 10; ++motion) {
      std::vector<Vec3> x(built.size());
      // Lengths from half of what is allowed to a little more.
      displace(x, built, random, kSkin / 2 * (0.5 + motion / 16.0));
      if (skin.needs_rebuild(x, pool)) continue;
      for (std::size_t i = 0; i < x.size(); ++i) {
        for (std::size_t j = i + 1; j < x.size(); ++j) {
          const double range = spheres[i].radius + spheres[j].radius;
          if ((x[i] - x[j]).squaredNorm() > range * range) continue;
          ++touching;
          ASSERT_TRUE(listed(pairs, i, j))
              << "scene " << scene << ", spheres " << i << " and " << j;
        }
      }
    }
  }
  EXPECT_GT(touching, 50000u);
}

TEST(Skin, KeepsEveryPairOfATouchingSphereAndFacetListedUntilItAsksForARebuild) {
  Random random(2);
  ThreadPool pool(1);
  std::size_t touching = 0;
  for (int scene = 0; scene < 100; ++scene) {
    const std::vector<Vec3> built = random_nodes(random, 60, 1.0);
    std::vector<Sphere> spheres;
    std::vector<Facet> facets;
    for (std::size_t i = 0; i < 30; ++i) {
      spheres.push_back({{id_at<NodeId>(i)}, lattice(random, 0.0625, 0.125)});
      // Neighbours share nodes.
      facets.push_back({{id_at<NodeId>(30 + i), id_at<NodeId>(30 + (i + 1) % 30),
                         id_at<NodeId>(30 + (i + 2) % 30)},
                        0x1p-6});
    }
    Skin skin(kSkin);
    skin.mark_built(built);
    std::vector<IndexPair> pairs;
    broad_phase_of(spheres, built, skin.margin())
        .pairs_with(broad_phase_of(facets, built, skin.margin()), pairs);

    for (int motion = 0; motion < 5; ++motion) {
      std::vector<Vec3> x(built.size());
      displace(x, built, random, kSkin / 2 * (0.75 + motion / 16.0));
      if (skin.needs_rebuild(x, pool)) continue;
      for (std::size_t s = 0; s < spheres.size(); ++s) {
        for (std::size_t f = 0; f < facets.size(); ++f) {
          if (!touches_at_an_eighth(spheres[s], facets[f], x)) continue;
          ++touching;
          ASSERT_TRUE(listed(pairs, s, f))
              << "scene " << scene << ", sphere " << s << ", facet " << f;
        }
      }
    }
  }
  EXPECT_GT(touching, 5000u);
}

TEST(Skin, IsTight) {
  // Two spheres with a gap of exactly the skin come together by half the skin each: just listed,
  // and just in time.
  const std::vector<Vec3> built{Vec3(0, 0, 0), Vec3(2.0 + kSkin, 0, 0)};
  const std::vector<Sphere> spheres{{{NodeId{0}}, 1.0}, {{NodeId{1}}, 1.0}};
  std::vector<IndexPair> pairs;

  broad_phase_of(spheres, built, Skin(kSkin).margin()).self_pairs(pairs);

  EXPECT_TRUE(listed(pairs, 0, 1));
}

TEST(Skin, AsksForARebuildExactlyWhenANodeHasMovedByHalfTheSkin) {
  ThreadPool pool(4);
  const std::vector<Vec3> built(100, Vec3(3, -2, 5));
  Skin skin(kSkin);
  skin.mark_built(built);
  for (const std::size_t node : {0u, 25u, 99u}) {
    std::vector<Vec3> x = built;

    // The rule keeps 5e-13 of the skin in hand.
    x[node].y() = built[node].y() - kSkin / 2 * (1 - 1e-12);
    EXPECT_FALSE(skin.needs_rebuild(x, pool));
    x[node].y() = built[node].y() - kSkin / 2;
    EXPECT_TRUE(skin.needs_rebuild(x, pool));
  }
}

TEST(Skin, MeasuresFromTheLastListAndNotTheWayBetween) {
  ThreadPool pool;
  std::vector<Vec3> x(1, Vec3::Zero());
  Skin skin(1.0);
  skin.mark_built(x);

  for (int step = 0; step < 100; ++step) {
    x[0].x() = step % 2 == 0 ? 0.4 : -0.4;
    EXPECT_FALSE(skin.needs_rebuild(x, pool));
  }
  x[0].x() = 0.6;
  EXPECT_TRUE(skin.needs_rebuild(x, pool));
  skin.mark_built(x);
  EXPECT_FALSE(skin.needs_rebuild(x, pool));
}

/// Of nodes that a rank does not know it has no places at all.
TEST(Skin, IsAskedByRanksThatKnowSomeOfTheNodesEach) {
  constexpr int kRanks = 3;
  constexpr std::size_t kNodes = 50;
  test::ThreadRanks(kRanks).run([](Ranks& ranks) {
    ThreadPool pool(2);
    test::Random random(17);
    std::vector<NodeId> common, own;
    std::vector<bool> is_known(kNodes, false);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const int owner = static_cast<int>(i) % (kRanks + 1);
      is_known[i] = owner == kRanks || owner == ranks.rank();
      if (is_known[i]) (owner == kRanks ? common : own).push_back(id_at<NodeId>(i));
    }
    const KnownNodes known{&ranks, common, own};
    std::vector<Vec3> x(kNodes, Vec3::Zero());
    Skin alone(kSkin), shared(kSkin);
    alone.mark_built(x);
    shared.mark_built(x);
    int rebuilds = 0;
    for (int step = 0; step < 300; ++step) {
      for (Vec3& position : x) position += 0.05 * kSkin * random.in_cube(1.0);
      std::vector<Vec3> x_of_rank = x;
      for (std::size_t i = 0; i < kNodes; ++i)
        if (!is_known[i]) x_of_rank[i] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      const double way = 0.1 * kSkin;
      ASSERT_EQ(shared.may_need_rebuild(way), alone.may_need_rebuild(way)) << step;
      const bool needed = alone.needs_rebuild(x, pool);
      ASSERT_EQ(shared.needs_rebuild(x_of_rank, pool, &known), needed) << step;
      if (!needed) continue;
      ++rebuilds;
      alone.mark_built(x);
      shared.mark_built(x);
    }
    EXPECT_GT(rebuilds, 5);
  });
}

/// Nodes far from the origin that wander, each step rounded as in a simulation.
TEST(Skin, MayNeedARebuildWheneverItDoesAndSeldomElse) {
  ThreadPool pool;
  test::Random random(3);
  for (const double away : {0.0, 1e3, 1e9}) {
    std::vector<Vec3> x(20, Vec3::Constant(away));
    Skin asked(kSkin);
    Skin always_looks(kSkin);
    asked.mark_built(x);
    always_looks.mark_built(x);
    int looks = 0;
    int rebuilds = 0;
    for (int step = 0; step < 20000; ++step) {
      double way = 0.0;
      for (Vec3& position : x) {
        const Vec3 v = 0.01 * kSkin * random.in_cube(1.0);
        position += v;
        way = std::max(way, v.norm());
      }
      const bool needed = always_looks.needs_rebuild(x, pool);
      const bool may = asked.may_need_rebuild(way);
      looks += may;
      ASSERT_TRUE(may || !needed);
      ASSERT_EQ(may && asked.needs_rebuild(x, pool), needed);
      if (!needed) continue;
      ++rebuilds;
      asked.mark_built(x);
      always_looks.mark_built(x);
    }
    EXPECT_GE(rebuilds, 3);
    EXPECT_LT(looks, 20000 / 3);
  }
}

TEST(Skin, MayNeedARebuildAfterAWayThatIsNotKnown) {
  ThreadPool pool;
  const std::vector<Vec3> x(3, Vec3::Zero());
  Skin skin(kSkin);
  EXPECT_TRUE(skin.may_need_rebuild(0.0));
  skin.mark_built(x);
  EXPECT_FALSE(skin.may_need_rebuild(0.4 * kSkin));
  EXPECT_TRUE(skin.may_need_rebuild(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(skin.needs_rebuild(x, pool));
  EXPECT_FALSE(skin.may_need_rebuild(0.4 * kSkin));
  EXPECT_TRUE(skin.may_need_rebuild(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Skin, AsksForARebuildWhenNothingWasBuiltOrNodesCameOrWentOrAPositionIsNotANumber) {
  ThreadPool pool(2);
  Skin skin(1.0);
  std::vector<Vec3> x(10, Vec3::Zero());
  EXPECT_TRUE(skin.needs_rebuild(x, pool));
  EXPECT_TRUE(skin.needs_rebuild({}, pool));
  skin.mark_built(x);
  EXPECT_FALSE(skin.needs_rebuild(x, pool));

  EXPECT_TRUE(skin.needs_rebuild(Positions(x).first(9), pool));
  x[7].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(skin.needs_rebuild(x, pool));
}

TEST(Skin, WithoutThicknessAlwaysAsksForARebuild) {
  ThreadPool pool;
  const std::vector<Vec3> x(1, Vec3::Zero());
  Skin skin(0.0);
  skin.mark_built(x);

  EXPECT_EQ(skin.margin(), 0.0);
  EXPECT_TRUE(skin.needs_rebuild(x, pool));
}

TEST(Skin, RefusesAThicknessThatIsNoLength) {
  for (const double skin : {-1.0, 1e-101, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(Skin{skin}, std::invalid_argument) << skin;
  }
}

}  // namespace
}  // namespace plekton::geometry::skin_test

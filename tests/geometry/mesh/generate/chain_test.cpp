// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/lattice.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace plekton::geometry::chain_test {
namespace {

using ::testing::HasSubstr;

double length_of(const Lattice& lattice, std::size_t edge) {
  const auto& [a, b] = lattice.edges[edge].nodes;
  return (lattice.points[index_of(b)] - lattice.points[index_of(a)]).norm();
}

std::string message_of(const Chain& bad) {
  try {
    chain(bad);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Chain, PassesItsPointsExactlyAndIsAsLongAsTheWayThroughThem) {
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec3> points;
    for (int i = random.integer(2, 9); i > 0; --i) points.push_back(random.in_cube(10.0));
    const auto divisions = static_cast<std::size_t>(random.integer(1, 7));
    double way = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) way += (points[i] - points[i - 1]).norm();

    const Lattice lattice = chain({points, static_cast<int>(divisions)});

    ASSERT_EQ(lattice.points.size(), (points.size() - 1) * divisions + 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_EQ(lattice.points[i * divisions], points[i]);
    double sum = 0.0;
    for (std::size_t e = 0; e < lattice.edges.size(); ++e) {
      const std::size_t part = e / divisions;
      const double expected =
          (points[part + 1] - points[part]).norm() / static_cast<double>(divisions);
      // Positions of up to 10 m are rounded by 2e-15 m on each axis.
      ASSERT_NEAR(length_of(lattice, e), expected, 1e-14);
      sum += length_of(lattice, e);
    }
    ASSERT_NEAR(sum, way, 1e-14 * static_cast<double>(lattice.edges.size()));
  }
}

TEST(Chain, ThatIsClosedAndDividedHasTwoLinksAtEveryNode) {
  const Vec3 corner(0.0, 0.0, 1.0), other(3.0, 0.0, 1.0), third(0.0, 3.0, 1.0);

  const Lattice ring = chain({{corner, other, third, corner}, 3});

  ASSERT_EQ(ring.points.size(), 9u);
  ASSERT_EQ(ring.edges.size(), 9u);
  std::vector<int> degrees(9, 0);
  double length = 0.0;
  for (std::size_t e = 0; e < 9; ++e) {
    const auto& [a, b] = ring.edges[e].nodes;
    EXPECT_LT(a, b);
    if (e > 0) {
      EXPECT_LT(ring.edges[e - 1].nodes, ring.edges[e].nodes);
    }
    ++degrees[index_of(a)];
    ++degrees[index_of(b)];
    length += length_of(ring, e);
  }
  EXPECT_EQ(degrees, std::vector<int>(9, 2));
  EXPECT_NEAR(length, 6.0 + 3.0 * std::sqrt(2.0), 1e-14);
}

TEST(Chain, GoesThereAndBackIfItHasLinksEnough) {
  const std::vector<Vec3> there_and_back{Vec3::Zero(), Vec3::UnitX(), Vec3::Zero()};

  EXPECT_THAT(message_of({there_and_back, 1}), HasSubstr("has 2 links; expected at least 3"));
  EXPECT_EQ(chain({there_and_back, 2}).points.size(), 4u);
}

TEST(Chain, NamesThePointThatIsNotFiniteOrTooFarAway) {
  for (const double bad : {std::nan(""), -std::numeric_limits<double>::infinity(),
                           kLargestCoordinate, -kLargestCoordinate}) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> points{Vec3::Zero(), Vec3::Ones(), 2.0 * Vec3::Ones()};
      points[2][axis] = bad;
      EXPECT_THAT(message_of({points, 1}), HasSubstr("point 2 of a chain is not finite")) << bad;
    }
  }
}

TEST(Chain, IsRefusedBeforeItIsMadeIfItsNodesHaveNoNumbers) {
  constexpr int kMost = std::numeric_limits<int>::max();
  const std::vector<Vec3> points{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};

  EXPECT_THAT(message_of({points, kMost}), HasSubstr("a chain of about 4.29497e+09 nodes"));
  EXPECT_THAT(message_of({points, kMost / 2 + 1}), HasSubstr("their numbers end at 2147483647"));
  EXPECT_THAT(message_of({points, -1}), HasSubstr("-1; expected at least 1"));
}

}  // namespace
}  // namespace plekton::geometry::chain_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/predicates.hpp"

#include "tests/support/exact.hpp"
#include "tests/support/point_triangle_families.hpp"
#include "tests/support/simplex_families.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <thread>

namespace plekton::geometry::predicates_test {
namespace {

using test::kFamilies;
using test::kFamilyNames;
using test::PointTriangle;
using test::PointTriangleFamilies;

/// Wrong signs among all that the regions of one query ask for: 6 of vertices, 6 of edges.
[[gnu::noinline]] int wrong_signs(const PointTriangle& query) {
  int wrong = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::size_t step : {1U, 2U}) {
      const Vec3& a = query.x[i];
      const Vec3& b = query.x[(i + step) % 3];
      const Vec3& o = query.x[(i + 3 - step) % 3];
      wrong += sign_past_vertex(a, b, query.p) != test::exact_sign_past_vertex(a, b, query.p);
      wrong += sign_inside_edge(a, b, o, query.p) != test::exact_sign_inside_edge(a, b, o, query.p);
    }
  }
  return wrong;
}

PointTriangle scaled_by(PointTriangle query, double factor) {
  query.p *= factor;
  for (Vec3& corner : query.x) corner *= factor;
  return query;
}

TEST(Signs, AgreeWithExactArithmeticOnAdversarialFamilies) {
  PointTriangleFamilies families(1);
  for (std::size_t k = 0; k < kFamilies.size(); ++k) {
    int wrong = 0;

    for (int trial = 0; trial < 10000; ++trial) wrong += wrong_signs(families.draw(kFamilies[k]));

    EXPECT_EQ(wrong, 0) << kFamilyNames[k];
  }
}

TEST(Signs, AreExactForAnyScaleOfCoordinatesUpTo1e75) {
  // Down to where products underflow in double, and differences are subnormal.
  for (const double factor : {1e74, 1e30, 1e-30, 1e-60, 1e-75, 1e-150, 1e-300, 1e-310, 1e-320}) {
    PointTriangleFamilies families(2);
    for (std::size_t k = 0; k < kFamilies.size(); ++k) {
      int wrong = 0;
      // The offset of 1e6 and the grid of 10 would leave the range at the upper end.
      const double room = factor > 1.0 ? 1e-6 : 1.0;

      for (int trial = 0; trial < 200; ++trial) {
        wrong += wrong_signs(scaled_by(families.draw(kFamilies[k]), factor * room));
      }

      EXPECT_EQ(wrong, 0) << kFamilyNames[k] << " scaled by " << factor;
    }
  }
}

TEST(Signs, AreExactWhenCoordinatesOfVeryDifferentSizeMeet) {
  test::Random random(3);
  const auto coordinate = [&] {
    return random.integer(0, 4) == 0 ? 0.0 : random.signed_power(-300.0, 74.0);
  };
  int wrong = 0;

  for (int trial = 0; trial < 3000; ++trial) {
    PointTriangle query;
    for (Vec3* x : {&query.p, &query.x[0], &query.x[1], &query.x[2]})
      *x = Vec3(coordinate(), coordinate(), coordinate());
    wrong += wrong_signs(query);
  }

  EXPECT_EQ(wrong, 0);
}

/// Three arrows between corners of hard pairs of triangles.
TEST(SignsOfThreeArrows, AgreeWithExactArithmeticOnAdversarialFamilies) {
  test::SimplexFamilies<3, 3> families(7);
  for (std::size_t k = 0; k < test::kPairFamilies.size(); ++k) {
    int wrong = 0;

    for (int trial = 0; trial < 5000; ++trial) {
      const auto [a, b] = families.draw(test::kPairFamilies[k]);
      for (const double factor : {1.0, 1e-60, 1e-160}) {
        std::array<Vec3, 6> x{a[0], a[1], a[2], b[0], b[1], b[2]};
        for (Vec3& point : x) point *= factor;
        const auto s = test::scaled(x).points;
        const auto u = test::difference(s[1], s[0]);
        const auto v = test::difference(s[4], s[3]);
        const auto w = test::difference(s[3], s[2]);
        const int crosses = test::dot(test::cross(u, v), test::cross(u, w)).sign();
        const int volume = test::dot(test::cross(u, v), w).sign();
        wrong += sign_of_crosses({x[0], x[1]}, {x[3], x[4]}, {x[2], x[3]}) != crosses;
        wrong += sign_of_volume({x[0], x[1]}, {x[3], x[4]}, {x[2], x[3]}) != volume;
      }
    }

    EXPECT_EQ(wrong, 0) << test::kPairFamilyNames[k];
  }
}

TEST(ExactLengths, KeepAllDigitsWhereDoublesCancel) {
  const Vec3 origin = Vec3::Zero();
  const Vec3 along(1, 1, 0);
  const Vec3 end(0.5, 0.5, 1e-30);

  EXPECT_EQ(exact_part_across({origin, end}, {origin, along}), Vec3(0, 0, 1e-30));
  EXPECT_EQ(exact_part_along_normal({origin, end}, {origin, along}, {origin, Vec3(1, 2, 0)}),
            Vec3(0, 0, 1e-30));
  EXPECT_EQ(exact_volume({origin, along}, {origin, Vec3(1, 2, 0)}, {origin, end}), 1e-30);
}

TEST(SignPastVertex, IsZeroOnThePlaneAndForAnEdgeWithoutLength) {
  const Vec3 a(0.1, 0.2, 0.3);
  const Vec3 b(0.4, 0.7, 0.3);

  EXPECT_EQ(sign_past_vertex(a, b, a), 0);
  EXPECT_EQ(sign_past_vertex(a, b, a + Vec3::UnitZ()), 0);
  EXPECT_EQ(sign_past_vertex(a, a, b), 0);
  EXPECT_EQ(sign_past_vertex(a, b, b), 1);
  EXPECT_EQ(sign_past_vertex(b, a, a), 1);
  EXPECT_EQ(sign_past_vertex(a, b, a - (b - a)), -1);
}

TEST(SignInsideEdge, IsZeroOnThePlaneOnTheLineAndForATriangleWithoutArea) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(3, 0, 0);
  const Vec3 o(1, 2, 0);

  EXPECT_EQ(sign_inside_edge(a, b, o, Vec3(1, 0, 5)), 0);
  EXPECT_EQ(sign_inside_edge(a, b, o, Vec3(7, 0, 0)), 0);
  EXPECT_EQ(sign_inside_edge(a, b, Vec3(5, 0, 0), Vec3(1, 1, 1)), 0);
  EXPECT_EQ(sign_inside_edge(a, a, o, Vec3(1, 1, 1)), 0);
  EXPECT_EQ(sign_inside_edge(a, b, o, o), 1);
  EXPECT_EQ(sign_inside_edge(a, b, o, Vec3(1, std::numeric_limits<double>::denorm_min(), 5)), 1);
  EXPECT_EQ(sign_inside_edge(a, b, o, Vec3(1, -std::numeric_limits<double>::denorm_min(), 5)), -1);
}

TEST(Signs, HaveTheSymmetriesOfTheirPolynomials) {
  PointTriangleFamilies families(4);
  for (std::size_t k = 0; k < kFamilies.size(); ++k) {
    for (int trial = 0; trial < 2000; ++trial) {
      const auto [p, x] = families.draw(kFamilies[k]);
      const auto& [a, b, o] = x;

      EXPECT_EQ(sign_past_vertex(a, b, p), sign_past_vertex(a, p, b));
      EXPECT_EQ(sign_past_vertex(a, b, p), sign_past_vertex(-a, -b, -p));
      EXPECT_EQ(sign_past_vertex(Vec3::Zero(), b, p), -sign_past_vertex(Vec3::Zero(), b, -p));
      EXPECT_FALSE(sign_past_vertex(a, b, p) < 0 && sign_past_vertex(b, a, p) < 0);
      EXPECT_EQ(sign_inside_edge(a, b, o, p), sign_inside_edge(b, a, o, p));
      EXPECT_EQ(sign_inside_edge(a, b, o, p), sign_inside_edge(a, b, p, o));
      EXPECT_EQ(sign_inside_edge(a, b, o, p), sign_inside_edge(-a, -b, -o, -p));
      EXPECT_EQ(sign_inside_edge(Vec3::Zero(), b, o, p), -sign_inside_edge(Vec3::Zero(), b, o, -p));
    }
  }
}

TEST(Signs, LeaveTheRoundingModeAlone) {
  PointTriangleFamilies families(5);
  const int before = std::fegetround();
  const SignCounters start = sign_counters();

  for (int trial = 0; trial < 1000; ++trial) {
    const auto [p, x] = families.draw(test::Family::above_a_vertex);
    sign_past_vertex(x[0], x[1], p);
    // x y - y x: zero, but no products of doubles say so.
    EXPECT_EQ(sign_past_vertex(Vec3::Zero(), Vec3(p.x(), p.y(), 0), Vec3(-p.y(), p.x(), 0)), 0);
  }

  EXPECT_GT(sign_counters().double_double, start.double_double);
  EXPECT_GT(sign_counters().interval, start.interval);
  EXPECT_GT(sign_counters().exact, start.exact);
  EXPECT_EQ(std::fegetround(), before);
  const volatile double one = 1.0;
  EXPECT_EQ(one + 0x1p-53, one);  // what round-to-even does, and no other mode
}

// The bounds of the double filter hold in any mode, and the intervals set their own.
TEST(Signs, AreExactInEveryRoundingModeOfTheCaller) {
  const int before = std::fegetround();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    PointTriangleFamilies families(6);
    for (std::size_t k = 0; k < kFamilies.size(); ++k) {
      int wrong = 0;
      bool kept = true;

      for (int trial = 0; trial < 1000; ++trial) {
        const PointTriangle query = families.draw(kFamilies[k]);
        std::fesetround(mode);
        wrong += wrong_signs(query);
        kept = kept && std::fegetround() == mode;
        std::fesetround(before);
      }

      EXPECT_EQ(wrong, 0) << kFamilyNames[k] << ", mode " << mode;
      EXPECT_TRUE(kept) << kFamilyNames[k] << ", mode " << mode;
    }
  }
}

TEST(SignCounters, CountTheStagesThatWereNeeded) {
  const Vec3 origin = Vec3::Zero();
  SignCounters& counters = sign_counters();
  counters = {};

  sign_past_vertex(origin, Vec3(1, 2, 3), Vec3(3, 2, 1));
  EXPECT_EQ(counters.interval, 0U);
  sign_past_vertex(origin, Vec3(1, 2, 0),
                   Vec3(-2, 1, 0));  // a tie of small integers: the interval is the point 0
  EXPECT_EQ(counters.interval, 1U);
  EXPECT_EQ(counters.exact, 0U);
  sign_past_vertex(origin, Vec3(0.1, 0.3, 0),
                   Vec3(-0.3, 0.1, 0));  // a tie of products that need rounding
  EXPECT_EQ(counters.interval, 2U);
  EXPECT_EQ(counters.exact, 1U);
}

TEST(SignCounters, BelongToTheirThread) {
  sign_counters() = {};

  std::thread([] { sign_past_vertex(Vec3::Zero(), Vec3(0.1, 0.3, 0), Vec3(-0.3, 0.1, 0)); }).join();

  EXPECT_EQ(sign_counters().interval, 0U);
  EXPECT_EQ(sign_counters().exact, 0U);
}

}  // namespace
}  // namespace plekton::geometry::predicates_test

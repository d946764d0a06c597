// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/overlap.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace plekton::contact::structure::overlap_test {
namespace {

using test::Random;

Simplex edge(const Vec3& first, const Vec3& last) {
  return {{first, last, Vec3::Zero()}, 2, {}};
}
Simplex facet(const Vec3& x, const Vec3& y, const Vec3& z) {
  return {{x, y, z}, 3, {}};
}
Edge ends(const Simplex& of, Side side) {
  return {corner(of, 0, side), corner(of, 1, side)};
}
std::optional<EdgeOverFacet> above(const Simplex& a, const Simplex& b) {
  return structure::above(corner(a, 0, Side::a), corner(a, 1, Side::a), corners(b, Side::b));
}
std::optional<EdgeBesideEdge> beside(const Simplex& a, const Simplex& b) {
  return structure::beside(ends(a, Side::a), ends(b, Side::b));
}

/// Whether the slopes of numbers are their derivatives by the corners, where these are not large.
/// @param numbers  of both simplices; none where they are not to be compared
using Numbers = std::function<std::vector<Real>(const Simplex&, const Simplex&)>;
bool have_right_slopes(const Simplex& a, const Simplex& b, const Numbers& numbers) {
  // With slopes up to 10 third derivatives are some 1e4, times the square of the step.
  constexpr double kStep = 1e-6, kSteepest = 10.0, kTolerance = 1e-6;
  const std::vector<Real> now = numbers(a, b);
  for (const Real& number : now)
    if (number.slopes.abs().maxCoeff() > kSteepest) return false;
  for (int variable = 0; variable < 18; ++variable) {
    const auto moved = [&](double way) {
      Simplex other_a = a, other_b = b;
      Simplex& moving = variable < 9 ? other_a : other_b;
      moving.x[static_cast<std::size_t>(variable % 9 / 3)][variable % 3] += way;
      return numbers(other_a, other_b);
    };
    const auto after = moved(kStep), before = moved(-kStep);
    if (after.size() != now.size() || before.size() != now.size()) return false;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double expected = (after[i].value - before[i].value) / (2.0 * kStep);
      EXPECT_NEAR(now[i].slopes[variable], expected, kTolerance) << "number " << i;
    }
  }
  return true;
}

const Simplex kFacet = facet({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

TEST(Above, EndsAtTheSidesAndTellsDistancesFromThePlane) {
  // Over x = 0 after 1 of 8 m, over x + y = 4 after 4 of them.
  for (const double up : {1.0, -1.0}) {
    const auto over = above(edge({-1, 1, 2 * up}, {7, 1, 6 * up}), kFacet);

    ASSERT_TRUE(over.has_value());
    EXPECT_DOUBLE_EQ(over->part.from.value, 0.125);
    EXPECT_DOUBLE_EQ(over->part.to.value, 0.5);
    EXPECT_EQ(over->sides, (std::array{2, 1}));
    EXPECT_DOUBLE_EQ(over->length.value, std::sqrt(80.0));
    EXPECT_DOUBLE_EQ(over->first.value, 2.0);
    EXPECT_DOUBLE_EQ(over->last.value, 6.0);
    EXPECT_DOUBLE_EQ(over->slope.value, 4.0 / std::sqrt(80.0));
    EXPECT_DOUBLE_EQ(over->distance(Real(0.25)).value, 3.0);
  }
}

TEST(Above, IsTheSameOfTurnedFacetsAndFromTheOtherEndOfTheEdge) {
  const auto over = above(edge({7, 1, 6}, {-1, 1, 2}), facet({0, 4, 0}, {4, 0, 0}, {0, 0, 0}));

  ASSERT_TRUE(over.has_value());
  EXPECT_DOUBLE_EQ(over->part.from.value, 0.5);
  EXPECT_DOUBLE_EQ(over->part.to.value, 0.875);
  EXPECT_EQ(over->sides, (std::array{0, 2}));
  EXPECT_DOUBLE_EQ(over->first.value, 6.0);
  EXPECT_DOUBLE_EQ(over->slope.value, -4.0 / std::sqrt(80.0));
}

TEST(Above, TakesTheSideOfThePlaneOnWhichTheMiddleOfThePartIs) {
  // Heights of -2 to 6 m, 0.5 m in the middle of the part.
  const auto through = above(edge({-1, 1, -2}, {7, 1, 6}), kFacet);

  ASSERT_TRUE(through.has_value());
  EXPECT_DOUBLE_EQ(through->first.value, -2.0);
  EXPECT_DOUBLE_EQ(through->last.value, 6.0);
}

TEST(Above, EndsWithTheEdgeWithinTheFacetAndIsNothingBesideIt) {
  const auto within = above(edge({1, 1, 1}, {1, 2, 1}), kFacet);
  ASSERT_TRUE(within.has_value());
  EXPECT_EQ(within->sides, (std::array{-1, -1}));
  EXPECT_EQ(within->part.from.value, 0.0);
  EXPECT_EQ(within->part.to.value, 1.0);

  EXPECT_FALSE(above(edge({-1, 1, 1}, {-1, 2, 1}), kFacet).has_value());
  EXPECT_FALSE(above(edge({5, -1, 1}, {-1, -0.1, 1}), kFacet).has_value());
}

/// Weights of the foot of a point on the plane of a facet.
Vec3 foot_weights(const Vec3& p, const Simplex& of) {
  const Vec3 u = of.x[1] - of.x[0], v = of.x[2] - of.x[0], w = p - of.x[0];
  const Vec3 normal = u.cross(v);
  const double second = w.cross(v).dot(normal) / normal.squaredNorm();
  const double third = u.cross(w).dot(normal) / normal.squaredNorm();
  return {1.0 - second - third, second, third};
}

Simplex random_facet(Random& random) {
  return facet(random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0));
}

TEST(Above, HasThePartOverTheInsideOfTheFacet) {
  Random random(1);
  int over_count = 0, inside_count = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Simplex a = edge(random.in_cube(1.0), random.in_cube(1.0)), b = random_facet(random);
    const auto over = above(a, b);
    over_count += over.has_value();
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0;
      const Vec3 weights = foot_weights(a.x[0] + t * (a.x[1] - a.x[0]), b);
      if (std::abs(weights.minCoeff()) < 1e-9) continue;  // on a side but for rounding
      const bool is_inside = weights.minCoeff() > 0.0;
      ASSERT_EQ(over && over->part.from.value < t && t < over->part.to.value,
                is_inside && 0.0 < t && t < 1.0)
          << trial << ", at " << t;
      inside_count += is_inside;
    }
  }
  EXPECT_GT(over_count, 100);
  EXPECT_GT(inside_count, 500);
}

TEST(Above, HasTheDerivativesByAllCorners) {
  Random random(2);
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Simplex a = edge(random.in_cube(1.0), random.in_cube(1.0)), b = random_facet(random);
    compared += have_right_slopes(a, b, [](const Simplex& x, const Simplex& y) {
      const auto over = above(x, y);
      if (!over) return std::vector<Real>{};
      return std::vector<Real>{over->part.from, over->part.to, over->length,
                               over->first,     over->last,    over->slope};
    });
  }
  EXPECT_GT(compared, 30);
}

TEST(Beside, EndsWhereTheOtherDoesAndKeepsItsDistance) {
  const auto found = beside(edge({-1, 1, 0}, {3, 1, 0}), edge({2, 0, 0}, {0, 0, 0}));

  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->part.from.value, 0.25);
  EXPECT_DOUBLE_EQ(found->part.to.value, 0.75);
  EXPECT_DOUBLE_EQ(found->length.value, 4.0);
  EXPECT_EQ(still(found->separation(Real(0.3))), Vec3(0, 1, 0));
  EXPECT_EQ(found->slope(Real(0.3)).value, 0.0);
  EXPECT_FALSE(beside(edge({-1, 1, 0}, {-3, 1, 0}), edge({2, 0, 0}, {0, 0, 0})).has_value());
}

TEST(Beside, SeparatesTheEdgeFromTheLineOfTheOtherAsFarAsThatGoes) {
  Random random(3);
  int compared = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Simplex a = edge(random.in_cube(1.0), random.in_cube(1.0));
    const Simplex b = edge(random.in_cube(1.0), random.in_cube(1.0));
    const Vec3 along = b.x[1] - b.x[0];
    const auto found = beside(a, b);
    for (int i = 0; i <= 10; ++i) {
      const double t = i / 10.0, h = 1e-5;
      const Vec3 from_b = a.x[0] + t * (a.x[1] - a.x[0]) - b.x[0];
      const double place = from_b.dot(along) / along.squaredNorm();
      const bool is_beside = 0.0 < place && place < 1.0 && i > 0 && i < 10;
      ASSERT_EQ(found && found->part.from.value < t && t < found->part.to.value, is_beside);
      if (!found) continue;
      const Vec3 expected = from_b - place * along;
      ASSERT_NEAR((still(found->separation(Real(t))) - expected).norm(), 0.0, 1e-14) << trial;
      if (expected.norm() < 0.1) continue;
      const auto distance = [&](double at) { return still(found->separation(Real(at))).norm(); };
      // By the square of the step over that of the distance.
      ASSERT_NEAR(found->slope(Real(t)).value,
                  (distance(t + h) - distance(t - h)) / (2.0 * h * found->length.value), 1e-7);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(Beside, HasTheDerivativesByAllCorners) {
  Random random(4);
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Simplex a = edge(random.in_cube(1.0), random.in_cube(1.0));
    const Simplex b = edge(random.in_cube(1.0), random.in_cube(1.0));
    compared += have_right_slopes(a, b, [](const Simplex& x, const Simplex& y) {
      const auto found = beside(x, y);
      if (!found) return std::vector<Real>{};
      const Vector separation = found->separation(found->part.to);
      return std::vector<Real>{found->part.from,
                               found->part.to,
                               found->length,
                               separation.x,
                               separation.y,
                               separation.z,
                               cosine_between(ends(x, Side::a), ends(y, Side::b))};
    });
  }
  EXPECT_GT(compared, 20);
}

TEST(CosineBetween, IsThatOfTheAngleOfLinesWhicheverWayEdgesGo) {
  for (const double degrees : {0.0, 10.0, 25.8, 25.9, 60.0, 90.0, 120.0, 154.1, 154.2, 180.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Edge a = ends(edge({5, 0, 0}, {7, 0, 0}), Side::a);
    const Edge b =
        ends(edge({0, 1, 0}, {3.0 * std::cos(angle), 1, 3.0 * std::sin(angle)}), Side::b);

    EXPECT_NEAR(cosine_between(a, b).value, std::abs(std::cos(angle)), 1e-15) << degrees;
    // The angle of cosine 0.9 is 25.84 degrees.
    EXPECT_EQ(are_along(a, b), degrees < 25.84 || degrees > 180.0 - 25.84) << degrees;
  }
}

TEST(Cut, KeepsWhatIsNotBelow) {
  const auto kept = [](double at_0, double at_1, Interval part) {
    const bool is_left = cut(part, Real(at_0), Real(at_1));
    return is_left ? std::array{part.from.value, part.to.value} : std::array{-1.0, -1.0};
  };
  using Part = std::array<double, 2>;
  constexpr Part kNothing{-1.0, -1.0};

  EXPECT_EQ(kept(1.0, 2.0, {0.0, 1.0}), (Part{0.0, 1.0}));
  EXPECT_EQ(kept(0.0, 2.0, {0.0, 1.0}), (Part{0.0, 1.0}));
  EXPECT_EQ(kept(0.0, 0.0, {0.2, 0.3}), (Part{0.2, 0.3}));
  EXPECT_EQ(kept(-1.0, 3.0, {0.0, 1.0}), (Part{0.25, 1.0}));
  EXPECT_EQ(kept(3.0, -1.0, {0.0, 1.0}), (Part{0.0, 0.75}));
  EXPECT_EQ(kept(-1.0, 3.0, {0.5, 1.0}), (Part{0.5, 1.0})) << "cut before";
  EXPECT_EQ(kept(3.0, -1.0, {0.8, 1.0}), kNothing);
  EXPECT_EQ(kept(-1.0, -3.0, {0.0, 1.0}), kNothing);
}

TEST(Cut, TakesWhatLiesInAPlaneUpToRoundingAsOnItsInnerSide) {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 origin = random.in_cube(1.0), inward = random.direction();
    const Vec3 u = inward.unitOrthogonal(), v = inward.cross(u);
    const auto in_plane = [&](double height) {
      return Vec3(origin + random.uniform(-1.0, 1.0) * u + random.uniform(-1.0, 1.0) * v +
                  height * inward);
    };
    const auto kept = [&](const Vec3& first, const Vec3& last) {
      const Simplex line = edge(first, last), plane = edge(origin, inward);
      const auto vector = [](const Simplex& of, std::size_t i) { return corner(of, i, Side::a); };
      Interval part{0.0, 1.0};
      EXPECT_EQ(lies_in_plane(vector(line, 0), vector(line, 1), vector(plane, 0), vector(plane, 1)),
                std::abs((first - origin).dot(inward)) < 1e-10 &&
                    std::abs((last - origin).dot(inward)) < 1e-10);
      const bool is_left =
          cut(part, vector(line, 0), vector(line, 1), vector(plane, 0), vector(plane, 1));
      return is_left ? part.to.value - part.from.value : 0.0;
    };

    EXPECT_EQ(kept(in_plane(0.0), in_plane(0.0)), 1.0);
    EXPECT_EQ(kept(in_plane(-1e-9), in_plane(-1e-9)), 0.0);
    // Heights of 1e-9 m are rounded by 1e-16 m.
    EXPECT_NEAR(kept(in_plane(-1e-9), in_plane(3e-9)), 0.75, 1e-6);
  }
}

}  // namespace
}  // namespace plekton::contact::structure::overlap_test

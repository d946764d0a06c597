// SPDX-License-Identifier: GPL-3.0-or-later
// A7: a ball dragged over a flat sheet without slip or spin loads one tangential spring all the
// way, F_s = k_s s, over every edge and node that it crosses. Plekton's contact kinematics are
// exact (a = 1 in the notation of anti-ratcheting codes, whose F_s is 1.7 % higher).
#include "tests/support/seeded_random.hpp"
#include "tests/support/sweep_paths.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a07_flat_no_slip_test {
namespace {

using namespace dragged;

constexpr double kNormalTolerance = 1e-9;
constexpr double kTangentialTolerance = 1e-3;
constexpr double kLargestJump = 1.5;  // increments of the tangential force

/// The facet of a flat sheet above which a point is; -1 if there is none.
int facet_under(const ProbedSurface& sheet, const Vec3& point) {
  for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
    int inside = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = sheet.nodes[static_cast<std::size_t>(sheet.facets[f][i])];
      const Vec3& b = sheet.nodes[static_cast<std::size_t>(sheet.facets[f][(i + 1) % 3])];
      inside += (b - a).cross(point - a).z() >= 0.0;
    }
    if (inside == 3) return static_cast<int>(f);
  }
  return -1;
}

struct Crossings {
  int all = 0;
  int lost = 0;  ///< after which half of the tangential force is gone
};

Crossings count_crossings(const ProbedSurface& sheet, std::span<const Vec3> path,
                          std::span<const Felt> felt) {
  const auto tangential = [&](std::size_t k) { return felt[k].force.head<2>().norm(); };
  Crossings crossings;
  for (std::size_t k = 20; k < path.size(); ++k) {
    if (facet_under(sheet, path[k]) == facet_under(sheet, path[k - 1])) continue;
    ++crossings.all;
    crossings.lost += tangential(std::min(k + 4, path.size() - 1)) < 0.5 * tangential(k - 2);
  }
  return crossings;
}

/// Drags the ball along a straight path over a flat sheet. @returns what was crossed
Crossings expect_one_spring(const ProbedSurface& sheet, std::span<const Vec3> path) {
  ContactProbe probe(sheet, kSphereRadius, no_slip());
  const auto felt = sweep(probe, path);
  double worst_normal = 0.0;
  double worst_tangential = 0.0;
  double worst_balance = 0.0;
  for (std::size_t k = 1; k < felt.size(); ++k) {
    const Vec3 spring = -kTangentialStiffness * (path[k] - path[0]);
    const Vec3 tangential(felt[k].force.x(), felt[k].force.y(), 0.0);
    worst_normal = std::max(worst_normal, std::abs(felt[k].force.z() / kNormalForce - 1.0));
    worst_tangential = std::max(worst_tangential, (tangential - spring).norm() / spring.norm());
    const double size = felt[k].force.norm();
    worst_balance =
        std::max({worst_balance, felt[k].force_residual / size, felt[k].moment_residual / size});
    EXPECT_EQ(felt[k].contacts, 1u) << "step " << k;
  }
  EXPECT_LE(worst_normal, kNormalTolerance);
  EXPECT_LE(worst_tangential, kTangentialTolerance);
  EXPECT_LE(worst_balance, 1e-13);  // round-off of forces at distances of up to 2 m
  const double increment = kTangentialStiffness * (path[1] - path[0]).norm();
  EXPECT_LE(largest_jump(felt), kLargestJump * increment);
  return count_crossings(sheet, path, felt);
}

TEST(A07FlatNoSlip, OneSpringIsLoadedAllTheWayOverAStrip) {
  const auto path = line(Vec3(-0.80137, -0.08, kDistance), Vec3(0.80137, 0.04, kDistance), 7993);

  const Crossings crossings = expect_one_spring(folded_strip(0.0), path);

  EXPECT_GE(crossings.all, 5);
  EXPECT_EQ(crossings.lost, 0);
}

/// Delaunay triangulation of points in a square and its corners, by the definition: the triples
/// whose circumcircle holds no other point.
ProbedSurface random_sheet(Random& random) {
  ProbedSurface sheet;
  sheet.radius = kSurfaceRadius;
  for (int i = 0; i < 60; ++i) {
    const double x = random.uniform(-1.2, 1.2);
    sheet.nodes.push_back(Vec3(x, random.uniform(-1.2, 1.2), 0.0));
  }
  for (const double x : {-1.3, 1.3}) {
    for (const double y : {-1.3, 1.3}) sheet.nodes.push_back(Vec3(x, y, 0.0));
  }
  const auto& p = sheet.nodes;
  for (std::size_t a = 0; a < p.size(); ++a) {
    for (std::size_t b = a + 1; b < p.size(); ++b) {
      for (std::size_t c = b + 1; c < p.size(); ++c) {
        const Vec3 u = p[b] - p[a];
        const Vec3 v = p[c] - p[a];
        const double twice_area = u.cross(v).z();
        const Vec3 to_centre = Vec3(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                                    u.x() * v.squaredNorm() - v.x() * u.squaredNorm(), 0.0) /
                               (2.0 * twice_area);
        const bool is_empty = std::all_of(p.begin(), p.end(), [&](const Vec3& q) {
          return &q == &p[a] || &q == &p[b] || &q == &p[c] ||
                 (q - p[a] - to_centre).squaredNorm() > to_centre.squaredNorm();
        });
        if (!is_empty) continue;
        const std::array<int, 3> facet{static_cast<int>(a), static_cast<int>(b),
                                       static_cast<int>(c)};
        sheet.facets.push_back(twice_area > 0.0 ? facet : std::array{facet[0], facet[2], facet[1]});
      }
    }
  }
  return sheet;
}

struct Line {
  double y;      // m, where it begins, at x = -0.9 m
  double angle;  // rad, to the x axis
};
constexpr std::array<Line, 3> kLines{{{-0.35, 0.13}, {0.02, -0.21}, {0.4, 0.31}}};

void expect_no_history_lost_over_random_sheets(int sheets, int steps, int crossings_at_least) {
  Random random(11);
  Crossings total;
  for (int i = 0; i < sheets; ++i) {
    const ProbedSurface sheet = random_sheet(random);
    ASSERT_EQ(sheet.facets.size(), 2u * 64u - 2u - 4u);  // Euler: 64 points, 4 of them on the hull
    for (const auto& [y, angle] : kLines) {
      const Vec3 from(-0.9, y, kDistance);
      const Vec3 way(1.8 * std::cos(angle), 1.8 * std::sin(angle), 0.0);
      const Crossings crossings = expect_one_spring(sheet, line(from, from + way, steps));
      total.all += crossings.all;
      total.lost += crossings.lost;
    }
  }
  EXPECT_GE(total.all, crossings_at_least);
  EXPECT_EQ(total.lost, 0) << "of " << total.all;
}

TEST(A07FlatNoSlip, NoCrossingOfARandomDelaunaySheetLosesTheSpring) {
  expect_no_history_lost_over_random_sheets(5, 4000, 5 * 32);
}

TEST(A07FlatNoSlip, NoCrossingOfARandomDelaunaySheetLosesTheSpringInFinerSteps) {
  expect_no_history_lost_over_random_sheets(1, 16000, 32);
}

}  // namespace
}  // namespace plekton::test::a07_flat_no_slip_test

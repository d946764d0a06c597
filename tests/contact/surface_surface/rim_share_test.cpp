// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/rim_share.hpp"

#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

/// Sheets in one plane, rim to rim. k = 1 N/m: a force over the overlap is a number of contacts.
namespace plekton::test::rim_share_test {
namespace {

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.02;
constexpr double kSide = 0.4;
constexpr double kBeside = kSide + kRange - kOverlap;  // m, from middle to middle

Body square(int cells) {
  return sheet(cells, cells, kSide, kSide, Cut::alternating);
}

TEST(Rims, OfSheetsInOnePlanePushAsOneContact) {
  for (const int cells : {1, 2, 3}) {
    for (const double along : {0.0, 0.013, -0.17}) {
      for (const double turn : {0.0, 0.1}) {
        const Body b = square(2);
        StructurePair pair(square(cells), b, kRange);
        // Turned about its nearest corner.
        const double corner =
            turn > 0.0 ? 0.5 * kSide * (std::cos(turn) + std::sin(turn)) : 0.5 * kSide;
        const double x = 0.5 * kSide + kRange - kOverlap + corner;

        pair.place(moved(b, {0.0, 0.0, turn}, {x, along, 0.0}));

        EXPECT_NEAR(pair.force_on_b().x(), kOverlap, 1e-9 * kOverlap)
            << cells << ' ' << along << ' ' << turn;
        EXPECT_LE(pair.force_on_b().tail<2>().norm(), 1e-9 * kOverlap);
        EXPECT_NEAR(pair.energy(), 0.5 * kOverlap * kOverlap, 1e-9 * kOverlap * kOverlap);
      }
    }
  }
}

TEST(Rims, PushAgainstTheGradientOfTheirEnergy) {
  Random random(1);
  for (int place = 0; place < 20; ++place) {
    Body a = square(2), b = square(2);
    const double shake = 0.1 * kOverlap;
    for (Vec3& x : a.x) x += random.in_cube(shake);
    for (Vec3& x : b.x) x += random.in_cube(shake);
    b = moved(b,
              {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.2, 0.2)},
              {kBeside, random.uniform(-0.1, 0.1), random.uniform(-0.3, 0.3) * kRange});
    StructurePair pair(a, b, kRange);
    EXPECT_LT(worst_gradient_error(pair, b, 1e-7), 1e-5) << place;
  }
}

// From above each other to beside each other, down a slope: energies that change in proportion to
// the way.
TEST(Rims, SetInWithoutAJumpAsASheetSlidesOffAnother) {
  for (const int steps : {1000, 10000}) {
    const Body b = square(2);
    StructurePair pair(square(3), b, kRange);
    double before = 0.0, largest = 0.0, most = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double way = static_cast<double>(i) / steps;
      pair.place(moved(b, {0.0, 0.0, 0.0}, {kSide - 0.05 + way * 0.1, 0.01, 0.06 - 0.03 * way}));
      if (i > 0) largest = std::max(largest, std::abs(pair.energy() - before));
      before = pair.energy();
      most = std::max(most, before);
    }
    EXPECT_LT(largest, 20.0 / steps * most) << steps;
  }
}

}  // namespace
}  // namespace plekton::test::rim_share_test

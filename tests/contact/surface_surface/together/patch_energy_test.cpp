// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_patches.hpp"
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

/// A plate with 4 x 4 holes, of squares a third as wide as it is thick, on one sheet: each hole takes
/// a contact away that the little area around it does not bring. k = 1 N/m.
namespace plekton::test::patch_energy_test {
namespace {

constexpr double kRange = 0.3;   // m
constexpr double kSquare = 0.1;  // m
constexpr int kSquares = 9;      // along a side

Body perforated() {
  Body body;
  std::map<std::pair<int, int>, int> nodes;
  const auto node = [&](int i, int j) {
    const auto [at, is_new] = nodes.try_emplace({i, j}, static_cast<int>(body.x.size()));
    if (is_new)
      body.x.emplace_back((i - 0.5 * kSquares) * kSquare, (j - 0.5 * kSquares) * kSquare, 0.0);
    return at->second;
  };
  for (int j = 0; j < kSquares; ++j) {
    for (int i = 0; i < kSquares; ++i) {
      if (i % 2 == 1 && j % 2 == 1) continue;
      body.facets.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      body.facets.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  return body;
}

Body ground() {
  return sheet(1, 1, 3.0, 3.0);
}

/// J, largest of what the facets of a body store on the ground, each by itself.
double most_of_a_facet(const Body& body) {
  double most = 0.0;
  for (const std::array<int, 3>& facet : body.facets) {
    Body alone;
    for (const int corner : facet) alone.x.push_back(body.x[static_cast<std::size_t>(corner)]);
    alone.facets = {{0, 1, 2}};
    StructurePair pair(ground(), alone, kRange);
    pair.place(alone);
    most = std::max(most, pair.energy());
  }
  return most;
}

// The terms add up to less than nothing in two of these places, where the plate is tilted by about as
// much as it overlaps.
TEST(PatchEnergy, OfAPlateWithFineHolesIsAtLeastHalfOfThatOfAnyFacetAndPushesItAway) {
  for (const double overlap : {1e-4, 1e-3, 0.01, 0.05}) {
    for (const double tilt : {0.0, 1e-3, 0.01, 0.1}) {
      const double lift = 0.5 * kSquares * kSquare * std::sin(tilt);  // of its middle over its edge
      const Body b = moved(perforated(), {tilt, 0.0, 0.0}, {0.01, 0.02, kRange - overlap + lift});
      StructurePair pair(ground(), b, kRange);
      pair.place(b);

      const double most = most_of_a_facet(b);
      EXPECT_GT(most, 0.0);
      EXPECT_GE(pair.energy(), 0.5 * most * (1.0 - 1e-9)) << overlap << ' ' << tilt;
      EXPECT_GT(pair.force_on_b().z(), 0.0) << overlap << ' ' << tilt;
      EXPECT_LE((pair.force_on_a() + pair.force_on_b()).norm(), 1e-12 * overlap);
    }
  }
}

TEST(PatchEnergy, OfAPlateWithFineHolesHasTheForcesAsItsGradient) {
  Random random(7);
  for (int place = 0; place < 2; ++place) {
    Body b = perforated();
    for (Vec3& x : b.x) x += random.in_cube(0.003);
    b = moved(b, {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0.3},
              {0.01, 0.02, 0.95 * kRange});
    StructurePair pair(ground(), b, kRange);
    EXPECT_LT(worst_gradient_error(pair, b, 1e-7, 3), 1e-4) << place;
  }
}

// An invariant: the sum of the terms is not below nothing in these places either.
TEST(PatchEnergy, OfSheetsThatCrossIsNeverLessThanNothing) {
  Random random(11);
  for (int place = 0; place < 200; ++place) {
    const Body b =
        moved(sheet(3, 3, 0.6, 0.6, Cut::alternating),
              {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 0.0}, random.in_cube(0.2));
    StructurePair pair(sheet(3, 3, 0.6, 0.6), b, kRange);

    pair.place(b);

    EXPECT_GE(pair.energy(), 0.0) << place;
  }
}

}  // namespace
}  // namespace plekton::test::patch_energy_test

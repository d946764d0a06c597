// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dmt_adhesion.hpp"
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/structure_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

/// Structures that attract each other where they touch.
namespace plekton::test::structure_attraction_test {
namespace {

using contact::DmtAdhesion;
using StructurePair = StructurePairUnder<DmtAdhesion>;

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.006;
/// J/m²: an attraction of 2 pi w R = 3e-4 N, a fifth of what a contact pushes at kOverlap. R is
/// the radius of both, as of crossed rims.
constexpr double kWork = 1e-3;
constexpr double kAttraction = 2.0 * std::numbers::pi * kWork * 0.5 * kRange;

/// The body at a turn (rad) about all axes, its lowest node kOverlap deep in the plane z = 0.
Body laid(const Body& body, const Vec3& turns, const Vec3& shift) {
  Body placed = moved(body, turns, shift);
  double lowest = placed.x[0].z();
  for (const Vec3& x : placed.x) lowest = std::min(lowest, x.z());
  for (Vec3& x : placed.x) x.z() += kRange - kOverlap - lowest;
  return placed;
}

TEST(StructureAttraction, IsOnePerContactOfASquareThatLiesFlat) {
  const double side = 0.8;
  const double contacts = side * side / (kRange * kRange);
  const Body a = sheet(3, 3, 2.0, 2.0, Cut::alternating);
  const Body b = sheet(2, 2, side, side);
  StructurePair with(a, b, kRange, {kWork}), without(a, b, kRange, {0.0});

  with.place(laid(b, {0, 0, 0.3}, {0.11, 0.07, 0}));
  without.place(laid(b, {0, 0, 0.3}, {0.11, 0.07, 0}));

  EXPECT_NEAR(with.force_on_b().z() - without.force_on_b().z(), -contacts * kAttraction,
              1e-6 * contacts * kAttraction);
  EXPECT_NEAR(with.energy() - without.energy(), -contacts * kAttraction * kOverlap,
              1e-6 * contacts * kAttraction * kOverlap);
}

/// From parallel to steep, sheets and chains: what moves the count of contacts is in the forces.
TEST(StructureAttraction, PushesAgainstTheGradientOfItsEnergy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 40; ++k) {
    const double tilt = k % 4 == 0 ? 0.0 : k % 4 == 1 ? 1e-4 : k % 4 == 2 ? 2e-3 : 0.3;
    const Body a = k % 2 == 0 ? sheet(3, 2, 1.3, 1.0, Cut::alternating) : chain(4, 1.3);
    const Body b = laid(k % 3 == 0 ? chain(3, 0.9) : sheet(2, 3, 0.8, 0.9, Cut::one_way, 5),
                        {tilt * u(random), tilt * u(random), u(random)},
                        {0.1 * u(random), 0.02 * u(random), 0.0});
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      direction.emplace_back(u(random), u(random), u(random));
    StructurePair structure_pair(a, b, kRange, {kWork});
    // A straight chain is where a wrap sets in (contact/counting/wrap.hpp): with the square
    // of the bend on one side only, which differences see as a slope in proportion to the step.
    const Slope slope = slope_along(structure_pair, b, direction, 2e-9);
    EXPECT_NEAR(slope.power, -slope.change, 2e-5 * slope.scale) << k;
  }
}

}  // namespace
}  // namespace plekton::test::structure_attraction_test

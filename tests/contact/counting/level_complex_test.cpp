// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/level_complex.hpp"

#include "contact/counting/cycle_weights.hpp"
#include "contact/sphere_surface/near_complex.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::level_complex_test {
namespace {

/// W and slope by vertex, for springs of 1 N/m.
std::vector<std::array<double, 2>> weights_of(const LevelComplex& complex, double range) {
  std::vector<double> energies;
  for (const double d : complex.distances()) energies.push_back(0.5 * (range - d) * (range - d));
  CycleWeights cycles;
  std::vector<std::array<double, 2>> weights(energies.size(), {0.0, 0.0});
  for (const CycleWeights::Share& of : cycles.find(complex, range, energies))
    weights[of.vertex] = {of.weight, of.slope};
  return weights;
}

TEST(LevelComplex, SharesRingsAlikeWhereLinksAreMerged) {
  Random random(1);
  std::size_t merged = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Complex complex =
        trial % 2 == 0 ? plate_with_hole(9, 0.5, 3.0) : roughened(sheet(4), 1.0, 0.3, random);
    const Surface surface = complex.surface();
    const Vec3 point = trial % 2 == 0 ? Vec3(0.05 * random.unit(), 0.04 * random.unit(), 0.8)
                                      : Vec3(2.0, 2.0, 0.3) + random.in_cube(0.5);
    NearComplex near;
    near.build(surface, point, 1.0, all_cells(surface), complex.x);
    LevelComplex levels = near.levels();
    levels.merge_links();
    merged += near.levels().links().size() - levels.links().size();
    const auto before = weights_of(near.levels(), 1.0);
    const auto after = weights_of(levels, 1.0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_NEAR(after[i][0], before[i][0], 1e-9) << trial;
      ASSERT_NEAR(after[i][1], before[i][1], 1e-8) << trial;
    }
  }
  EXPECT_GT(merged, 100u);
}

}  // namespace
}  // namespace plekton::test::level_complex_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/near_complex.hpp"

#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

namespace plekton::test::near_complex_test {
namespace {

std::uint32_t count_below(const NearComplex& complex, double level) {
  const auto feet = complex.vertices();
  return static_cast<std::uint32_t>(std::count_if(
      feet.begin(), feet.end(), [&](const auto& foot) { return foot.distance < level; }));
}

int pieces(const NearComplex& complex, double level) {
  const std::uint32_t below = count_below(complex, level);
  std::vector<std::uint32_t> root(below);
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  int count = static_cast<int>(below);
  for (const Link& link : complex.levels().links()) {
    if (link.a >= below || find(link.a) == find(link.b)) continue;
    root[find(link.a)] = find(link.b);
    --count;
  }
  return count;
}

Complex surface_of_kind(int kind, Random& random) {
  switch (kind) {
    case 0:
      return roughened(sheet(4), 1.0, 0.3, random);
    case 1:
      return sheet_with_fin(0.2, random);
    case 2:
      return roughened(net(4), 1.0, 0.2, random);
    case 3:
      return plate_with_hole(7, 1.0, 3.0);
    case 4:
      return junction(5, random);
    case 5:
      return mapped(roughened(ball(1), 0.5, 0.2, random),
                    [](const Vec3& x) { return Vec3(0.5 * x); });
    default:
      return random_complex(random, false);
  }
}

TEST(NearComplex, HasThePiecesOfTheSurfaceAtEveryLevel) {
  Random random(1);
  for (int trial = 0; trial < 280; ++trial) {
    const Complex complex = surface_of_kind(trial % 7, random);
    const Surface surface = complex.surface();
    const auto cells = all_cells(surface);
    const auto nodes = cell_nodes(surface);
    const Vec3 point = complex.x[random.index(complex.x.size())] + random.in_cube(1.0);
    NearComplex near;
    near.build(surface, point, 2.0, cells, complex.x);
    for (int k = 0; k < 20; ++k) {
      const double level = random.uniform(0.0, 2.0);
      const auto expected =
          reference_contact(point, level, nodes, complex.x, [](double overlap) { return overlap; });
      ASSERT_EQ(pieces(near, level), expected.components);
    }
  }
}

TEST(NearComplex, HasTheHolesThatTheCriticalFeaturesCountAtEveryLevel) {
  constexpr int kClosed = 5, kAny = 6;  // kinds that may have hollows
  Random random(2);
  std::size_t holes_seen = 0;
  for (int trial = 0; trial < 280; ++trial) {
    const int kind = trial % 7;
    const Complex complex = surface_of_kind(kind, random);
    const Surface surface = complex.surface();
    const auto cells = all_cells(surface);
    const Vec3 point = complex.x[random.index(complex.x.size())] + random.in_cube(1.0);
    NearComplex near;
    near.build(surface, point, 2.0, cells, complex.x);
    CriticalFeatureFinder critical(surface);
    CycleBasis rings;
    rings.build(static_cast<std::uint32_t>(near.vertices().size()), near.levels().links(),
                near.levels().fillings());
    for (int k = 0; k < 20; ++k) {
      const double level = random.uniform(0.0, 2.0);
      int sum = 0;
      for (const CriticalFeature& feature : critical.find(point, level, cells, complex.x))
        sum += feature.coefficient;
      const std::uint32_t below = count_below(near, level);
      const std::size_t holes = rings.hole_count({below, below});
      // Coefficients count pieces minus holes plus hollows.
      const int hollows = sum - pieces(near, level) + static_cast<int>(holes);
      ASSERT_GE(hollows, 0);
      if (kind != kClosed && kind != kAny) {
        ASSERT_EQ(hollows, 0);
      }
      holes_seen += holes;
    }
  }
  EXPECT_GT(holes_seen, 100U);
}

}  // namespace
}  // namespace plekton::test::near_complex_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/product_complex.hpp"

#include "tests/support/hollow_ball.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/structure_rule_reference.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>

namespace plekton::test::product_complex_test {
namespace {

using contact::structure::ProductComplex;

/// All pairs of cells nearer than a range.
struct Near {
  std::vector<Vec3> x;
  std::deque<geometry::FeatureNodes> nodes;
  std::deque<geometry::CoreProximity> cores;
  std::vector<ProductComplex::CellPair> pairs;

  Near(const Body& a, const Body& b, double range) : x(a.x) {
    x.insert(x.end(), b.x.begin(), b.x.end());
    for (const NodeList& cell_a : cells_of(a)) {
      for (const NodeList& cell_b : cells_of(b)) {
        const auto found = geometry::core_proximity(core(cell_a, a.x), core(cell_b, b.x));
        if (!(found.signed_distance < range)) continue;
        cores.push_back(found);
        const auto* const of_a = &nodes.emplace_back(named(cell_a, 0));
        const auto* const of_b = &nodes.emplace_back(named(cell_b, static_cast<int>(a.x.size())));
        pairs.push_back({of_a, of_b, &cores.back()});
      }
    }
  }
  static geometry::Core core(const NodeList& cell, const std::vector<Vec3>& x) {
    geometry::Core result;
    for (const int node : cell) result.x[result.count++] = x[static_cast<std::size_t>(node)];
    return result;
  }
  static geometry::FeatureNodes named(const NodeList& cell, int first) {
    geometry::FeatureNodes result{{NodeId{0}, NodeId{0}, NodeId{0}}, 0};
    for (const int node : cell) result.ids[result.count++] = NodeId{first + node};
    return result;
  }
};

int pieces(const contact::LevelComplex& levels, double level) {
  const auto distances = levels.distances();
  const auto below = static_cast<std::uint32_t>(
      std::lower_bound(distances.begin(), distances.end(), level) - distances.begin());
  std::vector<std::uint32_t> root(below);
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  int count = static_cast<int>(below);
  for (const contact::Link& link : levels.links()) {
    if (link.a >= below || find(link.a) == find(link.b)) continue;
    root[find(link.a)] = find(link.b);
    --count;
  }
  return count;
}

TEST(ProductComplex, HasThePiecesOfTheRegionOfContactAtEveryLevel) {
  Random random(1);
  const Body net = square_net_of(2, 0.15);
  const Body flat = sheet(2, 2, 0.5, 0.5, Cut::alternating, 3);
  for (int trial = 0; trial < 30; ++trial) {
    Body b = moved(trial % 2 == 0 ? net : flat, random.in_cube(0.3),
                   Vec3(0.0, 0.0, 0.1) + random.in_cube(0.05));
    for (Vec3& x : b.x) x += random.in_cube(0.02);
    const Body& a = trial % 3 == 0 ? flat : net;
    const Near near(a, b, 0.15);
    ProductComplex complex;
    complex.build(near.pairs, 0.15, near.x);
    for (int k = 0; k < 8; ++k) {
      const double level = random.uniform(0.0, 0.15);
      ASSERT_EQ(pieces(complex.levels(), level), reference_pieces(a, b, level).components)
          << trial << ' ' << level;
    }
  }
}

TEST(ProductComplex, KnowsWhichPairsHaveAPlace) {
  const Body net = square_net_of(2, 0.15);
  const Body other = moved(net, {0.0, 0.0, 0.5}, {0.01, 0.02, 0.08});
  const Near near(net, other, 0.1);
  ProductComplex complex;
  complex.build(near.pairs, 0.1, near.x);
  for (std::uint32_t pair = 0; pair < near.pairs.size(); ++pair) {
    const std::uint32_t vertex = complex.vertex_of(*near.pairs[pair].a, *near.pairs[pair].b);
    ASSERT_NE(vertex, ProductComplex::kNone);
    const auto holders = complex.holders(vertex);
    EXPECT_TRUE(std::binary_search(holders.begin(), holders.end(), pair));
    EXPECT_EQ(complex.levels().distances()[vertex], near.cores[pair].signed_distance);
  }
}

}  // namespace
}  // namespace plekton::test::product_complex_test

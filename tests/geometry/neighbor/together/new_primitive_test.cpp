// SPDX-License-Identifier: GPL-3.0-or-later
// A primitive that the library has never seen goes the way of its own: boxes, tree, certified
// nearest points.
#include "geometry/neighbor/broad_phase.hpp"
#include "geometry/primitives/cylinder.hpp"
#include "geometry/primitives/facet.hpp"
#include "geometry/primitives/sphere.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/exact_pair.hpp"
#include "tests/support/strut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace plekton::geometry::new_primitive_test {
namespace {

using test::Complex;
using test::Random;
using test::Strut;

/// The corners that span a feature of a probe.
unsigned witness_features_of(const Feature& feature) {
  if (feature.kind == FeatureKind::face) return 7U;
  if (feature.kind == FeatureKind::node) return 1U << feature.id;
  return feature.id == 0 ? 3U : feature.id == 1 ? 6U : 5U;
}

/// Judged in exact arithmetic, for the corners as they are rounded.
void expect_true(const Probe& a, const Probe& b, const Proximity& p) {
  const test::ExactPair pair(a.core.corners(), b.core.corners());
  const auto feet = pair.feet(witness_features_of(p.a.feature), witness_features_of(p.b.feature));
  ASSERT_TRUE(feet.has_value());
  EXPECT_TRUE(pair.are_nearest(*feet));
  const double distance = static_cast<double>(pair.distance(*feet));
  EXPECT_EQ(p.relation == Relation::touching_or_crossing, distance == 0.0);
  if (p.relation == Relation::touching_or_crossing) return;
  EXPECT_NEAR(p.gap, distance - a.radius - b.radius, 1e-12 * distance + 1e-16);
}

struct Model {
  Complex complex;
  std::vector<Strut> struts;
};

Model random_model(Random& random) {
  Model model{test::sheet(4), {}};
  for (int k = 0; k < 40; ++k) {
    const Vec3 x0 = Vec3(2, 2, 0) + Vec3(random.in_cube(2.0).cwiseProduct(Vec3(1, 1, 0.2)));
    const int a = model.complex.node(x0);
    const int b = model.complex.node(x0 + random.in_cube(1.5));
    model.struts.push_back({{NodeId{a}, NodeId{b}}, random.uniform(0.05, 0.2)});
  }
  return model;
}

TEST(NewPrimitive, HasCertifiedNearestPointsWithEveryPrimitive) {
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<Vec3> x;
    for (int n = 0; n < 5; ++n)
      x.push_back(trial % 2 == 0 ? random.on_lattice(0, 3) : Vec3(random.in_cube(1.0)));
    const Strut strut{{NodeId{0}, NodeId{1}}, 0.1};
    const auto check = [&](const auto& other) {
      expect_true(probe_of(strut, x), probe_of(other, x), proximity(strut, other, x));
    };
    check(Sphere{{NodeId{2}}, 0.2});
    check(Cylinder{{NodeId{2}, NodeId{3}}, 0.2});
    check(Facet{{NodeId{2}, NodeId{3}, NodeId{4}}, 0.2});
    check(Strut{{NodeId{2}, NodeId{3}}, 0.2});
  }
}

TEST(NewPrimitive, MeetsTheFacetsOfASurface) {
  Random random(4);
  const Model model = random_model(random);
  const Surface surface = model.complex.surface();
  const Positions x = model.complex.x;
  for (const Strut& strut : model.struts) {
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      const CellId cell = id_at<CellId>(c);
      const Proximity p = proximity(strut, surface, cell, x);
      // Of the facet by itself, whose corners it takes in another order: the gap to round-off.
      EXPECT_NEAR(p.gap, proximity(strut, model.complex.facets[c], x).gap, 1e-11);
    }
  }
}

TEST(NewPrimitive, IsFoundByTheBroadPhaseWhereItIsNear) {
  constexpr double kLargestGap = 0.1;  // m
  Random random(5);
  const Model model = random_model(random);
  const Positions x = model.complex.x;
  std::vector<Box> struts;
  for (const Strut& strut : model.struts) struts.push_back(box(strut, x, 0.5 * kLargestGap));
  std::vector<Box> facets;
  for (const Facet& facet : model.complex.facets)
    facets.push_back(box(facet, x, 0.5 * kLargestGap));
  BroadPhase of_struts;
  of_struts.rebuild(struts);
  BroadPhase of_facets;
  of_facets.rebuild(facets);
  std::vector<IndexPair> listed;
  of_struts.pairs_with(of_facets, listed);

  std::size_t near = 0;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    for (std::size_t k = 0; k < facets.size(); ++k) {
      if (!(proximity(model.struts[i], model.complex.facets[k], x).gap < kLargestGap)) continue;
      ++near;
      const IndexPair pair{static_cast<std::int32_t>(i), static_cast<std::int32_t>(k)};
      EXPECT_TRUE(std::binary_search(listed.begin(), listed.end(), pair));
    }
  }
  EXPECT_GT(near, 10U);
  EXPECT_LT(listed.size(), struts.size() * facets.size() / 2);
}

TEST(NewPrimitive, HasTheSameProximityFromBothSides) {
  Random random(6);
  const Model model = random_model(random);
  const Positions x = model.complex.x;
  for (const Strut& strut : model.struts) {
    for (const Facet& facet : model.complex.facets) {
      const Proximity p = proximity(probe_of(strut, x), probe_of(facet, x));
      const Proximity q = proximity(probe_of(facet, x), probe_of(strut, x));
      // Distances are equal; the radii are taken off in another order, below 8 m.
      EXPECT_NEAR(p.gap, q.gap, 8.0 * std::numeric_limits<double>::epsilon());
      EXPECT_EQ(p.normal, -q.normal);
      EXPECT_EQ(p.a.weights, q.b.weights);
      EXPECT_EQ(p.b.feature, q.a.feature);
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::new_primitive_test

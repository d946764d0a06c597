// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/surface_change.hpp"

#include "tests/support/complexes.hpp"
#include "tests/support/same_incidence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace plekton::geometry::surface_change_test {
namespace {

using test::Complex;
using test::Random;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Two facets 0 1 2 and 2 1 3 with a cylinder 3 4 behind them.
Complex kite() {
  Complex kite;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0)})
    kite.node(x);
  kite.facet(0, 1, 2);
  kite.facet(2, 1, 3);
  kite.cylinder(3, 4);
  return kite;
}

Feature edge_between(const Surface& surface, int a, int b) {
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    if (surface.nodes_of(id_at<EdgeId>(e)) == std::array{NodeId{a}, NodeId{b}})
      return Feature(id_at<EdgeId>(e));
  }
  return {};
}

TEST(SurfaceChange, FindsTheFeaturesThatAreLeftAndNoOthers) {
  Complex complex = kite();
  const Surface before = complex.surface();
  complex.facets.erase(complex.facets.begin());
  const Surface after = before.left_with(complex.cylinders, complex.facets);
  const SurfaceChange change(before, after);

  EXPECT_FALSE(change.now(Feature(FaceId{0})));
  EXPECT_EQ(change.now(Feature(FaceId{1})), Feature(FaceId{0}));
  EXPECT_FALSE(change.now(edge_between(before, 0, 1)));
  EXPECT_EQ(change.now(edge_between(before, 1, 2)), edge_between(after, 1, 2));
  EXPECT_EQ(change.now(edge_between(before, 3, 4)), edge_between(after, 3, 4));
  EXPECT_FALSE(change.now(Feature(NodeId{0})));
  EXPECT_EQ(change.now(Feature(NodeId{1})), Feature(NodeId{1}));
  EXPECT_FALSE(change.now(CellId{0}));
  EXPECT_THAT(change.left_of(CellId{0}), IsEmpty());
  EXPECT_EQ(change.now(CellId{1}), CellId{0});
  EXPECT_EQ(change.now(CellId{2}), CellId{1});
}

/// From the second facet and the cylinder to both facets: what is kept has other numbers, what has
/// come has none before.
TEST(SurfaceChange, FindsTheFeaturesThatStayWhereOthersCome) {
  const Complex complex = kite();
  const Surface all = complex.surface();
  const std::array second{complex.facets[1]};
  const Surface before = all.left_with(complex.cylinders, second);
  const Surface after = all.left_with({}, complex.facets);
  const SurfaceChange change(before, after);

  EXPECT_EQ(change.now(Feature(FaceId{0})), Feature(FaceId{1}));
  EXPECT_EQ(change.now(edge_between(before, 2, 3)), edge_between(after, 2, 3));
  EXPECT_FALSE(change.now(edge_between(before, 3, 4)));
  EXPECT_EQ(change.now(Feature(NodeId{3})), Feature(NodeId{3}));
  EXPECT_FALSE(change.now(Feature(NodeId{4})));
  EXPECT_EQ(change.now(CellId{0}), CellId{1});
}

TEST(SurfaceChange, LeavesTheSidesOfATornFacetThatHaveCylinders) {
  Complex complex = kite();
  const Surface before = complex.surface();
  complex.facets.clear();
  complex.cylinder(1, 0);
  complex.cylinder(1, 3);
  const Surface after = before.left_with(complex.cylinders, complex.facets);
  const SurfaceChange change(before, after);

  EXPECT_THAT(change.left_of(CellId{0}), ElementsAre(CellId{0}));
  EXPECT_THAT(change.left_of(CellId{1}), ElementsAre(CellId{1}));
  EXPECT_THAT(change.left_of(CellId{2}), ElementsAre(CellId{2}));
  EXPECT_EQ(after.feature_of(CellId{0}), edge_between(after, 0, 1));
  EXPECT_EQ(after.structure_of(NodeId{2}), StructureId{-1});
}

TEST(SurfaceChange, PiecesKeepTheNumberAndTheRadiusOfTheirStructure) {
  Complex complex;
  for (int i = 0; i < 4; ++i) complex.node(Vec3(i, 0, 0));
  for (int i = 0; i < 2; ++i) complex.node(Vec3(i, 1, 0));
  for (int i = 0; i < 3; ++i) complex.cylinder(i, i + 1);
  complex.cylinder(4, 5);
  const Surface before = complex.surface();

  complex.cylinders.erase(complex.cylinders.begin() + 1);
  const Surface pieces = before.left_with(complex.cylinders, {});
  EXPECT_EQ(pieces.structure_of(NodeId{0}), pieces.structure_of(NodeId{3}));
  EXPECT_EQ(pieces.structure_count(), 2U);

  const Surface other = pieces.left_with(std::span(complex.cylinders).last(1), {});
  EXPECT_EQ(other.structure_count(), 2U);
  EXPECT_EQ(other.structure_of(NodeId{0}), StructureId{-1});
  EXPECT_EQ(other.structure_of(NodeId{4}), StructureId{1});
  EXPECT_EQ(other.radius(StructureId{0}), 0.1);
}

TEST(SurfaceChange, TheSurfaceThatIsLeftTakesNothingNew) {
  Complex complex = kite();
  const Surface surface = complex.surface();

  Complex more = complex;
  more.cylinder(0, 4);
  EXPECT_THROW(surface.left_with(more.cylinders, more.facets), std::invalid_argument);
  more = complex;
  more.cylinder(0, 99);
  EXPECT_THROW(surface.left_with(more.cylinders, more.facets), std::invalid_argument);
  more = complex;
  std::swap(more.facets[0], more.facets[1]);
  EXPECT_THROW(surface.left_with(more.cylinders, more.facets), std::invalid_argument);
}

TEST(SurfaceChange, TakingElementsAwayInAnyOrderGivesTheIncidenceOfASurfaceBuiltAnew) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Complex complex = test::sheet(3);
    complex.cylinder(0, 1);
    Surface surface = complex.surface();
    while (!complex.facets.empty()) {
      const auto victim = static_cast<std::ptrdiff_t>(random.uniform(0.0, 1.0) *
                                                      static_cast<double>(complex.facets.size()));
      const Facet torn = complex.facets[static_cast<std::size_t>(victim)];
      complex.facets.erase(complex.facets.begin() + victim);
      const auto has_side = [&](NodeId a, NodeId b) {
        return std::ranges::any_of(complex.cylinders, [&](const Cylinder& cylinder) {
          return std::minmax(cylinder.nodes[0], cylinder.nodes[1]) == std::minmax(a, b);
        });
      };
      if (random.uniform(0.0, 1.0) < 0.7 && !has_side(torn.nodes[1], torn.nodes[2]))
        complex.cylinders.push_back({{torn.nodes[1], torn.nodes[2]}, torn.radius});
      surface = surface.left_with(complex.cylinders, complex.facets);
      test::expect_same_incidence(surface, complex.surface());
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::surface_change_test

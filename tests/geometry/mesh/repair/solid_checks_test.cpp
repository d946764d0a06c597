// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/solid_checks.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/exact_pair.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace plekton::geometry::solid_checks_test {
namespace {

using test::inside_out;
using test::together;

Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& point : mesh.points) point += by;
  return mesh;
}

/// Triangles of integer corners with an area, each with nodes of its own.
Mesh random_triangles(test::Random& random, int count) {
  Mesh mesh;
  while (count > 0) {
    const Vec3 a = random.on_lattice(0, 4), b = random.on_lattice(0, 4),
               c = random.on_lattice(0, 4);
    if ((b - a).cross(c - a).isZero(0.0)) continue;  // exact
    const std::size_t first = mesh.points.size();
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.facets.push_back(
        {id_at<NodeId>(first), id_at<NodeId>(first + 1), id_at<NodeId>(first + 2)});
    --count;
  }
  return mesh;
}

std::array<Vec3, 3> corners_of(const Mesh& mesh, std::size_t facet) {
  const auto [a, b, c] = mesh.facets[facet];
  return {mesh.points[index_of(a)], mesh.points[index_of(b)], mesh.points[index_of(c)]};
}

/// Whether the nearest points of two triangles, which are rational, are one.
bool have_a_common_point(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  const auto features = test::all_witness_features(a, b);
  // Without any they lie in one plane, over each other.
  if (features.empty()) return true;
  const auto points = test::ExactPair(a, b).feet(features.front()[0], features.front()[1]);
  return test::dot(points->separation, points->separation).is_zero();
}

TEST(SelfIntersections, AreThePairsOfLooseTrianglesThatHaveACommonPoint) {
  test::Random random(1);
  std::size_t intersecting = 0, apart = 0;
  for (int trial = 0; trial < 15; ++trial) {
    const Mesh mesh = random_triangles(random, 12);
    std::vector<std::array<std::uint32_t, 2>> expected;
    for (std::uint32_t i = 0; i < 12; ++i)
      for (std::uint32_t k = i + 1; k < 12; ++k)
        if (have_a_common_point(corners_of(mesh, i), corners_of(mesh, k)))
          expected.push_back({i, k});

    ASSERT_EQ(self_intersections(mesh), expected) << trial;

    intersecting += expected.size();
    apart += 66 - expected.size();
  }
  EXPECT_GT(intersecting, 100u);
  EXPECT_GT(apart, 100u);
}

TEST(SelfIntersections, OfTwoBoxesDoNotDependOnTheOrderOfCorners) {
  const Mesh boxes =
      together({box_shell({1, 1, 1}, {2, 2, 2}), moved(box_shell({1, 1, 1}), {0.4, 0.3, 0.2})});
  const auto pairs = self_intersections(boxes);
  ASSERT_FALSE(pairs.empty());

  Mesh turned = boxes;
  for (std::size_t f = 0; f < turned.facets.size(); ++f) {
    auto& facet = turned.facets[f];
    std::rotate(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(f % 3), facet.end());
    if (f % 2 == 0) std::swap(facet[1], facet[2]);
  }

  EXPECT_EQ(self_intersections(turned), pairs);
  const std::size_t first = 48;  // facets of the first box: 6 sides of 4 cells of 2
  for (const auto& [low, high] : pairs) {
    EXPECT_LT(low, first) << "a box does not intersect itself";
    EXPECT_GE(high, first);
  }
}

TEST(BoundsVolume, AsksThatEveryClosedPartFacesAwayFromWhatItParts) {
  const Mesh outer = box_shell({3, 3, 3}), inner = moved(box_shell({1, 1, 1}), {1, 1, 1});
  const Mesh beside = moved(inner, {5, 0, 0});

  EXPECT_EQ(bounds_volume(outer), true);
  EXPECT_EQ(bounds_volume(together({outer, beside})), true);
  EXPECT_EQ(bounds_volume(together({outer, inside_out(beside)})), false);
  EXPECT_EQ(bounds_volume(together({outer, inside_out(inner)})), true) << "a hollow box";
  EXPECT_EQ(bounds_volume(inside_out(outer)), false);
  EXPECT_EQ(bounds_volume(inside_out(together({outer, beside}))), false);
  EXPECT_EQ(bounds_volume(together({outer, inner})), false) << "filled twice";
}

TEST(BoundsVolume, HasNoAnswerForWhatIsOpenOrNotConsistentOrNotManifold) {
  const Mesh box = box_shell({1, 1, 1});
  Mesh open = box;
  open.facets.pop_back();
  Mesh turned = box;
  std::swap(turned.facets[0][1], turned.facets[0][2]);
  Mesh with_fin = box;
  with_fin.points.push_back({3, 3, 3});
  with_fin.facets.push_back({box.facets[0][0], box.facets[0][1], NodeId{8}});

  EXPECT_EQ(bounds_volume(open), std::nullopt);
  EXPECT_EQ(bounds_volume(turned), std::nullopt);
  EXPECT_EQ(bounds_volume(with_fin), std::nullopt);
  EXPECT_EQ(bounds_volume({}), std::nullopt);
}

// CGAL reads a wild index for such a point.
TEST(BoundsVolume, LooksAtNoPointThatNoFacetUses) {
  Mesh box = box_shell({1, 1, 1});
  for (auto& facet : box.facets)
    for (NodeId& node : facet) node = id_at<NodeId>(index_of(node) + 2);
  box.points.insert(box.points.begin(), {Vec3(9, 9, 9), Vec3::Zero()});
  box.points.push_back(Vec3(-9, 0, 0));

  EXPECT_EQ(bounds_volume(box), true);
}

}  // namespace
}  // namespace plekton::geometry::solid_checks_test

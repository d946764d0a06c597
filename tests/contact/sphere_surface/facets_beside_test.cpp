// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/facets_beside.hpp"

#include "tests/support/contact_rule_reference.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace plekton::test::facets_beside_test {
namespace {

const SideFlags kNone = kNoSides;

/// Two facets on a side of 4 m along x, the first one towards y > 0, and what else they touch: a
/// facet on the corner at the origin, and a cylinder from the other one.
Complex hinge(std::array<int, 3> first, std::array<int, 3> second) {
  Complex complex;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 3, 0), Vec3(2, -3, 0), Vec3(-3, 1, 0),
                        Vec3(-3, -1, 0), Vec3(9, 0, 0)})
    complex.node(x);
  complex.facet(first[0], first[1], first[2]);
  complex.facet(second[0], second[1], second[2]);
  complex.facet(0, 4, 5);
  complex.cylinder(1, 6);
  return complex;
}

/// Of the first facet of a hinge, with the sphere at a place; no sides if the answer is no.
std::optional<SideFlags> sides_beside(const Complex& complex, const std::vector<int>& cells,
                                      const Vec3& centre, double range) {
  const Surface surface = complex.surface();
  std::vector<CellId> ids;
  for (const int cell : cells) ids.push_back(CellId{cell});
  SideFlags sides = kNone;
  if (!are_beside(surface, FaceId{0}, ids, centre, range, complex.x, sides)) return std::nullopt;
  return sides;
}

constexpr double kRange = 1.0;
const Vec3 kOverFirst(2.0, 0.4, 0.5);
const Vec3 kOverSecond(2.0, -0.4, 0.5);

TEST(AreBeside, MarksTheSharedSideHoweverCornersAreNumbered) {
  const std::array<std::array<int, 3>, 3> firsts{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
  const std::array<std::array<int, 3>, 4> seconds{{{0, 3, 1}, {3, 1, 0}, {1, 0, 3}, {0, 1, 3}}};
  for (std::size_t k = 0; k < 3; ++k) {
    SideFlags expected = kNone;
    expected[k] = 1.0;  // side k joins corners k and k + 1
    for (const auto& second : seconds) {
      const auto sides = sides_beside(hinge(firsts[k], second), {0, 1}, kOverFirst, kRange);
      ASSERT_TRUE(sides.has_value());
      EXPECT_TRUE(std::equal(sides->begin(), sides->begin() + 3, expected.begin())) << k;
    }
  }
}

TEST(AreBeside, IsTrueOfTheFacetAloneAndMarksNothingThen) {
  EXPECT_EQ(sides_beside(hinge({0, 1, 2}, {0, 3, 1}), {0}, kOverFirst, kRange), kNone);
}

TEST(AreBeside, IsFalseWhereAnythingElseMayTouch) {
  const Complex complex = hinge({0, 1, 2}, {0, 3, 1});

  EXPECT_FALSE(sides_beside(complex, {1}, kOverFirst, kRange)) << "the facet is none of the cells";
  EXPECT_FALSE(sides_beside(complex, {}, kOverFirst, kRange));
  EXPECT_FALSE(sides_beside(complex, {0, 1, 2}, kOverFirst, kRange)) << "a node is shared alone";
  EXPECT_FALSE(sides_beside(complex, {0, 1, 3}, kOverFirst, kRange)) << "a cylinder";
  EXPECT_FALSE(sides_beside(complex, {0, 1}, kOverSecond, kRange)) << "over the other facet";
  EXPECT_FALSE(sides_beside(complex, {0, 1}, Vec3(2.0, 0.0, 0.5), kRange)) << "over the side";
  EXPECT_FALSE(sides_beside(complex, {0, 1}, Vec3(0.3, 0.2, 0.5), kRange))
      << "other sides of the other facet are in range";
}

/// Whatever it says yes to is one contact, with the facet alone.
TEST(AreBeside, IsTrueOnlyWhereTheSphereFeelsOneContactAtItsFoot) {
  Random random(1);
  int beside = 0, asked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Complex complex = roughened(sheet(4), 1.0, trial % 2 == 0 ? 0.0 : 0.15, random);
    const Surface surface = complex.surface();
    PatchFinder finder(surface);
    for (int place = 0; place < 100; ++place) {
      const Vec3 centre(random.uniform(0.5, 3.5), random.uniform(0.5, 3.5),
                        random.uniform(-0.3, 0.3));
      const double range = random.uniform(0.05, 0.4);
      const auto cells = cells_near(surface, centre, range, complex.x);
      for (const CellId cell : cells) {
        const auto face = id_at<FaceId>(index_of(cell));
        std::vector<int> nodes;
        for (const NodeId node : surface.nodes_of(face)) nodes.push_back(static_cast<int>(node));
        const ReferenceFoot foot = ReferenceSimplex(nodes, complex.x).foot(centre);
        const Vec3 normal = (complex.x[index_of(surface.nodes_of(face)[1])] -
                             complex.x[index_of(surface.nodes_of(face)[0])])
                                .cross(complex.x[index_of(surface.nodes_of(face)[2])] -
                                       complex.x[index_of(surface.nodes_of(face)[0])])
                                .normalized();
        const bool is_over_inside =
            std::abs(std::abs(foot.separation.dot(normal)) - foot.distance) < 1e-9 * foot.distance;
        if (!is_over_inside || foot.distance >= range) continue;
        ++asked;
        SideFlags sides = kNone;
        if (!are_beside(surface, face, cells, centre, range, complex.x, sides)) continue;

        const TotalContact total = total_contact(finder, centre, range, cells, complex.x);

        beside += cells.size() > 1;
        ASSERT_EQ(total.patches, 1);
        ASSERT_NEAR(total.overlaps, range - foot.distance, 1e-12);
        ASSERT_NEAR(
            (total.force + (range - foot.distance) / foot.distance * foot.separation).norm(), 0.0,
            1e-9);  // the direction of a foot that is nearly touched
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& edge_faces = surface.faces_of(surface.edges_of(face)[k]);
          const bool is_shared =
              std::any_of(edge_faces.begin(), edge_faces.end(), [&](FaceId other) {
                return other != face && std::find(cells.begin(), cells.end(),
                                                  id_at<CellId>(index_of(other))) != cells.end();
              });
          ASSERT_EQ(sides[k] > 0.0, is_shared) << k;
        }
      }
    }
  }
  EXPECT_GT(beside, 200) << "of " << asked;
}

}  // namespace
}  // namespace plekton::test::facets_beside_test

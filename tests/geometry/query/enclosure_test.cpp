// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/enclosure.hpp"

#include "geometry/query/surface_query.hpp"
#include "tests/support/complexes.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace plekton::geometry::enclosure_test {
namespace {

using test::Complex;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Kernel::Point_3 exact_point(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

Mesh exact_mesh(const Complex& complex) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (const Vec3& x : complex.x) vertices.push_back(mesh.add_vertex(exact_point(x)));
  for (const Facet& facet : complex.facets) {
    const auto& [a, b, c] = facet.nodes;
    mesh.add_face(vertices[index_of(a)], vertices[index_of(b)], vertices[index_of(c)]);
  }
  return mesh;
}

Side side_of(CGAL::Bounded_side side) {
  if (side == CGAL::ON_BOUNDARY) return Side::on;
  return side == CGAL::ON_BOUNDED_SIDE ? Side::inside : Side::outside;
}

/// A tetrahedron whose facets are turned outwards.
Complex tetrahedron() {
  Complex result;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) result.node(x);
  result.facet(0, 2, 1);
  result.facet(0, 1, 3);
  result.facet(1, 2, 3);
  result.facet(2, 0, 3);
  return result;
}

/// A unit cube's surface without the middle of the longest way: with a dent down to a needle.
Complex dented_ball(test::Random& random) {
  Complex result = test::ball(2);
  for (Vec3& x : result.x) x *= 0.2 + 0.8 * random.unit();
  return result;
}

// CGAL in exact constructions is the reference.
TEST(Enclosure, AgreesWithExactConstructionsNearEdgesNodesAndPlanes) {
  test::Random random(1);
  std::array<int, 3> seen{};
  for (int shape = 0; shape < 6; ++shape) {
    Complex complex = shape == 0  ? tetrahedron()
                      : shape < 3 ? test::ball(shape)
                                  : dented_ball(random);
    if (shape % 2 == 1) complex = test::rotated(complex, random.rotation());
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    const Mesh mesh = exact_mesh(complex);
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> reference(mesh);
    for (int trial = 0; trial < 150; ++trial) {
      Vec3 point = test::random_point(random, complex);
      if (trial % 3 == 0) point = random.in_cube(1.0);
      if (trial % 3 == 1) {  // over the same line along an axis as a node
        point = complex.x[random.index(complex.x.size())];
        point[random.integer(0, 2)] = random.uniform(-1.0, 1.0);
      }
      const Side expected = side_of(reference(exact_point(point)));
      ++seen[static_cast<std::size_t>(expected)];

      ASSERT_EQ(query.side_of(point), expected) << "shape " << shape << ", trial " << trial;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 20);
}

TEST(Enclosure, KnowsTheLatticePointsOfACubeWhoseFacetsAreTurnedAnyWay) {
  const Complex cube = test::cube(3);  // opposite sides are turned alike
  const Surface surface = cube.surface();
  const SurfaceQuery query(surface, cube.x);
  ASSERT_TRUE(query.is_closed());
  for (int i = -1; i <= 7; ++i) {
    for (int j = -1; j <= 7; ++j) {
      for (int k = -1; k <= 7; ++k) {
        const Vec3 point(0.5 * i, 0.5 * j, 0.5 * k);
        const bool is_in = point.minCoeff() >= 0.0 && point.maxCoeff() <= 3.0;
        const bool is_on = is_in && (point.minCoeff() == 0.0 || point.maxCoeff() == 3.0);
        const Side expected = is_on ? Side::on : is_in ? Side::inside : Side::outside;

        EXPECT_EQ(query.side_of(point), expected) << point.transpose();
      }
    }
  }
}

TEST(Enclosure, TellsTheSidesOfAFaceOneUlpApart) {
  const Complex cube = test::cube(1);
  const Surface surface = cube.surface();
  const SurfaceQuery query(surface, cube.x);

  EXPECT_EQ(query.side_of(Vec3(0.3, 0.3, std::nextafter(1.0, 2.0))), Side::outside);
  EXPECT_EQ(query.side_of(Vec3(0.3, 0.3, 1.0)), Side::on);
  EXPECT_EQ(query.side_of(Vec3(0.3, 0.3, std::nextafter(1.0, 0.0))), Side::inside);
  EXPECT_EQ(query.side_of(Vec3(0.3, 0.3, 5e-324)), Side::inside);
  EXPECT_EQ(query.side_of(Vec3(0.3, 0.3, -5e-324)), Side::outside);
}

TEST(Enclosure, IsOutsideInTheHollowOfAShellInAShell) {
  Complex both = test::cube(4);
  const Complex inner = test::cube(2);
  const int first = static_cast<int>(both.x.size());
  for (const Vec3& x : inner.x) both.node(x + Vec3::Constant(1.0));
  for (const Facet& facet : inner.facets) {
    const auto at = [&](std::size_t k) { return first + static_cast<int>(facet.nodes[k]); };
    both.facet(at(0), at(1), at(2));
  }
  const Surface surface = both.surface();
  const SurfaceQuery query(surface, both.x);

  EXPECT_EQ(query.side_of(Vec3(0.5, 2, 2)), Side::inside);
  EXPECT_EQ(query.side_of(Vec3(2, 2, 2)), Side::outside);
  EXPECT_EQ(query.side_of(Vec3(3, 2, 2)), Side::on);
}

/// Two facets that lie on each other enclose nothing, nor do some without area.
TEST(Enclosure, HoldsNothingInFoldsAndFacetsWithoutArea) {
  Complex fold;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 2, 0)}) fold.node(x);
  fold.facet(0, 1, 2);
  fold.facet(0, 3, 1);
  fold.facet(1, 3, 2);
  fold.facet(2, 3, 0);
  const Surface surface = fold.surface();
  const SurfaceQuery query(surface, fold.x);
  ASSERT_TRUE(query.is_closed());

  EXPECT_EQ(query.side_of(Vec3(0.5, 0.5, 0)), Side::on);
  EXPECT_EQ(query.side_of(Vec3(0, 1, 0)), Side::on);
  EXPECT_EQ(query.side_of(Vec3(0.5, 0.5, 1e-9)), Side::outside);
  EXPECT_EQ(query.side_of(Vec3(0.5, 0.5, -1e-9)), Side::outside);
  EXPECT_EQ(query.side_of(Vec3(0, 1, 1)), Side::outside);
}

TEST(Enclosure, IsTheSameForHugeAndSmallCoordinates) {
  for (const double scale : {1e-300, 1e-100, 1e-20, 1e60, 1e74}) {
    Complex cube = test::cube(1);
    for (Vec3& x : cube.x) x *= scale;
    const Surface surface = cube.surface();
    const SurfaceQuery query(surface, cube.x);

    EXPECT_EQ(query.side_of(Vec3(0.5, 0.25, 0.25) * scale), Side::inside) << scale;
    EXPECT_EQ(query.side_of(Vec3(0.5, 0.25, 1.25) * scale), Side::outside) << scale;
    EXPECT_EQ(query.side_of(Vec3(0.5, 0.25, 1.0) * scale), Side::on) << scale;
  }
}

TEST(Enclosure, SaysWhatIsOpen) {
  const auto reason_of = [](const Complex& complex) -> std::string {
    const Surface surface = complex.surface();
    const SurfaceQuery query(surface, complex.x);
    EXPECT_FALSE(query.is_closed());
    try {
      (void)query.signed_distance(Vec3::Zero());
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "";
  };
  Complex open = tetrahedron();
  open.facets.pop_back();
  Complex with_a_bar = tetrahedron();
  with_a_bar.cylinder(0, with_a_bar.node(Vec3(-1, 0, 0)));

  EXPECT_EQ(
      reason_of(open),
      "the surface is not closed: the edge between nodes 0 and 2 has 1 facets, but every edge "
      "needs an even number; close the hole, or merge the nodes of facets that only lie side "
      "by side");
  EXPECT_NE(reason_of(with_a_bar).find("free cylinders"), std::string::npos);
  EXPECT_NE(reason_of(Complex()).find("no facets"), std::string::npos);
}

TEST(SignedDistance, IsThatOfTheNearestCoreWithTheSignOfTheSide) {
  test::Random random(5);
  Complex complex = dented_ball(random);
  for (Facet& facet : complex.facets) facet.radius = 0.3;
  const Surface surface = complex.surface();
  const SurfaceQuery query(surface, complex.x);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 point = trial % 4 == 0 ? test::random_point(random, complex) : random.in_cube(1.0);
    double least = std::numeric_limits<double>::infinity();
    for (const Facet& facet : complex.facets) {
      const auto at = [&](std::size_t k) { return complex.x[index_of(facet.nodes[k])]; };
      const Proximity near =
          proximity(Probe::point(point), Probe::facet({at(0), at(1), at(2)}, 0.0));
      least = std::min(least, near.gap);
    }

    const SignedDistance found = query.signed_distance(point);

    EXPECT_EQ(found.side, query.side_of(point));
    // Both are within 1e-12 of the distance (primitive_pairs.hpp).
    EXPECT_NEAR(std::abs(found.distance), least, 2e-12 * least);
    EXPECT_EQ(found.distance < 0.0, found.side == Side::inside);
    EXPECT_EQ(found.distance == 0.0, found.side == Side::on);
  }
}

/// The foot of (1, 1, -1) has rounded weights, and a computed distance of some 1e-16 of the size.
TEST(SignedDistance, IsZeroOnTheSurfaceWhateverIsRounded) {
  Complex complex;
  for (const Vec3& x : {Vec3(1, -2, -2), Vec3(-1, 2, -2), Vec3(-1, -2, 0), Vec3(2, 2, 0),
                        Vec3(-2, 1, -2), Vec3(2, 2, -2), Vec3(0, 1, 2), Vec3(1, 0, 2)})
    complex.node(x);
  for (const int first : {0, 4}) {
    complex.facet(first, first + 1, first + 2);
    complex.facet(first, first + 3, first + 1);
    complex.facet(first + 1, first + 3, first + 2);
    complex.facet(first + 2, first + 3, first);
  }
  const Surface surface = complex.surface();
  for (const double size : {1.0, 1e6, 1e60}) {
    std::vector<Vec3> x = complex.x;
    for (Vec3& position : x) position *= size;
    const SurfaceQuery query(surface, x);
    int on = 0;
    for (int i = 0; i < 125; ++i) {
      const SignedDistance found =
          query.signed_distance(size * Vec3(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2));

      if (found.side == Side::on) ++on;
      EXPECT_EQ(found.distance < 0.0, found.side == Side::inside) << i;
      EXPECT_EQ(found.distance > 0.0, found.side == Side::outside) << i;
    }
    EXPECT_EQ(on, 13);
  }
}

}  // namespace
}  // namespace plekton::geometry::enclosure_test

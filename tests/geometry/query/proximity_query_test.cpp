// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/proximity_query.hpp"

#include "geometry/closest/primitive_pairs.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <utility>

namespace plekton::geometry::proximity_query_test {
namespace {

/// A sheet with a free cylinder at its corner and spheres around it.
struct Model {
  Elements elements;
  std::vector<Vec3> x;
};

Model random_model(test::Random& random, int sphere_count) {
  const Mesh mesh = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 4, .cells_y = 4});
  Model model;
  model.x = mesh.points;
  for (Vec3& point : model.x) point.z() += random.uniform(-0.05, 0.05);
  for (const auto& nodes : mesh.facets) model.elements.facets.push_back({nodes, 0.02});
  model.x.push_back(Vec3(0.8, 0.8, 0.3));
  model.elements.cylinders.push_back({{NodeId{0}, id_at<NodeId>(model.x.size() - 1)}, 0.02});
  for (int i = 0; i < sphere_count; ++i) {
    model.elements.spheres.push_back({{id_at<NodeId>(model.x.size())}, random.uniform(0.02, 0.1)});
    model.x.push_back(random.in_cube(0.6));
  }
  return model;
}

std::vector<Proximity> brute_force(const Model& model, const Surface& surface, double largest_gap) {
  std::vector<Proximity> found;
  const auto& spheres = model.elements.spheres;
  const auto keep = [&](const Proximity& p) {
    if (p.gap < largest_gap) found.push_back(p);
  };
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = i + 1; j < spheres.size(); ++j)
      keep(proximity(spheres[i], spheres[j], model.x));
  }
  for (const Sphere& sphere : spheres) {
    for (std::size_t c = 0; c < surface.cell_count(); ++c)
      keep(proximity(sphere, surface, id_at<CellId>(c), model.x));
  }
  return found;
}

TEST(ProximityQuery, FindsWhatBruteForceFindsWhileEverythingMoves) {
  test::Random random(3);
  Model model = random_model(random, 40);
  constexpr double kLargestGap = 0.03;
  ProximityQuery query(model.elements, model.x.size(), kLargestGap);

  for (int step = 0; step < 100; ++step) {
    for (Vec3& point : model.x) point += random.in_cube(0.01);
    const auto expected = brute_force(model, query.surface(), kLargestGap);
    const auto found = query.find(model.x);

    ASSERT_EQ(found.size(), expected.size()) << "step " << step;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].a.nodes, expected[i].a.nodes);
      EXPECT_EQ(found[i].b.feature, expected[i].b.feature);
      EXPECT_EQ(found[i].gap, expected[i].gap);
    }
  }
}

/// Two crumpled sheets and a few bars, each a structure.
Model three_structures(test::Random& random) {
  Model model;
  for (const double height : {0.0, 0.15}) {
    const Mesh mesh = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 4, .cells_y = 4});
    const auto first = static_cast<std::int32_t>(model.x.size());
    for (const Vec3& x : mesh.points)
      model.x.push_back(x + random.in_cube(0.08) + height * Vec3::UnitZ());
    for (const auto& nodes : mesh.facets) {
      Facet facet{nodes, 0.02};
      for (NodeId& node : facet.nodes) node = NodeId{static_cast<std::int32_t>(node) + first};
      model.elements.facets.push_back(facet);
    }
  }
  for (int i = 0; i < 6; ++i) {
    const NodeId first = id_at<NodeId>(model.x.size());
    for (int k = 0; k < 2; ++k) model.x.push_back(random.in_cube(0.5));
    model.elements.cylinders.push_back(
        {{first, NodeId{static_cast<std::int32_t>(first) + 1}}, 0.03});
  }
  return model;
}

bool share_a_node(const Surface& surface, CellId a, CellId b) {
  for (const NodeId node : surface.nodes_of(a)) {
    for (const NodeId other : surface.nodes_of(b)) {
      if (node == other) return true;
    }
  }
  return false;
}

/// Gaps and cells of all cell pairs that are chosen.
std::vector<std::pair<IndexPair, double>> cells_by_brute_force(const Model& model,
                                                               const Surface& surface,
                                                               const PairChoice& choice) {
  std::vector<std::pair<IndexPair, double>> found;
  for (std::size_t i = 0; i < surface.cell_count(); ++i) {
    for (std::size_t k = i + 1; k < surface.cell_count(); ++k) {
      const CellId a = id_at<CellId>(i);
      const CellId b = id_at<CellId>(k);
      const bool is_one = surface.structure_of(a) == surface.structure_of(b);
      if (is_one ? !choice.within_structures || share_a_node(surface, a, b)
                 : !choice.cells_with_cells) {
        continue;
      }
      const double gap = proximity(surface, a, b, model.x).gap;
      if (gap < choice.largest_gap)
        found.push_back({{static_cast<std::int32_t>(i), static_cast<std::int32_t>(k)}, gap});
    }
  }
  return found;
}

TEST(ProximityQuery, FindsCellPairsBetweenAndWithinStructuresWhileTheyMove) {
  test::Random random(4);
  for (const auto& [between, within] : {std::pair(true, false), {false, true}, {true, true}}) {
    Model model = three_structures(random);
    const PairChoice choice{0.05, between, within};
    ProximityQuery query(model.elements, model.x.size(), choice, 2);

    for (int step = 0; step < 20; ++step) {
      for (Vec3& x : model.x) x += random.in_cube(0.01);
      const auto expected = cells_by_brute_force(model, query.surface(), choice);

      const auto found = query.find(model.x);

      ASSERT_EQ(found.size(), expected.size());
      ASSERT_EQ(query.found_elements().size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(query.found_elements()[i].a.id, expected[i].first.a);
        EXPECT_EQ(query.found_elements()[i].b.id, expected[i].first.b);
        EXPECT_EQ(found[i].gap, expected[i].second);
      }
    }
    EXPECT_FALSE(query.found_elements().empty());
  }
}

TEST(ProximityQuery, GivesTheSameForAnyNumberOfThreads) {
  test::Random random(5);
  const Model model = three_structures(random);
  const PairChoice choice{0.05, true, true};
  ProximityQuery one(model.elements, model.x.size(), choice, 1);
  ProximityQuery three(model.elements, model.x.size(), choice, 3);

  const auto first = one.find(model.x);
  const auto second = three.find(model.x);

  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(one.found_elements()[i], three.found_elements()[i]);
    EXPECT_EQ(first[i].gap, second[i].gap);
    EXPECT_EQ(first[i].normal, second[i].normal);
  }
}

TEST(ProximityQuery, RefusesALargestGapThatIsNotPositive) {
  EXPECT_THROW(ProximityQuery({}, 0, 0.0), std::invalid_argument);
  EXPECT_THROW(ProximityQuery({}, 0, -1.0), std::invalid_argument);
}

TEST(ProximityQuery, SaysHowSmallTheLargestGapMayBe) {
  EXPECT_NO_THROW(ProximityQuery({}, 0, 1e-100));
  try {
    ProximityQuery query({}, 0, 1e-300);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "largest gap is 1e-300 m; it must be at least 1e-100 m; take a larger one, and "
                 "leave out what is further away");
  }
}

TEST(ProximityQuery, NamesTheNodesWhoseCoordinatesItCannotUse) {
  Elements elements;
  elements.spheres = {{{NodeId{0}}, 1.0}, {{NodeId{1}}, 0.5}};
  ProximityQuery query(elements, 3, 1.0);
  const std::vector<Vec3> good{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  auto spoilt = good;
  spoilt[0].y() = std::numeric_limits<double>::quiet_NaN();
  spoilt[2].x() = 1e80;

  try {
    (void)query.find(spoilt);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "node 0 is at (  0 nan   0) m; coordinates must be finite and below 1e75\n"
                 "node 2 is at (1e+80     1     0) m; coordinates must be finite and below 1e75");
  }
  EXPECT_EQ(query.find(good).size(), 1u);
}

TEST(ProximityQuery, AnswersTheSameAfterItWasMoved) {
  Elements elements;
  elements.spheres = {{{NodeId{0}}, 0.5}, {{NodeId{1}}, 0.5}};
  elements.facets = {{{NodeId{2}, NodeId{3}, NodeId{4}}, 0.1}};
  const std::vector<Vec3> x{{0, 0, 1}, {0.9, 0, 1}, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  ProximityQuery query(elements, x.size(), 0.6);
  const auto found = query.find(x);
  const std::vector<Proximity> before(found.begin(), found.end());

  ProximityQuery moved = std::move(query);

  for (int asked = 0; asked < 2; ++asked) {
    const auto after = moved.find(x);
    ASSERT_EQ(after.size(), before.size());
    ASSERT_GE(after.size(), 2u);
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].gap, before[i].gap);
  }
  EXPECT_EQ(moved.surface().face_count(), 1u);
}

TEST(ProximityQuery, ListsAllProblemsOfItsElementsTogether) {
  Elements elements;
  elements.spheres = {{{NodeId{0}}, 0.1}, {{NodeId{5}}, 0.1}, {{NodeId{-1}}, -0.1}};
  elements.spheres.push_back({{NodeId{1}}, std::numeric_limits<double>::infinity()});
  elements.facets = {{{NodeId{0}, NodeId{1}, NodeId{1}}, 0.1}};

  try {
    ProximityQuery query(elements, 3, -1.0);
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "sphere 1 names node 5, but there are 3 nodes\n"
                 "sphere 2 names node -1, but there are 3 nodes\n"
                 "sphere 2 has radius -0.1 m; it must be at least 0 and below 1e+75 m\n"
                 "sphere 3 has radius inf m; it must be at least 0 and below 1e+75 m\n"
                 "largest gap is -1 m; it must be positive and finite\n"
                 "surface: facet 0 repeats node 1; merge duplicate nodes or delete the element");
  }
}

TEST(ProximityQuery, RefusesPositionsOfAnotherNumberOfNodes) {
  Elements elements;
  elements.spheres = {{{NodeId{2}}, 0.1}};
  ProximityQuery query(elements, 3, 0.01);

  EXPECT_THROW(query.find(std::vector<Vec3>(2, Vec3::Zero())), std::invalid_argument);
  EXPECT_THROW(query.find(std::vector<Vec3>(4, Vec3::Zero())), std::invalid_argument);
  EXPECT_NO_THROW(query.find(std::vector<Vec3>(3, Vec3::Zero())));
}

TEST(PrimitivePairs, PutTheContactPointHalfTheGapAwayFromBothSurfaces) {
  test::Random random(8);
  const Model model = random_model(random, 10);
  const Surface surface(model.elements.cylinders, model.elements.facets, model.x.size());

  for (const Sphere& sphere : model.elements.spheres) {
    for (std::size_t c = 0; c < surface.cell_count(); ++c) {
      const Proximity p = proximity(sphere, surface, id_at<CellId>(c), model.x);
      const Vec3 from_a = position(p.a, model.x) + p.arm_a * p.normal;
      const Vec3 from_b = position(p.b, model.x) - p.arm_b * p.normal;

      EXPECT_NEAR((from_a - from_b).norm(), 0.0, 1e-14);
      EXPECT_NEAR(p.arm_a + p.arm_b, p.gap + sphere.radius + 0.02, 1e-15);
    }
  }
}

TEST(PrimitivePairs, AgreeBitForBitAboutAFootOnACommonEdge) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0.1}, {0.3, 1, 0}, {0.4, -1, 0}, {0.37, 0.01, 0.4}};
  const std::vector<Facet> facets{{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1},
                                  {{NodeId{1}, NodeId{0}, NodeId{3}}, 0.1}};
  const Surface surface({}, facets, x.size());
  std::vector<Vec3> at = x;
  at[4] = Vec3(0.4, 0.0, 0.4);  // above a ridge: both facets answer with their common edge
  at[2].z() = at[3].z() = -0.5;
  const Sphere sphere{{NodeId{4}}, 0.2};

  const Proximity p = proximity(sphere, surface, CellId{0}, at);
  const Proximity q = proximity(sphere, surface, CellId{1}, at);

  ASSERT_EQ(p.b.feature.kind, FeatureKind::edge);
  EXPECT_EQ(p.b.feature, q.b.feature);
  EXPECT_EQ(p.gap, q.gap);
  EXPECT_EQ(p.normal, q.normal);
  EXPECT_EQ(p.b.weights, q.b.weights);
}

}  // namespace
}  // namespace plekton::geometry::proximity_query_test

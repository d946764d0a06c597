// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/exclusion_groups.hpp"

#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/neighbor/neighbours.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace plekton::geometry::exclusion_groups_test {
namespace {

std::vector<NodeId> nodes(std::initializer_list<int> ids) {
  std::vector<NodeId> list;
  for (const int id : ids) list.push_back(NodeId{id});
  return list;
}

TEST(ExclusionGroups, ExcludeElementsWithNodesInOneGroupAlone) {
  const ExclusionGroups groups({0, 0, 1, -1, -1});

  EXPECT_TRUE(groups.exclude(nodes({0}), nodes({1})));
  EXPECT_TRUE(groups.exclude(nodes({0, 3}), nodes({4, 1})));
  EXPECT_FALSE(groups.exclude(nodes({0}), nodes({2})));
  EXPECT_FALSE(groups.exclude(nodes({3}), nodes({4})));
  EXPECT_FALSE(ExclusionGroups().exclude(nodes({0}), nodes({0})));
}

// Two spheres and a facet in one another's range, of which the first sphere and the facet belong
// together.
TEST(ExclusionGroups, KeepPairsOfAGroupOutOfTheLists) {
  const std::vector<Vec3> x{Vec3(0.2, 0.2, 0), Vec3(0.4, 0.2, 0.1), Vec3(0, 0, 0), Vec3(1, 0, 0),
                            Vec3(0, 1, 0)};
  const std::vector<Sphere> spheres{{{NodeId{0}}, 0.2}, {{NodeId{1}}, 0.2}};
  const std::vector<Facet> facets{{{NodeId{2}, NodeId{3}, NodeId{4}}, 0.1}};
  const Surface surface({}, facets, x.size());
  ThreadPool pool;
  Neighbours all(spheres, surface, 0.1), grouped(spheres, surface, 0.1);
  grouped.leave_out(ExclusionGroups({0, -1, 0, 0, 0}));

  all.update(x, pool);
  grouped.update(x, pool);

  EXPECT_EQ(all.sphere_structures().size(), 2U);
  ASSERT_EQ(grouped.sphere_structures().size(), 1U);
  EXPECT_EQ(grouped.sphere_structures()[0].a, 1);
  EXPECT_EQ(grouped.sphere_pairs().size(), 1U);
}

TEST(ExclusionGroups, KeepCellsOfAGroupApart) {
  const std::vector<Vec3> x{Vec3(0, 0, 0),   Vec3(1, 0, 0),   Vec3(0, 1, 0),
                            Vec3(0, 0, 0.1), Vec3(1, 0, 0.1), Vec3(0, 1, 0.1)};
  const std::vector<Facet> facets{{{NodeId{0}, NodeId{1}, NodeId{2}}, 0.1},
                                  {{NodeId{3}, NodeId{4}, NodeId{5}}, 0.1}};
  const Surface surface({}, facets, x.size());
  ThreadPool pool;
  CellNeighbours all(surface, x, 0.1, true), grouped(surface, x, 0.1, true);
  grouped.leave_out(ExclusionGroups({0, 0, 0, 0, 0, 0}));

  all.update(x, pool);
  grouped.update(x, pool);

  EXPECT_EQ(all.pairs().size(), 1U);
  EXPECT_TRUE(grouped.pairs().empty());
}

}  // namespace
}  // namespace plekton::geometry::exclusion_groups_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/node_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace plekton::dynamics::node_members_test {
namespace {

using testing::ElementsAre;
using Places = std::vector<std::pair<std::size_t, std::size_t>>;

/// Groups and places in them of node i.
template <std::size_t N>
Places places_of(const NodeMembers<N>& members, std::size_t i) {
  Places places;
  for (const auto& member : members.of(i)) places.emplace_back(member.group, member.place);
  return places;
}

TEST(NodeMembers, KnowEachNodeOnceAndByGroupWhereItIs) {
  // Two facets over an edge, and one that shares a corner with both.
  const NodeMembers<3> members({{NodeId{7}, NodeId{2}, NodeId{4}},
                                {NodeId{4}, NodeId{2}, NodeId{9}},
                                {NodeId{9}, NodeId{5}, NodeId{4}}});
  EXPECT_THAT(members.nodes(), ElementsAre(NodeId{2}, NodeId{4}, NodeId{5}, NodeId{7}, NodeId{9}));
  EXPECT_EQ(places_of(members, 0), (Places{{0, 1}, {1, 1}}));
  EXPECT_EQ(places_of(members, 1), (Places{{0, 2}, {1, 0}, {2, 2}}));
  EXPECT_EQ(places_of(members, 2), (Places{{2, 1}}));
  EXPECT_EQ(places_of(members, 3), (Places{{0, 0}}));
  EXPECT_EQ(places_of(members, 4), (Places{{1, 2}, {2, 0}}));
  EXPECT_EQ(members.groups()[1][2], NodeId{9});
}

TEST(NodeMembers, HaveANodeTwiceInAGroupThatNamesItTwice) {
  const NodeMembers<2> members({{NodeId{3}, NodeId{3}}});
  EXPECT_THAT(members.nodes(), ElementsAre(NodeId{3}));
  EXPECT_EQ(places_of(members, 0), (Places{{0, 0}, {0, 1}}));
}

TEST(NodeMembers, OfNoGroupsAreNone) {
  EXPECT_TRUE(NodeMembers<2>({}).nodes().empty());
}

}  // namespace
}  // namespace plekton::dynamics::node_members_test

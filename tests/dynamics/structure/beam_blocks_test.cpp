// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_blocks.hpp"

#include "geometry/mesh/generate/lattice.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace plekton::test::beam_blocks_test {
namespace {

using dynamics::BeamBlocks;
using geometry::NodeId;

/// The nodes of the bars of a grid, numbered at random.
struct Net {
  std::vector<NodeId> ends;
  std::size_t node_count;
};

Net shuffled_grid(int apertures, Random& random) {
  const geometry::Lattice grid = geometry::biaxial_geogrid({0.01, 0.01, apertures, apertures, 4});
  std::vector<std::size_t> number(grid.points.size());
  std::iota(number.begin(), number.end(), std::size_t{0});
  for (std::size_t i = number.size(); i > 1; --i) std::swap(number[i - 1], number[random.index(i)]);
  Net net{{}, number.size()};
  for (const auto& edge : grid.edges) {
    for (const NodeId node : edge.nodes)
      net.ends.push_back(geometry::id_at<NodeId>(number[geometry::index_of(node)]));
  }
  return net;
}

TEST(BeamBlocks, HaveEveryBondOnceAndItsNodesAsMembers) {
  Random random(1);
  const Net net = shuffled_grid(12, random);

  const BeamBlocks blocks(net.ends, net.node_count);

  std::vector<int> times(net.ends.size() / 2, 0);
  std::set<std::size_t> slots;
  for (const BeamBlocks::Block& block : blocks.blocks()) {
    const auto members = blocks.members().subspan(block.first_member, block.member_count);
    EXPECT_EQ(std::set(members.begin(), members.end()).size(), members.size());
    for (std::size_t n = 0; n < block.bond_count; ++n) {
      const BeamBlocks::Bond& bond = blocks.bonds(block)[n];
      ++times[bond.index];
      slots.insert(block.slot(n));
      for (std::size_t side = 0; side < 2; ++side)
        EXPECT_EQ(members[bond.members[side]], net.ends[2 * bond.index + side]);
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(times.size()));
  EXPECT_EQ(slots.size(), times.size());
  EXPECT_LT(*slots.rbegin(), blocks.row_count() * BeamBlocks::kLanes);
}

TEST(BeamBlocks, AreFullButForTheLast) {
  Random random(2);
  const Net net = shuffled_grid(12, random);

  const BeamBlocks blocks(net.ends, net.node_count);

  const auto all = blocks.blocks();
  for (const BeamBlocks::Block& block : all.first(all.size() - 1))
    EXPECT_EQ(block.bond_count, BeamBlocks::kFull);
  EXPECT_LE(all.back().bond_count, BeamBlocks::kFull);
}

TEST(BeamBlocks, AreClumpsHoweverTheNodesAreNumbered) {
  Random random(3);
  const Net net = shuffled_grid(30, random);

  const BeamBlocks blocks(net.ends, net.node_count);

  // A block of bonds taken at random would have nearly two members for each bond, a connected one
  // without rings one. Rings and left-over pieces are few either way.
  const std::size_t bonds = net.ends.size() / 2;
  EXPECT_LT(static_cast<double>(blocks.members().size()), 1.25 * static_cast<double>(bonds));
}

TEST(BeamBlocks, OfNoBondsAreNone) {
  const BeamBlocks blocks({}, 5);

  EXPECT_TRUE(blocks.blocks().empty());
  EXPECT_EQ(blocks.row_count(), 0U);
}

TEST(BeamBlocks, ShareOutTheBondsOfAHub) {
  // Far more bonds at a node than a block has; were the node's bonds looked through again for each
  // block, this would take minutes.
  constexpr std::size_t kSpokes = 1'000'000;
  std::vector<NodeId> ends;
  for (std::size_t i = 1; i <= kSpokes; ++i) {
    ends.push_back(NodeId{0});
    ends.push_back(geometry::id_at<NodeId>(i));
  }

  const BeamBlocks blocks(ends, kSpokes + 1);

  EXPECT_EQ(blocks.blocks().size(), (kSpokes + BeamBlocks::kFull - 1) / BeamBlocks::kFull);
  EXPECT_EQ(blocks.members().size(), kSpokes + blocks.blocks().size());
}

}  // namespace
}  // namespace plekton::test::beam_blocks_test

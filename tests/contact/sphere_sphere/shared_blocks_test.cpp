// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/shared_blocks.hpp"

#include "tests/support/seeded_random.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <vector>

namespace plekton::contact::shared_blocks_test {
namespace {

using geometry::IndexPair;

/// Spheres on a lattice, each paired with its neighbours.
struct Lattice {
  explicit Lattice(int side) {
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        for (int k = 0; k < side; ++k) {
          const auto self = static_cast<std::int32_t>(x.size());
          spheres.push_back({geometry::id_at<NodeId>(x.size()), 0.5, MaterialId{0}, -1, 1.0});
          x.emplace_back(i, j, k);
          if (k + 1 < side) pairs.push_back({self, self + 1});
          if (j + 1 < side) pairs.push_back({self, self + side});
          if (i + 1 < side) pairs.push_back({self, self + side * side});
        }
    std::ranges::sort(pairs);
    alone.assign(pairs, spheres, {}, pool, x);
  }

  /// Some of the pairs, others for each rank.
  std::vector<IndexPair> found_by(const geometry::Ranks& ranks) const {
    std::vector<IndexPair> found;
    test::Random random(3);
    for (const IndexPair& pair : pairs) {
      const auto finder = static_cast<int>(random.uniform(0.0, ranks.count()));
      if (finder == ranks.rank()) found.push_back(pair);
    }
    return found;
  }

  std::vector<SphereBody> spheres;
  std::vector<IndexPair> pairs;
  std::vector<Vec3> x;
  geometry::ThreadPool pool;
  SphereBlocks alone;  ///< of one process
};

struct OfRank {
  SphereBlocks blocks;
  SharedBlocks shared;
  std::vector<IndexPair> pairs;

  OfRank(const Lattice& lattice, geometry::Ranks& ranks) : shared(ranks) {
    pairs = shared.deal_out(lattice.found_by(ranks), lattice.spheres, lattice.x, blocks);
    geometry::ThreadPool pool;
    shared.fill(pairs, lattice.spheres, {}, pool, lattice.x, blocks);
  }
};

constexpr int kSide = 15;  // 3375 spheres: eight blocks

/// Calls body(ranks, what is of a rank) on several ranks, one after the other.
template <class Body>
void on_ranks(const Lattice& lattice, int count, bool by_chance, const Body& body) {
  std::mutex mutex;
  test::ThreadRanks(count, by_chance).run([&](geometry::Ranks& ranks) {
    const OfRank of_rank(lattice, ranks);
    const std::lock_guard lock(mutex);
    body(ranks, of_rank);
  });
}

TEST(SharedBlocks, AreCutAsThoseOfOneProcess) {
  const Lattice lattice(kSide);
  ASSERT_GT(lattice.alone.blocks().size(), 4U);
  for (const int count : {2, 3, 11}) {
    on_ranks(lattice, count, false, [&](geometry::Ranks&, const OfRank& of_rank) {
      ASSERT_EQ(of_rank.blocks.blocks().size(), lattice.alone.blocks().size());
      for (std::size_t k = 0; k < of_rank.blocks.blocks().size(); ++k)
        EXPECT_TRUE(std::ranges::equal(of_rank.blocks.spheres_of(k), lattice.alone.spheres_of(k)));
      EXPECT_TRUE(std::ranges::equal(of_rank.blocks.work(), lattice.alone.work()));
    });
  }
}

TEST(SharedBlocks, GiveEachPairToTheRankThatHasItsBlock) {
  const Lattice lattice(kSide);
  for (const bool by_chance : {false, true}) {
    std::vector<IndexPair> all;
    on_ranks(lattice, 3, by_chance, [&](geometry::Ranks& ranks, const OfRank& of_rank) {
      EXPECT_TRUE(std::ranges::is_sorted(of_rank.pairs));
      for (const IndexPair& pair : of_rank.pairs)
        EXPECT_EQ(of_rank.shared.rank_of(pair, of_rank.blocks), ranks.rank());
      all.insert(all.end(), of_rank.pairs.begin(), of_rank.pairs.end());
    });
    std::ranges::sort(all);
    EXPECT_EQ(all, lattice.pairs);
  }
}

TEST(SharedBlocks, HaveTheRowsAndMembersThatOneProcessHas) {
  const Lattice lattice(kSide);
  std::set<std::size_t> seen;
  on_ranks(lattice, 3, true, [&](geometry::Ranks&, const OfRank& of_rank) {
    for (const std::uint32_t k : of_rank.shared.own()) {
      EXPECT_TRUE(seen.insert(k).second);
      const SphereBlocks::Block& block = of_rank.blocks.blocks()[k];
      const SphereBlocks::Block& expected = lattice.alone.blocks()[k];
      const auto members = of_rank.blocks.members(block);
      const auto expected_members = lattice.alone.members(expected);
      EXPECT_EQ(block.owned, expected.owned);
      ASSERT_EQ(members.size(), expected_members.size());
      for (std::size_t m = 0; m < members.size(); ++m)
        EXPECT_EQ(members[m].node, expected_members[m].node);
      const auto ranges = of_rank.blocks.ranges(block);
      const auto expected_ranges = lattice.alone.ranges(expected);
      ASSERT_EQ(ranges.size(), expected_ranges.size());
      for (std::size_t r = 0; r < ranges.size(); ++r) {
        EXPECT_EQ(ranges[r].pair_count, expected_ranges[r].pair_count);
        for (std::size_t n = 0; n < ranges[r].slot_count(); ++n) {
          const auto& pair = of_rank.blocks.row(ranges[r].first_row)[n];
          const auto& expected_pair = lattice.alone.row(expected_ranges[r].first_row)[n];
          EXPECT_EQ(pair.a, expected_pair.a);
          EXPECT_EQ(pair.b, expected_pair.b);
        }
      }
    }
  });
  EXPECT_EQ(seen.size(), lattice.alone.blocks().size());
}

/// A sphere's sums of other blocks, in the order in which they are added: here by the block that
/// computes them, which is the x of its force.
std::map<NodeId, std::vector<double>> added_alone(const Lattice& lattice) {
  std::vector<double> block_of_ghost(lattice.alone.ghost_count());
  lattice.alone.for_each_ghost_here([&](const SphereBlocks::GhostOf& of, std::uint32_t ghost) {
    block_of_ghost[ghost] = of.block;
  });
  std::map<NodeId, std::vector<double>> added;
  for (std::size_t k = 0; k < lattice.alone.blocks().size(); ++k)
    lattice.alone.for_each_ghost(
        k, [&](NodeId node, std::uint32_t ghost) { added[node].push_back(block_of_ghost[ghost]); },
        [](NodeId, std::uint32_t) {});
  return added;
}

TEST(SharedBlocks, AddSumsOfOtherRanksInTheOrderOfOneProcess) {
  const Lattice lattice(kSide);
  std::mutex mutex;
  std::map<NodeId, std::vector<double>> added;
  test::ThreadRanks(3, true).run([&](geometry::Ranks& ranks) {
    OfRank of_rank(lattice, ranks);
    std::vector<SphereSum> sums(of_rank.blocks.ghost_count());
    of_rank.blocks.for_each_ghost_here([&](const SphereBlocks::GhostOf& of, std::uint32_t ghost) {
      sums[ghost].numbers[0] = of.block;
    });
    of_rank.shared.begin_ghosts(sums);
    of_rank.shared.end_ghosts(sums);
    const std::lock_guard lock(mutex);
    for (const std::uint32_t k : of_rank.shared.own())
      of_rank.blocks.for_each_ghost(
          k,
          [&](NodeId node, std::uint32_t ghost) { added[node].push_back(sums[ghost].numbers[0]); },
          [](NodeId, std::uint32_t) {});
  });
  EXPECT_EQ(added, added_alone(lattice));
}

TEST(SharedBlocks, OfFewSpheresAreOnAllRanks) {
  const Lattice lattice(8);
  on_ranks(lattice, 3, false, [&](geometry::Ranks&, const OfRank& of_rank) {
    EXPECT_FALSE(of_rank.shared.is_worth_it());
    EXPECT_TRUE(of_rank.shared.holders().empty());
    EXPECT_EQ(of_rank.pairs, lattice.pairs);
    EXPECT_EQ(of_rank.blocks.row_count(), lattice.alone.row_count());
  });
}

TEST(SharedBlocks, OfNoPairsAreNone) {
  test::ThreadRanks(2).run([](geometry::Ranks& ranks) {
    SphereBlocks blocks;
    SharedBlocks shared(ranks);
    const std::vector<SphereBody> spheres(10);
    EXPECT_TRUE(shared.deal_out({}, spheres, {}, blocks).empty());
    geometry::ThreadPool pool;
    shared.fill({}, spheres, {}, pool, {}, blocks);
    EXPECT_EQ(blocks.row_count(), 0U);
    EXPECT_FALSE(shared.is_worth_it());
  });
}

}  // namespace
}  // namespace plekton::contact::shared_blocks_test

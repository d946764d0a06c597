// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_pieces.hpp"

#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <vector>

namespace plekton::contact::plane_pieces_test {
namespace {

constexpr std::size_t kCount = 4000;

/// A chain of spheres that touch, in several blocks, each near one plane or two; and nodes after
/// them that are in no block.
struct ChainOnPlanes {
  ChainOnPlanes() {
    std::vector<geometry::IndexPair> pairs;
    std::vector<Vec3> x;
    for (std::size_t i = 0; i < kCount + 300; ++i) {
      const auto sphere = static_cast<std::int32_t>(i);
      spheres.push_back({geometry::id_at<NodeId>(i), 0.5, MaterialId{0}, -1, 1.0});
      x.emplace_back(0.99 * static_cast<double>(i), 0, 0);
      if (i > 0 && i < kCount) pairs.push_back({sphere - 1, sphere});
      keys.push_back({sphere, 0});
      if (i % 3 == 0) keys.push_back({sphere, 2});
    }
    geometry::ThreadPool pool;
    blocks.assign(pairs, spheres, {}, pool, x);
    for (std::size_t k = 0; k < blocks.blocks().size(); ++k)
      owners.push_back(static_cast<int>(k) % 2);
  }

  std::vector<geometry::IndexPair> keys;
  std::vector<SphereBody> spheres;
  SphereBlocks blocks;
  std::vector<int> owners;
};

using Contacts = std::vector<std::uint32_t>;

Contacts contacts_of(const PlanePieces& pieces, const PlanePieces::Piece& piece) {
  return {pieces.order().begin() + piece.begin, pieces.order().begin() + piece.end};
}

TEST(PlanePieces, OfOneProcessHaveEachContactOnceAndThoseOfASphereTogether) {
  const ChainOnPlanes chain;
  PlanePieces pieces;
  pieces.assign(chain.keys, chain.spheres, {&chain.blocks, {}, nullptr});
  Contacts all(pieces.order().begin(), pieces.order().end());
  std::ranges::sort(all);
  ASSERT_EQ(all.size(), chain.keys.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
  std::map<std::int32_t, std::size_t> piece_of;
  for (std::size_t k = 0; k < pieces.pieces().size(); ++k) {
    const PlanePieces::Piece& piece = pieces.pieces()[k];
    EXPECT_TRUE(piece.counts);
    EXPECT_LE(piece.end - piece.begin, PlanePieces::kFull + 1);
    std::set<std::size_t> blocks;
    for (std::uint32_t place = piece.begin; place < piece.end; ++place) {
      const geometry::IndexPair& key = chain.keys[pieces.order()[place]];
      EXPECT_EQ(piece_of.try_emplace(key.a, k).first->second, k);
      EXPECT_EQ(pieces.planes()[pieces.sum_of()[place]], key.b);
      EXPECT_GE(pieces.sum_of()[place], piece.first);
      EXPECT_LT(pieces.sum_of()[place], piece.last);
      blocks.insert(static_cast<std::size_t>(key.a) < chain.blocks.sphere_count()
                        ? chain.blocks.block_of(key.a)
                        : kCount);
    }
    EXPECT_EQ(blocks.size(), 1U);
  }
}

/// Together ranks count the pieces of one process, and each computes what is of common nodes.
TEST(PlanePieces, OfRanksAreThoseOfOneProcess) {
  const ChainOnPlanes chain;
  PlanePieces alone;
  alone.assign(chain.keys, chain.spheres, {&chain.blocks, {}, nullptr});
  std::set<Contacts> of_one, of_ranks;
  for (const PlanePieces::Piece& piece : alone.pieces()) of_one.insert(contacts_of(alone, piece));
  std::size_t counted = 0;
  std::mutex mutex;
  test::ThreadRanks(2, false).run([&](geometry::Ranks& ranks) {
    SharedMotion motion(ranks);
    const std::vector<NodeId> met{NodeId{17}, NodeId{2500}};
    motion.assign(chain.blocks, chain.owners, met);
    PlanePieces pieces;
    pieces.assign(chain.keys, chain.spheres, {&chain.blocks, chain.owners, &motion});
    const std::lock_guard lock(mutex);
    EXPECT_EQ(pieces.motion(), &motion);
    std::set<std::int32_t> computed;
    for (const PlanePieces::Piece& piece : pieces.pieces()) {
      for (const std::uint32_t i : contacts_of(pieces, piece)) computed.insert(chain.keys[i].a);
      if (!piece.counts) continue;
      of_ranks.insert(contacts_of(pieces, piece));
      ++counted;
    }
    for (std::size_t i = 0; i < chain.keys.size(); ++i) {
      const std::int32_t owner =
          motion.owner_of(geometry::id_at<NodeId>(static_cast<std::size_t>(chain.keys[i].a)));
      EXPECT_EQ(pieces.teller(i), owner);
      const bool is_here = owner == SharedMotion::kCommon || owner == ranks.rank();
      EXPECT_EQ(computed.contains(chain.keys[i].a), is_here) << i;
    }
    EXPECT_TRUE(computed.contains(17) && computed.contains(2500) && computed.contains(kCount));
  });
  EXPECT_EQ(of_ranks, of_one);
  EXPECT_EQ(counted, of_one.size());
}

TEST(PlanePieces, OfNothingAreNone) {
  const SphereBlocks blocks;
  PlanePieces pieces;
  pieces.assign({}, {}, {&blocks, {}, nullptr});
  EXPECT_TRUE(pieces.pieces().empty());
}

}  // namespace
}  // namespace plekton::contact::plane_pieces_test

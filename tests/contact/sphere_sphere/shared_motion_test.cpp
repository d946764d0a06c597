// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/shared_motion.hpp"

#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace plekton::contact::shared_motion_test {
namespace {

constexpr std::size_t kCount = 4000;
constexpr int kRanks = 3;

/// A chain of spheres that touch, in several blocks, and two nodes more that are none.
struct Chain {
  explicit Chain(std::size_t count = kCount) {
    for (std::size_t i = 0; i < count; ++i) {
      spheres.push_back({geometry::id_at<NodeId>(i), 0.5, MaterialId{0}, -1, 1.0});
      x.emplace_back(0.99 * static_cast<double>(i), 0, 0);
      if (i > 0) {
        const auto b = static_cast<std::int32_t>(i);
        pairs.push_back({b - 1, b});
      }
    }
    x.resize(count + 2, Vec3(0, 50, 0));
    geometry::ThreadPool pool;
    blocks.assign(pairs, spheres, {}, pool, x);
    for (std::size_t k = 0; k < blocks.blocks().size(); ++k)
      owners.push_back(static_cast<int>(k) % kRanks);
  }

  std::vector<SphereBody> spheres;
  std::vector<geometry::IndexPair> pairs;
  std::vector<Vec3> x;
  SphereBlocks blocks;
  std::vector<int> owners;
};

/// What one rank knows: each number of a node it knows is the node's, others are -1.
struct Known {
  explicit Known(std::size_t count)
      : vectors(5, std::vector<Vec3>(count, Vec3::Constant(-1.0))),
        orientation(count, geometry::Quat(-1, -1, -1, -1)) {}

  void learn(NodeId node) {
    const auto number = static_cast<double>(index_of(node));
    for (auto& vector : vectors) vector[index_of(node)] = Vec3::Constant(number);
    orientation[index_of(node)] = geometry::Quat(number, number, number, number);
  }
  NodesInMotion nodes() {
    return {vectors[0], vectors[1], vectors[2], orientation, vectors[3], vectors[4]};
  }
  bool knows_motion(std::size_t node) const {
    const Vec3 number = Vec3::Constant(static_cast<double>(node));
    return vectors[0][node] == number && vectors[1][node] == number && vectors[2][node] == number;
  }
  bool knows_all(std::size_t node) const {
    const auto number = static_cast<double>(node);
    return knows_motion(node) && vectors[3][node] == Vec3::Constant(number) &&
           vectors[4][node] == Vec3::Constant(number) &&
           orientation[node].coeffs() == geometry::Quat(number, number, number, number).coeffs();
  }

  std::vector<std::vector<Vec3>> vectors;
  std::vector<geometry::Quat> orientation;
};

/// Calls body(ranks, motion, known) with ranks that know their own nodes.
template <class Body>
void on_ranks(const Chain& chain, const Body& body) {
  test::ThreadRanks(kRanks).run([&](geometry::Ranks& ranks) {
    SharedMotion motion(ranks);
    std::vector<std::uint8_t> acted_on(chain.x.size(), 0);
    acted_on[7] = 1;
    motion.keep_common(acted_on);
    const std::vector<NodeId> met{NodeId{3000}, NodeId{11}, NodeId{11}};
    motion.assign(chain.blocks, chain.owners, met);
    Known known(chain.x.size());
    for (const NodeId node : motion.own()) known.learn(node);
    body(ranks, motion, known);
  });
}

TEST(SharedMotion, GivesEachSphereToOneRankUnlessSomethingElseIsNear) {
  const Chain chain;
  ASSERT_GT(chain.blocks.blocks().size(), 4U);
  std::mutex mutex;
  std::vector<int> owners(chain.x.size(), 0);
  on_ranks(chain, [&](geometry::Ranks& ranks, const SharedMotion& motion, const Known&) {
    const std::lock_guard lock(mutex);
    const std::vector<NodeId> common(motion.common().begin(), motion.common().end());
    EXPECT_EQ(common, (std::vector<NodeId>{NodeId{7}, NodeId{11}, NodeId{3000},
                                           geometry::id_at<NodeId>(kCount),
                                           geometry::id_at<NodeId>(kCount + 1)}))
        << ranks.rank();
    EXPECT_TRUE(std::ranges::is_sorted(motion.own()));
    for (const NodeId node : motion.own()) ++owners[index_of(node)];
    for (const NodeId node : motion.common()) owners[index_of(node)] = 1;
  });
  EXPECT_EQ(owners, std::vector<int>(chain.x.size(), 1));
}

TEST(SharedMotion, TellsNeighboursOfGhostsAndOfNothingElse) {
  const Chain chain;
  on_ranks(chain, [&](geometry::Ranks& ranks, SharedMotion& motion, Known& known) {
    motion.tell_neighbours(known.nodes());

    std::vector<bool> should_know(chain.x.size(), false);
    for (const NodeId node : motion.own()) should_know[index_of(node)] = true;
    for (std::size_t k = 0; k < chain.owners.size(); ++k) {
      if (chain.owners[k] != ranks.rank()) continue;
      for (const SphereBlocks::Member& ghost : chain.blocks.ghosts(chain.blocks.blocks()[k]))
        should_know[index_of(ghost.node)] = true;
    }
    for (const NodeId node : motion.common()) should_know[index_of(node)] = false;
    for (std::size_t i = 0; i < chain.x.size(); ++i)
      ASSERT_EQ(known.knows_motion(i), should_know[i]) << i << " on rank " << ranks.rank();
  });
}

TEST(SharedMotion, TellsAllOfAllPrivateNodes) {
  const Chain chain;
  on_ranks(chain, [&](geometry::Ranks& ranks, SharedMotion& motion, Known& known) {
    motion.tell_all(known.nodes());
    for (const NodeId node : motion.common()) known.learn(node);
    for (std::size_t i = 0; i < chain.x.size(); ++i)
      ASSERT_TRUE(known.knows_all(i)) << i << " on rank " << ranks.rank();
  });
}

TEST(SharedMotion, TellsAllOfMoreNodesThanGoIntoAMessage) {
  constexpr std::size_t kMany = 40000;
  static_assert(kMany * sizeof(Vec3) > geometry::Ranks::kUsualRoom / 5, "five vectors a node");
  const Chain chain(kMany);
  on_ranks(chain, [&](geometry::Ranks& ranks, SharedMotion& motion, Known& known) {
    motion.tell_all(known.nodes());
    for (const NodeId node : motion.common()) known.learn(node);
    for (std::size_t i = 0; i < chain.x.size(); ++i)
      ASSERT_TRUE(known.knows_all(i)) << i << " on rank " << ranks.rank();
  });
}

TEST(SharedMotion, AddsSumsOfEachRankOnce) {
  const Chain chain;
  on_ranks(chain, [&](geometry::Ranks& ranks, SharedMotion& motion, Known&) {
    std::int64_t sum = 1000;
    motion.add_up(std::int64_t{1} << ranks.rank(), sum);
    EXPECT_EQ(sum, 1000 + 1 + 2 + 4);
  });
}

TEST(SharedMotion, IsOfNoUseWhereAllIsCommon) {
  test::ThreadRanks(2).run([](geometry::Ranks& ranks) {
    SharedMotion motion(ranks);
    EXPECT_FALSE(motion.is_of_use());
    motion.assign_nothing();
    EXPECT_FALSE(motion.is_of_use());
    motion.tell_all(NodesInMotion{});
  });
}

}  // namespace
}  // namespace plekton::contact::shared_motion_test

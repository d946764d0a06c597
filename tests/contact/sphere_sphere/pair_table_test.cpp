// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/pair_table.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law_table.hpp"
#include "contact/sphere_sphere/move_slots.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <vector>

namespace plekton::contact::pair_table_test {
namespace {

constexpr int kRanks = 3;

/// A chain of spheres, each pair of neighbours on the list, in several blocks.
struct Chain {
  explicit Chain(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      spheres.push_back({geometry::id_at<NodeId>(i), 0.5, MaterialId{0}, -1, 1.0});
      x.emplace_back(0.99 * static_cast<double>(i), 0, 0);
      const auto b = static_cast<std::int32_t>(i);
      if (i > 0) pairs.push_back({b - 1, b});
    }
    geometry::ThreadPool pool;
    blocks.assign(pairs, spheres, {}, pool, x);
  }

  std::vector<SphereBody> spheres;
  std::vector<geometry::IndexPair> pairs;
  std::vector<Vec3> x;
  SphereBlocks blocks;
};

std::vector<std::uint32_t> slots_of(const Chain& chain) {
  std::vector<std::uint32_t> slots;
  for (std::size_t i = 0; i < chain.pairs.size(); ++i) slots.push_back(chain.blocks.slot(i));
  return slots;
}

/// What pair i remembers, told apart from all others.
ContactMemory<AnyLaw> memory_of(std::size_t i, const AnyLaw::Functions& law) {
  const auto number = static_cast<double>(i);
  ContactMemory<AnyLaw> memory;
  memory.normal = Vec3(1.0 + number, 2.0 + number, 3.0 + number);
  memory.history.law = &law;
  for (std::size_t n = 0; n < law.history_numbers; ++n)
    memory.history.numbers[n] = 10.0 + number + 0.001 * static_cast<double>(n);
  return memory;
}

/// Every third pair is apart: it remembers nothing.
bool touches(std::size_t i) {
  return i % 3 != 0;
}

void let_touch(PairTable& table, const Chain& chain, const AnyLaw::Functions& law) {
  for (std::size_t i = 0; i < chain.pairs.size(); ++i) {
    const std::uint32_t slot = chain.blocks.slot(i);
    if (!touches(i) || !table.holds(slot)) continue;
    table.set_memory(slot, memory_of(i, law));
    table.touched(slot).set_moved(slot % PairTable::kLanes, true, i % 2 == 0);
  }
}

/// @returns how many pairs are held
std::size_t expect_remembered(const PairTable& table, const Chain& chain,
                              const AnyLaw::Functions& law) {
  std::size_t held = 0;
  for (std::size_t i = 0; i < chain.pairs.size(); ++i) {
    const std::uint32_t slot = chain.blocks.slot(i);
    EXPECT_EQ(table.has_touched(slot), touches(i)) << i;
    EXPECT_EQ(table.is_numbered(slot), touches(i) && i % 2 == 0) << i;
    if (!table.holds(slot)) continue;
    ++held;
    const ContactMemory<AnyLaw> memory = table.memory(slot);
    EXPECT_EQ(memory.is_new(), !touches(i)) << i;
    if (!touches(i)) continue;
    EXPECT_EQ(memory.normal, memory_of(i, law).normal) << i;
    EXPECT_EQ(memory.history.numbers, memory_of(i, law).history.numbers) << i;
  }
  return held;
}

std::vector<std::uint32_t> old_slots_of(const Chain& chain) {
  std::vector<std::uint32_t> slots = slots_of(chain);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (!touches(i)) slots[i] = kNoSlot;
  return slots;
}

/// Owners that are others for each list.
std::vector<int> owners_of(const Chain& chain, int list) {
  std::vector<int> owners;
  for (std::size_t k = 0; k < chain.blocks.blocks().size(); ++k)
    owners.push_back((static_cast<int>(k) / (1 + list % 2) + list) % kRanks);
  return owners;
}

/// @param kinds_change  from list to list, so that nothing can stay in its place
void expect_memories_follow_their_holders(bool kinds_change) {
  const Chain chain(6000);
  ASSERT_GT(chain.blocks.blocks().size(), 5U);
  const AnyLaw::Functions& law = LawTable<LinearFrictional>::functions;
  std::atomic<std::size_t> held = 0;
  test::ThreadRanks(kRanks).run([&](geometry::Ranks& ranks) {
    PairTable table;
    const std::vector<std::uint32_t> none(chain.pairs.size(), kNoSlot);
    for (int list = 0; list < 6; ++list) {
      const std::vector<int> owners = owners_of(chain, list);
      const bool is_shared = list != 2 && list != 4;  // as when a scene is one block for a while
      BlockHolders holders{&ranks, {}};
      if (is_shared) holders.of_blocks = owners;
      std::vector<PairKind> kinds{PairKind(law, kinds_change && list % 2 == 1)};
      table.take(chain.blocks, kinds, list == 0 ? none : old_slots_of(chain), holders);
      ASSERT_EQ(table.is_shared_out(), is_shared);
      if (list == 0) {
        let_touch(table, chain, law);
        table.tell_touched();
      }
      const std::size_t of_rank = expect_remembered(table, chain, law);
      if (is_shared)
        EXPECT_LT(of_rank, chain.pairs.size());
      else
        EXPECT_EQ(of_rank, chain.pairs.size());
      if (list == 5) held += of_rank;
    }
  });
  EXPECT_EQ(held, chain.pairs.size()) << "each pair is held once";
}

TEST(PairTable, GivesWhatPairsRememberToTheRanksThatHoldThemNow) {
  expect_memories_follow_their_holders(false);
}

TEST(PairTable, GivesItToRowsOfAnotherSizeToo) {
  expect_memories_follow_their_holders(true);
}

TEST(PairTable, OfOneProcessHoldsAllPairs) {
  const Chain chain(2000);
  const AnyLaw::Functions& law = LawTable<HertzMindlin>::functions;
  PairTable table;
  std::vector<PairKind> kinds{PairKind(law, true)};
  table.take(chain.blocks, kinds, std::vector<std::uint32_t>(chain.pairs.size(), kNoSlot), {});
  let_touch(table, chain, law);
  kinds = {PairKind(law, true)};
  table.take(chain.blocks, kinds, old_slots_of(chain), {});
  EXPECT_FALSE(table.is_shared_out());
  EXPECT_EQ(expect_remembered(table, chain, law), chain.pairs.size());
}

}  // namespace
}  // namespace plekton::contact::pair_table_test

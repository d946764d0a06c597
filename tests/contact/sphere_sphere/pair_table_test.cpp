// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/pair_table.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law_table.hpp"
#include "contact/sphere_sphere/move_slots.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace plekton::contact::pair_table_test {
namespace {

/// A chain of spheres, each pair of neighbours on the list, in several blocks.
struct Chain {
  explicit Chain(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      spheres.push_back({geometry::id_at<NodeId>(i), 0.5, MaterialId{0}, -1, 1.0});
      x.emplace_back(0.99 * static_cast<double>(i), 0, 0);
      const auto b = static_cast<std::int32_t>(i);
      if (i > 0) pairs.push_back({b - 1, b});
    }
    list_again(0);
  }

  /// The same pairs in other slots: of others each time it is thought that they touch.
  void list_again(int list) {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i][1] = static_cast<int>(i / 7) % 3 == list % 3 ? 0.3 * static_cast<double>(i % 2) : 0.0;
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
    if (!touches(i)) continue;
    table.set_memory(slot, memory_of(i, law));
    table.touched(slot).set_moved(slot % PairTable::kLanes, true, i % 2 == 0);
  }
}

void expect_remembered(const PairTable& table, const Chain& chain, const AnyLaw::Functions& law) {
  for (std::size_t i = 0; i < chain.pairs.size(); ++i) {
    const std::uint32_t slot = chain.blocks.slot(i);
    EXPECT_EQ(table.has_touched(slot), touches(i)) << i;
    EXPECT_EQ(table.is_numbered(slot), touches(i) && i % 2 == 0) << i;
    const ContactMemory<AnyLaw> memory = table.memory(slot);
    EXPECT_EQ(memory.is_new(), !touches(i)) << i;
    if (!touches(i)) continue;
    EXPECT_EQ(memory.normal, memory_of(i, law).normal) << i;
    EXPECT_EQ(memory.history.numbers, memory_of(i, law).history.numbers) << i;
  }
}

std::vector<std::uint32_t> old_slots_of(const Chain& chain) {
  std::vector<std::uint32_t> slots = slots_of(chain);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (!touches(i)) slots[i] = kNoSlot;
  return slots;
}

/// @param kinds_change  from list to list, so that nothing can stay in its place
void expect_memories_go_to_their_new_slots(bool kinds_change) {
  const AnyLaw::Functions& law = LawTable<LinearFrictional>::functions;
  Chain chain(6000);
  ASSERT_GT(chain.blocks.blocks().size(), 5U);
  PairTable table;
  for (int list = 0; list < 6; ++list) {
    const std::vector<std::uint32_t> old_slots =
        list == 0 ? std::vector<std::uint32_t>(chain.pairs.size(), kNoSlot) : old_slots_of(chain);
    chain.list_again(list);
    std::vector<PairKind> kinds{PairKind(law, kinds_change && list % 2 == 1)};
    table.take(chain.blocks, kinds, old_slots);
    if (list == 0) let_touch(table, chain, law);
    expect_remembered(table, chain, law);
  }
}

TEST(PairTable, MovesWhatPairsRememberInPlace) {
  expect_memories_go_to_their_new_slots(false);
}

TEST(PairTable, MovesItToRowsOfAnotherSizeToo) {
  expect_memories_go_to_their_new_slots(true);
}

TEST(PairTable, HasRowsOfAnyLaw) {
  const Chain chain(2000);
  const AnyLaw::Functions& law = LawTable<HertzMindlin>::functions;
  PairTable table;
  std::vector<PairKind> kinds{PairKind(law, true)};
  table.take(chain.blocks, kinds, std::vector<std::uint32_t>(chain.pairs.size(), kNoSlot));
  let_touch(table, chain, law);
  kinds = {PairKind(law, true)};
  table.take(chain.blocks, kinds, old_slots_of(chain));
  expect_remembered(table, chain, law);
}

}  // namespace
}  // namespace plekton::contact::pair_table_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/tracking/rekey.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace plekton::contact::rekey_test {
namespace {

using geometry::IndexPair;
using test::Random;

std::vector<IndexPair> random_keys(Random& random) {
  std::vector<IndexPair> keys;
  for (int k = random.integer(0, 12); k > 0; --k)
    keys.push_back({random.integer(0, 4), random.integer(0, 4)});
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

TEST(Rekey, KeepsWhatIsInBothListsMakesTheNewAndDropsTheRest) {
  Random random(1);
  Rekey<int> rekey;
  std::vector<int> things;
  std::map<IndexPair, int> expected;
  int next = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto new_keys = random_keys(random);
    std::map<IndexPair, int> kept;
    std::vector<int> dropped;

    rekey(
        things, new_keys,
        [&](std::size_t i, const int* old) {
          if (!old) expected[new_keys[i]] = next;
          return kept[new_keys[i]] = old ? *old : next++;
        },
        [&](int thing) { dropped.push_back(thing); });

    std::vector<int> expected_dropped;
    for (const auto& [key, thing] : expected) {
      if (!kept.contains(key)) expected_dropped.push_back(thing);
    }
    for (const auto& [key, thing] : kept) ASSERT_EQ(thing, expected[key]);
    ASSERT_EQ(dropped, expected_dropped);
    ASSERT_EQ(things.size(), new_keys.size());
    for (std::size_t i = 0; i < things.size(); ++i) ASSERT_EQ(things[i], kept[new_keys[i]]);
    expected = kept;
  }
}

}  // namespace
}  // namespace plekton::contact::rekey_test

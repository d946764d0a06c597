// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/told_pairs.hpp"

#include "tests/support/seeded_random.hpp"
#include "tests/support/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::contact::told_pairs_test {
namespace {

using geometry::IndexPair;
using Told = std::array<std::int64_t, 8>;

constexpr int kRanks = 3;
constexpr std::int32_t kSpheres = 30000;

/// Some pairs of each sphere, and who has them: anybody, or whoever has the sphere.
std::vector<std::pair<IndexPair, int>> pairs_of(bool are_mixed) {
  test::Random random(9);
  std::vector<std::pair<IndexPair, int>> pairs;
  for (std::int32_t a = 0; a < kSpheres; ++a) {
    if (a % 1000 > 900) continue;  // some spheres have none
    for (std::int32_t b = a + 1; b < a + 6; ++b) {
      const auto chance = static_cast<int>(random.uniform(0.0, kRanks));
      pairs.push_back({{a, b}, are_mixed ? chance : a * kRanks / kSpheres});
    }
  }
  return pairs;
}

TEST(ToldPairs, AreVisitedInOrderWhoeverHasThem) {
  static_assert(5 * kSpheres * sizeof(ToldPair<Told>) > 2 * geometry::Ranks::kUsualRoom,
                "several messages");
  for (const bool are_mixed : {true, false}) {
    const auto pairs = pairs_of(are_mixed);
    std::atomic<int> right = 0;
    test::ThreadRanks(kRanks).run([&](geometry::Ranks& ranks) {
      std::size_t next = 0, visited = 0, wrong = 0;
      for_each_of_ranks<Told>(
          ranks, kSpheres,
          [&](std::size_t end, std::vector<ToldPair<Told>>& own) {
            for (; next < pairs.size() && static_cast<std::size_t>(pairs[next].first.a) < end;
                 ++next) {
              const auto& [pair, rank] = pairs[next];
              if (rank == ranks.rank()) own.push_back({pair, {7 * pair.b}});
            }
          },
          [&](const ToldPair<Told>& told, int rank) {
            const bool is_next = visited < pairs.size() && told.pair == pairs[visited].first &&
                                 rank == pairs[visited].second && told.told[0] == 7 * told.pair.b;
            wrong += is_next ? 0 : 1;
            ++visited;
          });
      right += wrong == 0 && visited == pairs.size() ? 1 : 0;
    });
    EXPECT_EQ(right, kRanks);
  }
}

}  // namespace
}  // namespace plekton::contact::told_pairs_test
